from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import rotations, seeds

from pointchart import shapes
from pointchart.errors import InputError
from pointchart.proof.intersections import places_of, self_intersections

FLAT = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]])
QUARTER_TURNS = [np.eye(3)[:, order] * sign for order in ([1, 0, 2], [2, 1, 0], [1, 2, 0]) for sign in (1, [1, -1, 1])]


def meets(other, one=FLAT):
    """Tell whether two triangles meet, whichever is named first and whichever corner is first."""
    answers = set()
    for turn in range(3):
        for first, second in ((one, other), (other, one)):
            points = np.r_[np.roll(first, turn, axis=0), second].astype(np.float64)
            answers.add(len(self_intersections(points, np.arange(6).reshape(2, 3))))
    (answer,) = answers
    return bool(answer)


def brute_force(points, triangles):
    """List the pairs of triangles without a common corner an edge of one of which meets the other, by fractions."""
    exact = [[Fraction(x) for x in point] for point in points.tolist()]
    pairs = []
    for (t, one), (u, other) in combinations(enumerate(triangles.tolist()), 2):
        edges = [(*edge, other) for edge in combinations(one, 2)] + [(*edge, one) for edge in combinations(other, 2)]
        if not set(one) & set(other) and any(edge_meets(exact, p, q, face) for p, q, face in edges):
            pairs.append([t, u])
    return np.array(pairs, np.int64).reshape(-1, 2)


def edge_meets(points, p, q, face):
    """Tell whether edge pq meets a triangle, by the point in which its line passes the plane; not for common planes."""
    a, b, c = (np.array(points[k]) for k in face)
    start, way = np.array(points[p]), np.array(points[q]) - np.array(points[p])
    normal = np.cross(b - a, c - a)
    if normal @ way == 0:
        return False
    place = Fraction(normal @ (a - start), normal @ way)
    hit = start + place * way
    inside = [np.cross(end - begin, hit - begin) @ normal >= 0 for begin, end in ((a, b), (b, c), (c, a))]
    return 0 <= place <= 1 and all(inside)


def test_every_simulated_disc_is_free_of_intersections(any_disc):
    assert self_intersections(any_disc.points, any_disc.triangles).shape == (0, 2)


@pytest.mark.parametrize("make", [lambda: shapes.sphere(2000), shapes.torus, shapes.moebius, lambda: shapes.fold(0.5)])
def test_surfaces_that_do_not_pass_through_themselves_have_none(make):
    shape = make()
    assert len(self_intersections(shape.points, shape.triangles)) == 0


@pytest.mark.parametrize("n", [2, 5, 40])
def test_sheets_that_cross_between_their_points_meet_once_a_side_on_either_sheet(n):
    # Every triangle cuts the line in which the sheets cross along half a unit, on the upright sheet a quarter further.
    upright = shapes.grid(n, 2)
    points = np.c_[np.full(2 * n, 0.5), upright.points[:, 0] + 0.25, upright.points[:, 1] - 0.5]
    flat = shapes.grid(2, n + 1)
    both, triangles = np.r_[flat.points, points], np.r_[flat.triangles, upright.triangles + len(flat.points)]
    pairs = self_intersections(both, triangles)
    spans_flat = np.sort(np.r_[np.arange(n), np.arange(n) + 0.5])
    spans_upright = np.sort(np.r_[np.arange(n - 1), np.arange(n - 1) + 0.5]) + 0.25
    expected = sum(a <= b + 0.5 and b <= a + 0.5 for a in spans_flat for b in spans_upright)
    assert len(pairs) == expected
    assert len(places_of(both, triangles, pairs)) == 1


@pytest.mark.parametrize(
    ("other", "answer"),
    [
        ([[1, 1, -1], [1, 1, 1], [9, 9, 0]], True),
        ([[1, 1, 0], [1, 1, 1], [2, 1, 1]], True),
        ([[1, 0, 0], [1, -1, 1], [1, -1, -1]], True),
        ([[4, 0, 0], [5, 0, 1], [5, 0, -1]], True),
        ([[2, 2, 0], [3, 3, 1], [3, 3, -1]], True),
        ([[2, 2 + 1e-15, 0], [3, 3, 1], [3, 3, -1]], False),
        ([[1, 1, 1e-200], [1, 1, 1], [2, 1, 1]], False),
        ([[1, 1, 0], [2, 1, 0], [1, 2, 0]], True),
        ([[-9, -9, 0], [20, -9, 0], [-9, 20, 0]], True),
        ([[1, 1, 0], [9, 1, 0], [9, 2, 0]], True),
        ([[4, 0, 0], [9, 0, 0], [9, 5, 0]], True),
        ([[4, 1, 0], [9, 0, 0], [9, 5, 0]], False),
        ([[0, 5, 0], [5, 0, 0], [5, 5, 0]], False),
        ([[0, 0, 1], [4, 0, 1], [0, 4, 1]], False),
        ([[1, 1, -1], [1, 1, 0], [1, 1, 1]], True),
        ([[1, 1, 0], [2, 1, 0], [3, 1, 0]], True),
        ([[3, 3, 0], [4, 3, 0], [5, 3, 0]], False),
        ([[3, 3, -1], [3, 3, 0], [3, 3, 1]], False),
    ],
)
@pytest.mark.parametrize("scale", [1.0, 2.0**-300, 2.0**400])
def test_touching_is_meeting_and_the_least_distance_is_not(other, answer, scale):
    assert meets(scale * np.array(other), scale * FLAT) is answer


