from math import pi

import numpy as np
import pytest
from measures import euler_characteristic, has_one_fan_a_point, normals_of

from pointchart import shapes

NOT_DISCS = {
    "annulus": (shapes.annulus, 0, [96, 96]),
    "moebius": (shapes.moebius, 0, [192]),
    "sphere": (lambda: shapes.sphere(500), 2, []),
    "torus": (shapes.torus, 0, []),
}


@pytest.mark.parametrize(("make", "euler", "loops"), NOT_DISCS.values(), ids=NOT_DISCS)
def test_other_topologies_have_their_euler_characteristic_and_loops(make, euler, loops):
    shape = make()
    assert euler_characteristic(shape) == euler
    assert has_one_fan_a_point(shape)
    assert [len(loop) for loop in shape.loops] == loops
    assert len(shape.boundary) == (loops[0] if loops else 0)


def test_only_the_moebius_strip_is_one_sided():
    for make, _, _ in NOT_DISCS.values():
        triangles = make().triangles
        directed = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        is_orientable = len(np.unique(directed, axis=0)) == len(directed)
        assert is_orientable == (make is not shapes.moebius)


def test_both_loops_of_the_annulus_have_the_surface_on_their_left():
    ring = shapes.annulus(30, 4)
    turns = {}
    for loop in ring.loops:
        x, y = ring.points[loop, :2].T
        turns[round(float(np.hypot(x, y)[0]), 9)] = np.sign(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    assert turns == {1.0: 1, 0.5: -1}


def test_the_area_of_the_sphere_is_approached_at_second_order():
    counts = np.array([500, 2000, 8000])
    areas = [np.linalg.norm(normals_of(shapes.sphere(n)), axis=1).sum() / 2 for n in counts]
    rate = np.polyfit(np.log(counts**-0.5), np.log(4 * pi - np.array(areas)), 1)[0]
    assert rate == pytest.approx(2, abs=0.1)


def test_the_normals_of_closed_surfaces_point_outwards():
    ball, ring = shapes.sphere(300), shapes.torus()
    for shape in (ball, ring):
        a, b, c = shape.points[shape.triangles.T]
        assert np.sum(a * np.cross(b, c)) / 6 > 0
    assert np.allclose(np.linalg.norm(ball.points, axis=1), 1, rtol=0, atol=1e-14)
    assert np.all(np.sum(normals_of(ball) * ball.points[ball.triangles[:, 0]], axis=1) > 0)


def test_the_torus_keeps_its_distance_from_the_circle():
    x, y, z = shapes.torus(tube_radius=0.2).points.T
    assert np.allclose(np.hypot(np.hypot(x, y) - 1, z), 0.2, rtol=0, atol=1e-14)
