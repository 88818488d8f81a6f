"""Trimmed surfaces of scans: loops, feet, refusals, and what motion and scale leave as it is."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.path import Path
from scipy.spatial.transform import Rotation
from strategies import seeds

from pointchart import InputError, SolveError, shapes
from pointchart.boundary import chord_length_steps, on_square, sharpest_places
from pointchart.plane.exact_signs import is_simple
from pointchart.surface import Deviation, closest_parameters, evaluate
from pointchart.surface.surfacing import check_met, fit_scan, without_spikes

FAIR = 1e-7  # given, so that there are no others to try
WHOLE = {
    "half a sphere": lambda: shapes.hemisphere(500),
    "a cap beyond the half sphere": lambda: shapes.hemisphere(500, angle=130),
    "a rolled sheet": lambda: shapes.bent_sheet(200, nx=30, ny=18),
    "a relief": lambda: shapes.relief(500, seed=2),
}
PIERCED = {
    "a pierced half sphere": lambda: shapes.pierce(shapes.hemisphere(1200), n_gaps=3),
    "a pierced cap": lambda: shapes.pierce(shapes.hemisphere(1200, angle=105), n_gaps=2, radius_in_spacings=3.0),
}


@pytest.fixture(scope="module", params=WHOLE | PIERCED)
def surfaced(request):
    """A shape and its surface, fitted to the points alone."""
    shape = (WHOLE | PIERCED)[request.param]()
    return shape, fit_scan(shape.points, tolerance=0.003 * diagonal(shape.points), fairness=FAIR)


def diagonal(points):
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def area(polygon):
    ahead = np.roll(polygon, -1, axis=0)
    return 0.5 * (polygon[:, 0] * ahead[:, 1] - polygon[:, 1] * ahead[:, 0]).sum()


def turns(polygon):
    """Angles in degrees by which a polygon turns at its corners."""
    ahead = np.roll(polygon, -1, axis=0) - polygon
    behind = np.roll(ahead, 1, axis=0)
    cross = behind[:, 0] * ahead[:, 1] - behind[:, 1] * ahead[:, 0]
    return np.rad2deg(np.abs(np.arctan2(cross, (ahead * behind).sum(axis=1))))


def feet_of(loop, uv):
    """Return which points have their feet at the corners of a loop."""
    return (uv[:, None] == loop).all(axis=2).any(axis=1)


# Loops


def test_there_is_a_simple_loop_for_the_boundary_and_for_every_gap(surfaced):
    shape, result = surfaced
    assert len(result.loops) == len(shape.loops)
    assert all(is_simple(loop) for loop in result.loops)


def test_the_boundary_runs_anticlockwise_and_gaps_clockwise_inside_it(surfaced):
    _, result = surfaced
    areas = [area(loop) for loop in result.loops]
    assert areas[0] > 0
    assert all(hole < 0 for hole in areas[1:])
    assert sum(areas) > 0
    for hole in result.loops[1:]:
        assert Path(result.loops[0]).contains_points(hole).all()


def test_the_corners_of_loops_are_feet_of_boundary_points(surfaced):
    shape, result = surfaced
    on_rim = np.unique(np.concatenate(shape.loops))
    for loop in result.loops:
        at = np.flatnonzero(feet_of(loop, result.fit.uv))
        assert len(at) == len(loop)
        assert np.isin(result.reconstruction.rows[at], on_rim).all()


def test_loops_have_no_needles(surfaced):
    assert all(turns(loop).max() <= 120 for loop in surfaced[1].loops)


def test_every_point_inside_has_its_foot_inside_the_boundary_and_in_no_gap(surfaced):
    shape, result = surfaced
    inner = ~np.isin(result.reconstruction.rows, np.concatenate(shape.loops))
    feet = result.fit.uv[inner]
    assert Path(result.loops[0]).contains_points(feet).all()
    for hole in result.loops[1:]:
        assert not Path(hole).contains_points(feet).any()


# Surfaces


def test_the_surface_is_within_the_tolerance_that_it_says_it_is(surfaced):
    shape, result = surfaced
    tolerance = 0.003 * diagonal(shape.points)
    assert result.fit.is_met
    assert result.deviation.largest(0.005) <= tolerance
    check_met(result, tolerance, 0.005)
    points = shape.points[result.reconstruction.rows]
    off = np.linalg.norm(evaluate(result.fit.surface, result.fit.uv) - points, axis=1)
    assert np.allclose(np.abs(result.deviation.signed), off, rtol=0, atol=1e-14)


def test_feet_are_those_of_the_nearest_points(surfaced):
    shape, result = surfaced
    points, surface = shape.points[result.reconstruction.rows], result.fit.surface
    better = evaluate(surface, closest_parameters(surface, points, result.fit.uv)) - points
    gained = np.abs(result.deviation.signed) - np.linalg.norm(better, axis=1)
    assert gained.min() >= -1e-14
    assert gained.max() < 1e-3 * diagonal(points) * 0.003


def test_parameters_extend_most_along_u_and_keep_the_area_of_the_surface(surfaced):
    _, result = surfaced
    spread = np.cov(result.fit.uv.T)
    assert spread[0, 0] >= spread[1, 1] - 1e-3
    assert abs(spread[0, 1]) < 0.05 * spread[0, 0]


def test_a_sheet_rolled_up_comes_out_as_large_as_it_is():
    result = fit_scan(shapes.roll(shapes.grid(30, 18), 270).points, tolerance=0.1, fairness=FAIR)
    assert area(result.loops[0]) == pytest.approx(29 * 17, rel=0.01)


def test_a_patch_on_the_square_is_trimmed_by_nothing_but_its_domain():
    sheet = shapes.bent_sheet(120, nx=24, ny=16)

    def square(points, loop):
        return on_square(chord_length_steps(points, loop), sharpest_places(points, loop))

    result = fit_scan(sheet.points, tolerance=0.01 * diagonal(sheet.points), square=square, fairness=FAIR)
    (u0, v0), (u1, v1) = result.fit.surface.domain
    assert [loop.tolist() for loop in result.loops] == [[[u0, v0], [u1, v0], [u1, v1], [u0, v1]]]
    assert result.fit.is_met


# Motion and scale


@pytest.mark.parametrize(("turn", "scale"), [(0.4, 2.0**-10), (2.0, 2.0**9)])
def test_the_deviation_follows_motion_and_scale(turn, scale):
    """To a hundredth of the tolerance: the search for the least distortion lets rounding grow."""
    points = shapes.add_noise(shapes.relief(400, seed=2), sigma_in_spacings=0.05).points
    rotation = Rotation.from_rotvec([turn, 0.3, -turn]).as_matrix()
    before, after = (
        fit_scan(cloud, tolerance=size * 0.03, fairness=FAIR)
        for cloud, size in ((points, 1.0), (scale * points @ rotation.T, scale))
    )
    assert [level.n_control for level in after.fit.levels] == [level.n_control for level in before.fit.levels]
    for figure in (lambda d: d.rms, Deviation.largest, lambda d: d.percentile(50)):
        assert figure(after.deviation) / scale == pytest.approx(figure(before.deviation), abs=3e-4)


def test_a_scale_by_a_power_of_two_leaves_every_deviation_as_it_is_to_rounding():
    points = shapes.hemisphere(400).points
    before, after = (fit_scan(s * points, tolerance=s * 0.01, fairness=FAIR).deviation.signed for s in (1, 4096))
    assert np.allclose(after / 4096, before, rtol=0, atol=1e-11)


# Refusals


@pytest.mark.parametrize("unit", [1e-3, 1.0, 25.4])
def test_a_tolerance_in_another_unit_is_refused(unit):
    points = unit * shapes.hemisphere(300).points
    across = diagonal(points)
    with pytest.raises(
        InputError, match=rf"^the tolerance of .* is 0.5 times the scan, {across:.4g} across: is it in an"
    ):
        fit_scan(points, tolerance=0.5 * across)
    with pytest.raises(InputError, match="Give it in the unit of the scan"):
        fit_scan(points, tolerance=0.101 * across)


def test_a_scan_that_is_no_array_of_points_is_refused_as_everywhere():
    for scan, message in (
        ([[1, 2, 3], [4, 5]], "points are no array of numbers"),
        (np.ones((9, 2)), r"points have shape \(9, 2\)"),
        (np.full((9, 3), np.nan), "9 points are NaN or infinite"),
        (np.ones((9, 3)), "all 9 points are the same"),
    ):
        with pytest.raises(InputError, match=message):
            fit_scan(scan, tolerance=0.01)


def test_a_gap_as_large_as_the_boundary_is_not_taken_for_either():
    ring = shapes.annulus(400)
    with pytest.raises(SolveError, match="the surface has a second boundary"):
        fit_scan(ring.points, tolerance=0.01)


def test_a_surface_out_of_tolerance_is_refused_with_its_figures_and_the_remedy():
    shape = shapes.relief(400, seed=2)
    missed = fit_scan(shape.points, tolerance=1e-6, max_control=60, fairness=FAIR)
    assert not missed.fit.is_met
    off = missed.deviation
    with pytest.raises(SolveError) as refusal:
        check_met(missed, 1e-6, 0.005)
    assert str(refusal.value) == (
        f"the surface of {missed.fit.surface.n_control} control points deviates by {off.largest(0.005):.4g} but for "
        f"0.5 % of the points (RMS {off.rms:.4g}), more than the tolerance of 1e-06; allow more control points, take "
        "a larger tolerance, or take the best that there is"
    )
    noisy = replace(missed, fit=replace(missed.fit, is_noise=True))
    held_out = min(level.held_out for level in missed.fit.levels)
    advice = max(3 * held_out, 1.1 * off.largest(0.005))
    with pytest.raises(
        SolveError, match=rf"stay {held_out:.3g} away \(RMS\), which allows a tolerance of about {advice:.2g}; take"
    ):
        check_met(noisy, 1e-6, 0.005)
    check_met(replace(missed, fit=replace(missed.fit, is_met=True)), 1e-6, 0.005)


# Spikes


@given(st.integers(3, 40), seeds)
def test_corners_that_are_left_are_those_of_the_polygon_in_order_and_turn_by_at_most_120_degrees(n, seed):
    polygon = np.random.default_rng(seed).normal(size=(n, 2))
    left = without_spikes(polygon)
    place = [int(np.flatnonzero((polygon == corner).all(axis=1))[0]) for corner in left]
    assert place == sorted(set(place))
    assert len(left) == 3 or turns(left).max() <= 120 + 1e-9
    assert np.array_equal(without_spikes(left), left)


@given(st.integers(4, 60), st.floats(0.1, 9))
def test_convex_polygons_of_obtuse_corners_have_no_spikes(n, radius):
    turn = 2 * np.pi * np.arange(n) / n
    polygon = radius * np.c_[np.cos(turn), np.sin(turn)]
    assert np.array_equal(without_spikes(polygon), polygon)


@given(st.integers(5, 40), st.floats(2, 50), seeds)
def test_a_needle_is_taken_off_a_circle_and_nothing_else_whatever_the_pose(n, length, seed):
    turn = 2 * np.pi * np.arange(n) / n
    circle = np.c_[np.cos(turn), np.sin(turn)]
    rng = np.random.default_rng(seed)
    k, angle = int(rng.integers(1, n)), rng.uniform(0, 2 * np.pi)
    root = 0.5 * (circle[k] + circle[k - 1])
    needle = np.insert(circle, k, root * (1 + length * np.linalg.norm(circle[k] - circle[k - 1])), axis=0)
    turned = 100 * needle @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]) + 7
    assert np.array_equal(without_spikes(turned), np.delete(turned, k, axis=0))


def test_three_corners_stay():
    needle = np.array([[0.0, 0], [9, 0], [0, 0.1]])
    assert np.array_equal(without_spikes(needle), needle)


def test_corners_that_coincide_are_no_spikes_and_hide_none():
    polygon = np.array([[0.0, 0], [4, 0], [4, 0], [4, 4], [2, 4], [2, 9], [1.9, 4], [0, 4]])
    left = without_spikes(polygon)
    assert [2, 9] not in left.tolist()
    assert {(0, 0), (4, 0), (4, 4), (0, 4)} <= {tuple(corner) for corner in left.tolist()}


def test_a_needle_that_comes_back_to_its_foot_leaves_no_double_corner():
    needle = np.array([[0.0, 0], [4, 0], [4, 4], [2, 4], [2, 9], [2, 4], [0, 4]])
    assert without_spikes(needle).tolist() == [[0, 0], [4, 0], [4, 4], [2, 4], [0, 4]]
