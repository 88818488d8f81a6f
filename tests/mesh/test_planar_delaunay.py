from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay
from strategies import convex_discs, planar_discs, seeds

from pointchart.boundary.layout import on_circle, on_polygon, on_square
from pointchart.boundary.steps import chord_length_steps
from pointchart.errors import InputError, SolveError
from pointchart.mesh.connectivity import boundary_loops, half_edges
from pointchart.mesh.planar_delaunay import coinciding, separate, triangulate
from pointchart.plane.exact_signs import orientation_signs
from pointchart.shapes import disc


def exact_incircle(a, b, c, d):
    """Return a number that is positive if d lies inside the circle through the anticlockwise a, b, c; exact."""
    rows = [(p[0] - d[0], p[1] - d[1]) for p in (a, b, c)]
    (ax, ay), (bx, by), (cx, cy) = rows
    aa, bb, cc = (x * x + y * y for x, y in rows)
    return aa * (bx * cy - by * cx) - bb * (ax * cy - ay * cx) + cc * (ax * by - ay * bx)


def assert_fills(uv, loop, triangles):
    """Check that the triangles are anticlockwise, in number 2 n - 2 - b, and bounded by exactly the loop."""
    assert len(triangles) == 2 * len(uv) - 2 - len(loop)
    assert (orientation_signs(uv, triangles) == 1).all()
    assert len(np.unique(triangles)) == len(uv)
    (found,) = boundary_loops(half_edges(triangles, len(uv)))
    assert np.array_equal(np.roll(found, -found.argmin()), np.roll(loop, -loop.argmin()))


@settings(max_examples=40)
@given(convex_discs())
def test_no_circle_holds_another_point_exactly(example):
    uv, loop = example
    triangles = triangulate(uv, loop)
    assert_fills(uv, loop, triangles)
    exact = [tuple(map(Fraction, point)) for point in uv.tolist()]
    for a, b, c in triangles.tolist():
        corners = exact[a], exact[b], exact[c]
        assert all(exact_incircle(*corners, exact[d]) <= 0 for d in range(len(uv)) if d not in (a, b, c))


@settings(max_examples=20)
@given(planar_discs())
def test_the_triangles_are_those_of_a_delaunay_triangulation(shape):
    found = triangulate(shape.uv, shape.boundary)
    expected = Delaunay(shape.uv).simplices
    assert {frozenset(t) for t in found.tolist()} == {frozenset(t) for t in expected.tolist()}


@pytest.mark.parametrize("size", [1e-9, 1e-12, 1e-14])
def test_clusters_as_small_as_rounding_keep_every_point(size):
    rng = np.random.default_rng(1)
    cluster = np.unique([0.3, 0.4] + size * rng.uniform(-1, 1, (40, 2)), axis=0)
    uv = np.r_[disc(100).uv, cluster]
    loop = disc(100).boundary
    assert_fills(uv, loop, triangulate(uv, loop))


@settings(max_examples=15)
@given(seeds)
def test_the_loop_is_the_boundary_where_thousands_of_points_are_rounded_to_the_circle(seed):
    rng = np.random.default_rng(seed)
    steps = np.where(rng.random(5000) < 0.2, 1e-6 * rng.random(5000), rng.random(5000))
    rim = on_circle(steps)
    inner = 0.99 * np.sqrt(rng.random((500, 1))) * on_circle(rng.random(500) + 0.1)
    uv = np.r_[inner, rim]
    loop = 500 + np.arange(5000)
    assert_fills(uv, loop, triangulate(uv, loop))


def test_the_loop_is_the_boundary_where_neighbours_are_a_billionth_apart():
    angle = np.sort(np.r_[np.arange(2500) * 2 * np.pi / 2500, np.arange(2500) * 2 * np.pi / 2500 + 1e-9])
    uv = np.r_[np.c_[np.cos(angle), np.sin(angle)], disc(300).uv * 0.9]
    loop = np.arange(5000)
    assert_fills(uv, loop, triangulate(uv, loop))


@settings(max_examples=20)
@given(seeds)
def test_straight_sides_of_the_square_bear_any_number_of_points(seed):
    rng = np.random.default_rng(seed)
    rim = on_square(rng.random(200) + 0.01)
    uv = np.r_[rim, rng.uniform(0.01, 0.99, (100, 2))]
    assert_fills(uv, np.arange(200), triangulate(uv, np.arange(200)))


