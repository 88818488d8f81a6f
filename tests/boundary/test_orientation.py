import numpy as np
import pytest
from comparisons import oriented
from hypothesis import given, settings
from scans import SMOOTH
from strategies import rotations

from pointchart import reconstruct, shapes
from pointchart.boundary import anticlockwise
from pointchart.mesh.connectivity import half_edges


def normals_of(points, triangles):
    corner = points[triangles]
    return np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


@pytest.mark.parametrize("name", ["hemisphere", "relief"])
def test_a_loop_reversed_turned_or_closed_gives_the_same_mesh(name):
    shape = SMOOTH[name]()
    loop = shape.boundary
    meshes = [
        oriented(reconstruct(shape.points, given).triangles)
        for given in (loop, loop[::-1], np.roll(loop, 17), np.append(loop, loop[0]), loop.tolist())
    ]
    assert all(mesh == meshes[0] for mesh in meshes)


@given(rotations())
@settings(max_examples=5)
def test_triangles_of_a_cap_face_away_from_its_centre_in_any_pose(rotation):
    cap = shapes.hemisphere(300)
    points = cap.points @ rotation.T
    triangles = reconstruct(points).triangles
    assert (np.einsum("ij,ij->i", normals_of(points, triangles), points[triangles].mean(axis=1)) > 0).all()


@pytest.mark.parametrize("upside_down", [1, -1])
@pytest.mark.parametrize("seed", range(3))
def test_triangles_of_level_terrain_face_upwards(upside_down, seed):
    points = shapes.relief(800, seed=seed).points * [1, 1, upside_down]
    assert (normals_of(points, reconstruct(points).triangles)[:, 2] > 0).all()


def test_the_parameters_turn_the_way_the_triangles_do(any_disc):
    result = reconstruct(any_disc.points, any_disc.boundary)
    corner = result.uv[result.triangles]
    first, second = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    assert (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] > 0).all()
    edges = half_edges(result.triangles, len(result.rows))
    ahead = dict(zip(edges.origins[edges.twins < 0].tolist(), edges.targets[edges.twins < 0].tolist(), strict=True))
    assert [ahead[i] for i in result.loop.tolist()] == np.roll(result.loop, -1).tolist()


def test_a_mirrored_cap_turns_the_other_way():
    tent = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 2]])
    assert anticlockwise(tent, np.array([0, 1, 2, 3])).tolist() == [0, 1, 2, 3]
    assert anticlockwise(tent * [1, 1, -1], np.array([0, 1, 2, 3])).tolist() == [0, 3, 2, 1]


def test_a_relief_on_a_tilted_boundary_faces_its_bulge_whichever_way_it_is_turned():
    cap = shapes.hemisphere(400, angle=40)
    axis = np.array([1.0, 2.0, 0.5]) / np.linalg.norm([1.0, 2.0, 0.5])
    for tilt in np.deg2rad([40, 75, 110, 150, 200, 250]):
        cross = np.cross(np.eye(3), axis)
        rotation = np.cos(tilt) * np.eye(3) + np.sin(tilt) * cross + (1 - np.cos(tilt)) * np.outer(axis, axis)
        points = cap.points @ rotation.T
        assert np.array_equal(anticlockwise(points, cap.boundary), cap.boundary)
        assert np.array_equal(anticlockwise(points, cap.boundary[::-1])[1:], np.roll(cap.boundary, 1)[1:])
