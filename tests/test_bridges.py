import numpy as np
import pytest
from hypothesis import given
from strategies import planar_discs

from pointchart import reconstruct, shapes, spacing
from pointchart.bridges import LONG_EDGE, find_bridges


def long_triangles(points, triangles, step):
    """Find the triangles with an edge over four local spacings, one by one."""
    found = []
    for t, (a, b, c) in enumerate(triangles.tolist()):
        for i, j in ((a, b), (b, c), (c, a)):
            if np.linalg.norm(points[i] - points[j]) > LONG_EDGE * max(step[i], step[j]):
                found.append(t)
                break
    return found


@pytest.fixture(scope="module")
def pierced():
    """Return the points of a disc with two gaps, and the mesh that bridges them."""
    shape = shapes.disc(1500, seed=4)
    gaps = (([0.4, 0.2], 0.2), ([-0.4, -0.3], 0.15))
    apart = np.min([np.linalg.norm(shape.uv - place, axis=1) / radius for place, radius in gaps], axis=0)
    result = reconstruct(shape.points[apart > 1])
    return shape.points[apart > 1], result.triangles


@given(planar_discs())
def test_an_even_scan_has_no_bridges(shape):
    assert find_bridges(shape.points, shape.triangles, spacing(shape.points)) == []


def test_every_gap_is_one_bridge_the_longest_first(pierced):
    points, triangles = pierced
    large, small = find_bridges(points, triangles, spacing(points))
    assert np.linalg.norm(points[large.points, :2].mean(axis=0) - [0.4, 0.2]) < 0.05
    assert np.linalg.norm(points[small.points, :2].mean(axis=0) - [-0.4, -0.3]) < 0.05
    assert large.rim_length == pytest.approx(2 * np.pi * 0.2, rel=0.3)
    assert small.rim_length == pytest.approx(2 * np.pi * 0.15, rel=0.3)


def test_bridges_hold_each_long_triangle_once_and_no_other(pierced):
    points, triangles = pierced
    step = spacing(points)
    bridges = find_bridges(points, triangles, step)
    held = np.concatenate([bridge.triangles for bridge in bridges])
    assert sorted(held) == long_triangles(points, triangles, step)


def test_the_corners_of_a_bridge_are_those_of_its_triangles(pierced):
    points, triangles = pierced
    for bridge in find_bridges(points, triangles, spacing(points)):
        assert np.array_equal(bridge.points, np.unique(triangles[bridge.triangles]))


def test_the_rim_of_a_bridge_is_as_long_as_its_edges_of_one_triangle(pierced):
    points, triangles = pierced
    for bridge in find_bridges(points, triangles, spacing(points)):
        edges = np.sort(triangles[bridge.triangles][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        ends, count = np.unique(edges, axis=0, return_counts=True)
        rim = points[ends[count == 1]]
        assert bridge.rim_length == pytest.approx(np.linalg.norm(rim[:, 1] - rim[:, 0], axis=1).sum())


def test_bridges_scale_with_the_scan(pierced):
    points, triangles = pierced
    still = find_bridges(points, triangles, spacing(points))
    scaled = find_bridges(1024 * points, triangles, spacing(1024 * points))
    assert [b.triangles.tolist() for b in scaled] == [b.triangles.tolist() for b in still]
    assert [b.rim_length for b in scaled] == [1024 * b.rim_length for b in still]
