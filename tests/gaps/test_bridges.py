import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import planar_discs, seeds

from pointchart import certify, reconstruct, shapes, spacing, survey_scan
from pointchart.gaps.bridges import GAP_SHARE, LONG_EDGE, find_bridges, open_gaps
from pointchart.mesh.connectivity import boundary_loops, half_edges

GAPS = (([0.4, 0.2], 0.2), ([-0.4, -0.3], 0.15))


def long_triangles(points, triangles, step):
    """Find the triangles with an edge over four local spacings, one by one."""
    found = []
    for t, (a, b, c) in enumerate(triangles.tolist()):
        for i, j in ((a, b), (b, c), (c, a)):
            if np.linalg.norm(points[i] - points[j]) > LONG_EDGE * max(step[i], step[j]):
                found.append(t)
                break
    return found


def found_in(points, triangles, is_boundary=None):
    scores = np.ones(len(points), bool) if is_boundary is None else is_boundary
    return find_bridges(points, triangles, spacing(points), lambda: scores)


def as_cycle(loop):
    return np.roll(loop, -int(np.argmin(loop))).tolist()


@pytest.fixture(scope="module")
def pierced():
    """Return the points of a disc with two gaps, and the mesh that bridges them."""
    shape = shapes.disc(1500, seed=4)
    apart = np.min([np.linalg.norm(shape.uv - place, axis=1) / radius for place, radius in GAPS], axis=0)
    result = reconstruct(shape.points[apart > 1])
    return shape.points[apart > 1], result.triangles


# Bridges


@settings(max_examples=50)
@given(planar_discs())
def test_an_even_scan_has_no_bridges(shape):
    assert found_in(shape.points, shape.triangles) == []


def test_every_gap_is_one_bridge_the_longest_first(pierced):
    points, triangles = pierced
    large, small = found_in(points, triangles)
    assert np.linalg.norm(points[large.points, :2].mean(axis=0) - [0.4, 0.2]) < 0.05
    assert np.linalg.norm(points[small.points, :2].mean(axis=0) - [-0.4, -0.3]) < 0.05
    assert large.rim_length == pytest.approx(2 * np.pi * 0.2, rel=0.3)
    assert small.rim_length == pytest.approx(2 * np.pi * 0.15, rel=0.3)


def test_bridges_hold_each_long_triangle_once_and_no_other(pierced):
    points, triangles = pierced
    held = np.concatenate([bridge.triangles for bridge in found_in(points, triangles)])
    assert sorted(held) == long_triangles(points, triangles, spacing(points))


def test_the_corners_of_a_bridge_are_those_of_its_triangles(pierced):
    points, triangles = pierced
    for bridge in found_in(points, triangles):
        assert np.array_equal(bridge.points, np.unique(triangles[bridge.triangles]))