@settings(max_examples=20)
@given(seeds)
def test_slanted_sides_of_a_polygon_bear_any_number_of_rounded_points(seed):
    rng = np.random.default_rng(seed)
    turn = 2 * np.pi * (np.arange(5) + rng.uniform(0, 0.3, 5)) / 5
    rim = on_polygon(rng.random(150) + 0.01, np.c_[np.cos(turn), np.sin(turn)], np.arange(0, 150, 30))
    uv = np.r_[rim, 0.3 * disc(80).uv]
    assert_fills(uv, np.arange(150), triangulate(uv, np.arange(150)))


@settings(max_examples=20)
@given(planar_discs(), seeds)
def test_the_numbering_of_the_points_does_not_matter(shape, seed):
    order = np.random.default_rng(seed).permutation(len(shape.uv))
    place = np.argsort(order)
    one = triangulate(shape.uv, shape.boundary)
    other = order[triangulate(shape.uv[order], place[shape.boundary])]
    assert {frozenset(t) for t in one.tolist()} == {frozenset(t) for t in other.tolist()}


@settings(max_examples=20)
@given(planar_discs(), st.integers(-80, 80), st.floats(-6.3, 6.3))
def test_the_size_of_the_domain_does_not_matter(shape, exponent, turn):
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    moved = np.ldexp(shape.uv @ rotation.T, exponent)
    one, other = (triangulate(uv, shape.boundary) for uv in (shape.uv, moved))
    assert {frozenset(t) for t in one.tolist()} == {frozenset(t) for t in other.tolist()}


def test_coinciding_points_are_named():
    uv = np.r_[disc(60).uv, [disc(60).uv[7]], [disc(60).uv[3]]]
    assert sorted(coinciding(uv).tolist()) == [3, 7, 60, 61]
    with pytest.raises(SolveError, match=r"the parameters of 4 points coincide with those of others \(points") as error:
        triangulate(uv, disc(60).boundary)
    assert sorted(error.value.points["doubled"].tolist()) == [3, 7, 60, 61]


@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)), min_size=2, max_size=40))
def test_coinciding_points_are_those_that_are_not_alone(cells):
    uv = np.array(cells, dtype=np.float64)
    assert sorted(coinciding(uv).tolist()) == [i for i, cell in enumerate(cells) if cells.count(cell) > 1]


@pytest.mark.parametrize("place", [(0.5, 0.0), (1.5, 0.5), (0.5, -1e-17), (-3.0, -3.0)])
def test_a_point_on_or_outside_the_loop_is_refused(place):
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.4, 0.6], place])
    with pytest.raises(SolveError, match=r"do not fill the boundary loop: \d+ triangles instead of 6.* on or outside"):
        triangulate(uv, [0, 1, 2, 3])


def test_a_clockwise_loop_is_refused():
    shape = disc(60)
    with pytest.raises(SolveError, match="do not fill the boundary loop"):
        triangulate(shape.uv, shape.boundary[::-1])


@pytest.mark.parametrize("uv", [np.ones((5, 3)), np.ones(5), np.array([[0, 0], [1, 0], [0, 1], [np.nan, 0]])])
def test_parameters_that_are_no_finite_pairs_are_refused(uv):
    with pytest.raises(InputError, match=r"uv has shape \(.*\); a finite \(n, 2\) array is needed"):
        triangulate(uv, [0, 1, 2])


def test_chords_of_a_real_boundary_are_laid_out_and_filled(any_disc):
    rim = on_circle(chord_length_steps(any_disc.points, any_disc.boundary))
    assert_fills(rim, np.arange(len(rim)), triangulate(rim, np.arange(len(rim))))


@settings(max_examples=30)
@given(planar_discs(), seeds)
def test_coinciding_points_can_be_taken_apart_without_moving_any_other(shape, seed):
    rng = np.random.default_rng(seed)
    n, loop = len(shape.uv), shape.boundary
    again = rng.integers(0, n, 30)
    uv = np.r_[shape.uv, shape.uv[again]]
    apart = separate(uv, loop)
    assert len(coinciding(apart)) == 0
    kept = np.r_[loop, np.setdiff1d(np.arange(n), again)]
    assert np.array_equal(apart[kept], uv[kept])
    assert np.linalg.norm(apart - uv, axis=1).max() < 1e-3 * shape.spacing * 2
    assert_fills(apart, loop, triangulate(apart, loop))


def test_distinct_points_stay_where_they_are():
    shape = disc(60)
    assert separate(shape.uv, shape.boundary) is shape.uv