def test_triangles_with_a_common_corner_are_left_out():
    points = np.r_[FLAT, [[1, 1, -1], [1, 1, 1]]]
    assert len(self_intersections(points, [[0, 1, 2], [0, 3, 4]])) == 0


def test_triangles_without_an_area_meet_only_those_with_one():
    line = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [1, -1, 0], [1, 0.5, 0], [1, 1, 0], [0, 5, 0], [5, 0, 1]])
    assert len(self_intersections(line, [[0, 1, 2], [3, 4, 5]])) == 0


def test_a_mesh_without_triangles_has_no_intersections():
    assert self_intersections(shapes.grid(3, 3).points, []).shape == (0, 2)


def test_triangles_of_other_points_are_refused():
    with pytest.raises(InputError, match="name points that are not there"):
        self_intersections(shapes.grid(3, 3).points, [[0, 1, 9]])


def test_a_sheet_bent_to_an_eight_meets_itself_in_one_line():
    sheet = shapes.grid(61, 12)
    turn = sheet.uv[:, 0] / 60 * (np.pi + 1.0) - 0.5
    points = np.c_[10 * np.sin(turn), sheet.uv[:, 1], 10 * np.sin(turn) * np.cos(turn)]
    pairs = self_intersections(points, sheet.triangles)
    crossed = turn[sheet.triangles[pairs]]
    assert len(pairs) >= 2 * 11
    assert np.minimum(np.abs(crossed), np.abs(crossed - np.pi)).max() < 0.15
    (place,) = places_of(points, sheet.triangles, pairs)
    assert np.abs(place[[0, 2]]).max() < 1.0


def test_places_are_told_apart_and_the_one_with_most_pairs_comes_first():
    flat = shapes.grid(30, 6)
    needles = [np.array([[x + 0.3, 2.2, -1], [x + 0.4, 2.3, -1], [x + 0.35, 2.25, 1]]) for x in (2, 20)]
    needles.append(needles[1] + [0.05, 0.05, 0])
    points = np.r_[flat.points, *needles]
    triangles = np.r_[flat.triangles, len(flat.points) + np.arange(9).reshape(3, 3)]
    pairs = self_intersections(points, triangles)
    places = places_of(points, triangles, pairs)
    assert len(places) == 2
    assert np.abs(places[:, 0] - [20.4, 2.4]).max() < 0.5


@settings(max_examples=25)
@given(seed=seeds, n=st.integers(4, 10), size=st.sampled_from([0, 4, 40]))
def test_the_pairs_are_those_of_brute_force_with_fractions(seed, n, size):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(3 * n, 3)) if size == 0 else rng.integers(0, size, (3 * n, 3)).astype(np.float64)
    if size == 4:
        # In general position otherwise: the brute force knows no common planes.
        points += rng.integers(0, 2, (3 * n, 3)) / 2.0 ** rng.integers(1, 40, (3 * n, 3))
    triangles = np.arange(3 * n).reshape(n, 3)
    assert np.array_equal(self_intersections(points, triangles), brute_force(points, triangles))


@given(seed=seeds, turn=rotations())
def test_numbering_and_motions_do_not_change_which_triangles_meet(seed, turn):
    rng = np.random.default_rng(seed)
    shape = shapes.add_noise(shapes.fold(0.8, nx=15, ny=8), sigma_in_spacings=0.4, seed=seed)
    pairs = self_intersections(shape.points, shape.triangles)
    for quarter in QUARTER_TURNS:
        assert np.array_equal(self_intersections(shape.points @ quarter, shape.triangles), pairs)
    assert np.array_equal(self_intersections(shape.points @ turn, shape.triangles), pairs)
    assert np.array_equal(self_intersections(1e9 * shape.points, shape.triangles[:, [1, 2, 0]]), pairs)
    order = rng.permutation(len(shape.triangles))
    named = np.sort(order[self_intersections(shape.points, shape.triangles[order])], axis=1)
    assert np.array_equal(named[np.lexsort(named.T[::-1])], pairs)


@settings(max_examples=30)
@given(seed=seeds)
def test_on_whole_numbers_touching_pairs_are_found_in_any_numbering(seed):
    rng = np.random.default_rng(seed)
    points = rng.integers(0, 4, (36, 3)).astype(np.float64)
    triangles = np.arange(36).reshape(12, 3)
    pairs = self_intersections(points, triangles)
    for quarter in QUARTER_TURNS:
        assert np.array_equal(self_intersections(points @ quarter, triangles), pairs)
    assert np.array_equal(self_intersections(points * 2.0**-400, np.roll(triangles, 1, axis=1)), pairs)