def test_the_rim_of_a_bridge_is_as_long_as_its_edges_of_one_triangle(pierced):
    points, triangles = pierced
    step = spacing(points)
    for bridge in found_in(points, triangles):
        edges = np.sort(triangles[bridge.triangles][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        ends, count = np.unique(edges, axis=0, return_counts=True)
        rim = points[ends[count == 1]]
        assert bridge.rim_length == pytest.approx(np.linalg.norm(rim[:, 1] - rim[:, 0], axis=1).sum())
        assert bridge.rim_in_spacings == pytest.approx(bridge.rim_length / np.median(step[bridge.points]))


def test_bridges_scale_with_the_scan(pierced):
    points, triangles = pierced
    still, scaled = found_in(points, triangles), found_in(1024 * points, triangles)
    assert [b.triangles.tolist() for b in scaled] == [b.triangles.tolist() for b in still]
    assert [b.rim_length for b in scaled] == [1024 * b.rim_length for b in still]
    assert [b.rim_in_spacings for b in scaled] == [b.rim_in_spacings for b in still]


# What a bridge lies over


def test_a_bridge_whose_corners_lie_on_the_edge_of_a_gap_is_over_a_gap(pierced):
    points, triangles = pierced
    survey = survey_scan(points)
    scores = np.empty(len(points), bool)
    scores[survey.cloud.rows] = survey.score().is_boundary
    for bridge in found_in(points, triangles, scores):
        assert bridge.share > 0.9
        assert bridge.is_gap


@pytest.mark.parametrize("share", [0.0, GAP_SHARE - 0.1, GAP_SHARE, GAP_SHARE + 0.1, 1.0])
def test_a_bridge_is_over_a_gap_from_a_share_of_boundary_points_on(pierced, share):
    points, triangles = pierced
    for bridge in found_in(points, triangles):
        scores = np.zeros(len(points), bool)
        scores[bridge.points[: round(share * len(bridge.points))]] = True
        (judged,) = [b for b in found_in(points, triangles, scores) if b.points[0] == bridge.points[0]]
        assert judged.share == scores.sum() / len(bridge.points)
        assert judged.is_gap == (judged.share >= GAP_SHARE)


def test_the_scores_are_asked_for_once_and_only_if_there_is_a_bridge(pierced):
    asked = []

    def scores():
        asked.append(True)
        return np.ones(1500, bool)

    shape = shapes.disc(1500, seed=4)
    find_bridges(shape.points, shape.triangles, spacing(shape.points), scores)
    assert asked == []
    points, triangles = pierced
    find_bridges(points, triangles, spacing(points), scores)
    assert asked == [True]


# Gaps left open


@settings(max_examples=50)
@given(planar_discs(smallest=60), seeds, st.integers(1, 5), st.floats(0.02, 0.6))
def test_whatever_is_opened_leaves_a_disc_with_that_many_holes_on_all_points(shape, seed, n_gaps, width):
    rng = np.random.default_rng(seed)
    middle = shape.uv[shape.triangles].mean(axis=1)
    places = rng.uniform(-1, 1, (n_gaps, 2))
    members = [np.flatnonzero(np.linalg.norm(middle - place, axis=1) < width) for place in places]
    triangles, n_holes = open_gaps(shape.triangles, members, len(shape.points))
    proof = certify(shape.points, triangles, uv=shape.uv, loop=shape.boundary, holes=n_holes)
    assert proof.faults == ()
    assert proof.is_one_to_one
    assert n_holes <= n_gaps
    assert n_holes > 0 or len(triangles) == len(shape.triangles)
    kept, held = set(map(tuple, triangles.tolist())), set(map(tuple, shape.triangles.tolist()))
    opened = set(map(tuple, shape.triangles[np.concatenate([*members, [0]]).astype(int)].tolist()))
    assert kept <= held
    assert held - kept <= opened


@settings(max_examples=20)
@given(planar_discs(smallest=60), seeds)
def test_holes_touch_neither_each_other_nor_the_boundary(shape, seed):
    order = np.random.default_rng(seed).permutation(len(shape.triangles))
    triangles, n_holes = open_gaps(shape.triangles, np.array_split(order, 8), len(shape.points))
    loops = boundary_loops(half_edges(triangles, len(shape.points)))
    assert len(loops) == 1 + n_holes
    assert len(np.unique(np.concatenate(loops))) == sum(map(len, loops))


def test_a_bridge_over_a_gap_is_opened_to_the_last_triangle(pierced):
    points, triangles = pierced
    bridges = found_in(points, triangles)
    opened, n_holes = open_gaps(triangles, [b.triangles for b in bridges], len(points))
    assert n_holes == 2
    assert len(triangles) - len(opened) == sum(len(bridge.triangles) for bridge in bridges)
    assert found_in(points, opened) == []


def test_the_hole_that_is_left_has_the_rim_of_the_bridge_and_the_outer_loop_stays(pierced):
    points, triangles = pierced
    bridges = found_in(points, triangles)
    opened = open_gaps(triangles, [b.triangles for b in bridges], len(points))[0]
    (before,) = boundary_loops(half_edges(triangles, len(points)))
    after, *holes = boundary_loops(half_edges(opened, len(points)))
    assert as_cycle(after) == as_cycle(before)
    assert sorted(sorted(hole.tolist()) for hole in holes) == sorted(b.points.tolist() for b in bridges)


def test_one_gap_may_be_opened_and_another_stay_bridged(pierced):
    points, triangles = pierced
    large, small = found_in(points, triangles)
    opened, n_holes = open_gaps(triangles, [small.triangles], len(points))
    assert n_holes == 1
    (left,) = found_in(points, opened)
    assert left.rim_length == large.rim_length


def test_without_gaps_nothing_is_opened(pierced):
    points, triangles = pierced
    opened, n_holes = open_gaps(triangles, [], len(points))
    assert n_holes == 0
    assert np.array_equal(opened, triangles)


def test_a_gap_along_the_boundary_makes_no_hole():
    shape = shapes.disc(300, seed=1)
    at_rim = np.flatnonzero(np.isin(shape.triangles, shape.boundary).any(axis=1))
    opened, n_holes = open_gaps(shape.triangles, [at_rim], 300)
    assert n_holes == 0
    assert np.array_equal(opened, shape.triangles)
