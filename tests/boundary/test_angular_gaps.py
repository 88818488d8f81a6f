import numpy as np
import pytest
from hypothesis import given, settings
from strategies import rotations

from pointchart import InputError, angular_gaps, delaunay_star, hull_test, nearest, shapes


def test_angular_gaps_are_half_turns_on_a_straight_edge_and_three_quarters_at_a_corner():
    sheet = shapes.grid(13, 11)
    gaps = angular_gaps(sheet.points, nearest(sheet.points, 30)).reshape(11, 13)
    assert gaps[0, 0] == pytest.approx(1.5 * np.pi)
    assert gaps[0, 6] == pytest.approx(np.pi)
    assert gaps[5, 6] < np.pi / 4


@pytest.mark.parametrize("k", [3, 5, 8])
@given(rotations())
@settings(max_examples=5)
def test_the_angular_gap_inside_a_regular_polygon_is_the_kth_of_a_turn(k, rotation):
    turn = 2 * np.pi * np.arange(k) / k
    points = np.r_[[[0.0, 0, 0]], np.c_[np.cos(turn), np.sin(turn), 0 * turn]] @ rotation.T
    gaps = angular_gaps(points, nearest(points, k))
    assert gaps[0] == pytest.approx(2 * np.pi / k)
    assert gaps[1:] == pytest.approx(np.full(k, 2 * np.pi - np.pi * (k - 2) / k))


def test_neighbours_straight_above_and_below_do_not_narrow_an_angular_gap():
    sheet = shapes.grid(13, 11)
    pole = np.array([[6, 0, 1.5], [6, 0, -1.5]])
    alone = angular_gaps(sheet.points, nearest(sheet.points, 20))
    assert np.allclose(angular_gaps(np.r_[sheet.points, pole], nearest(np.r_[sheet.points, pole], 20))[6], alone[6])


@pytest.mark.parametrize("apart", [3, 3.5, 4])
def test_a_second_sheet_three_spacings_away_changes_no_angular_gap_inside_and_keeps_those_of_the_edge_open(apart):
    sheet = shapes.disc(1200, seed=1)
    sheets = np.r_[sheet.points, sheet.points + sheet.spacing * np.array([0.3, 0.2, apart])]
    alone, gaps = (angular_gaps(points, nearest(points, 20))[:1200] for points in (sheet.points, sheets))
    on_edge = np.isin(np.arange(1200), sheet.boundary)
    assert np.allclose(gaps[~on_edge], alone[~on_edge])
    assert gaps[on_edge].min() > np.pi


def test_the_hull_test_finds_convex_boundaries_and_misses_concave_bends():
    convex, hollow = shapes.disc(400, seed=1), shapes.annulus(60, 8)
    is_found = hull_test(delaunay_star(convex.points, nearest(convex.points, 20)))
    assert set(np.flatnonzero(is_found)) == set(convex.boundary)
    is_found = hull_test(delaunay_star(hollow.points, nearest(hollow.points, 20)))
    radius = np.linalg.norm(hollow.points, axis=1)
    assert is_found[radius > 1 - 1e-9].all()
    assert not is_found[radius < 1 - 1e-9].any()


def test_the_hull_test_needs_stars():
    sheet = shapes.grid(5, 5)
    with pytest.raises(
        InputError,
        match="the neighbourhoods are not ordered, so no star is known to be open; use Delaunay stars",
    ):
        hull_test(nearest(sheet.points, 8))
