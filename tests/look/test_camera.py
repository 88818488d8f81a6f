"""From where a scan is looked at: axes that turn, the outside, what is upwards."""

import numpy as np
import pytest

from pointchart import shapes
from pointchart.look.camera import camera, upright_axes, upward

DISC = shapes.disc(400, seed=1)
CAP = shapes.hemisphere(400)


@pytest.mark.parametrize("up", ["x", "y", "z"])
@pytest.mark.parametrize("view", [None, (0, 0), (30, 20), (-200, 89)])
def test_a_camera_turns_and_does_not_mirror(up, view):
    axes = camera(CAP.points, CAP.triangles, view=view, up=up)
    assert np.allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)


@pytest.mark.parametrize("up", ["x", "y", "z"])
def test_the_axis_asked_for_is_upwards_and_the_tilt_looks_down_on_it(up):
    axis = np.eye(3)["xyz".index(up)]
    for turn, tilt in ((0, 0), (50, 0), (20, 35)):
        right, above, towards = camera(CAP.points, view=(turn, tilt), up=up)
        assert right @ axis == pytest.approx(0.0, abs=1e-12)
        assert above @ axis == pytest.approx(np.cos(np.deg2rad(tilt)))
        assert towards @ axis == pytest.approx(np.sin(np.deg2rad(tilt)))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_cloud_and_mesh_are_seen_from_the_same_outside(side):
    points = side * CAP.points[:, [2, 0, 1]]
    cloud = camera(points)
    mesh = camera(points, CAP.triangles if side > 0 else CAP.triangles[:, ::-1])
    assert np.allclose(cloud, mesh)
    assert cloud[2] @ [side, 0.0, 0.0] > 0.85


@pytest.mark.parametrize("up", ["x", "y", "z"])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_mesh_that_closes_but_for_an_opening_stands_on_the_axis_of_its_opening(up, sign):
    bowl, (right, above, towards) = shapes.hemisphere(400, angle=150), upright_axes(up)
    # Broad to the right, shallow towards us, open upwards or downwards.
    stretched = np.stack([1.5 * right, 0.8 * towards, sign * above])
    points = bowl.points @ stretched
    triangles = bowl.triangles if np.linalg.det(stretched) > 0 else bowl.triangles[:, ::-1]
    assert upward(points, triangles) == up
    _, upwards, facing = camera(points, triangles)
    assert upwards @ above == pytest.approx(np.cos(np.deg2rad(25)))
    assert facing @ towards > 0.85


@pytest.mark.parametrize("up", ["x", "y", "z"])
def test_what_is_flat_stands_where_it_does_not_lie(up):
    sheet = DISC.points @ np.stack([*np.delete(np.eye(3), "xyz".index(up), axis=0), np.eye(3)["xyz".index(up)]])
    assert upward(sheet) == upward(sheet, DISC.triangles) == ("y" if up == "z" else "z")


def test_a_mesh_whose_triangles_are_not_turned_alike_is_seen_as_its_cloud_is():
    mixed = DISC.triangles.copy()
    mixed[::2] = mixed[::2, ::-1]
    assert upward(DISC.points, mixed) == upward(DISC.points)


@pytest.mark.parametrize("triangles", [np.empty((0, 3), int), np.array([[0, 0, 1]])])
def test_triangles_without_area_tell_nothing(triangles):
    assert np.allclose(camera(CAP.points, triangles), camera(CAP.points))


def test_a_level_scan_is_seen_from_above():
    assert camera(DISC.points)[2, 2] > 0.85
