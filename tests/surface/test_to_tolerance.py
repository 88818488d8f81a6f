"""Surfaces refined until they are within a tolerance: what they promise, what ends them, and the rate."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree
from strategies import rotations, seeds

from pointchart import InputError, reconstruct, shapes, uv_free_boundary
from pointchart.surface import (
    Deviation,
    closest_parameters,
    evaluate,
    fit_bspline,
    huber,
    least_squares,
    measure_deviation,
    squares,
)

FAIR = 1e-7  # given, so that there are no others to try


def square(n=900, seed=0):
    return np.random.default_rng(seed).random((n, 2))


def waves(uv):
    """Raise waves over a plane, three of them across."""
    return np.c_[uv, 0.1 * np.sin(9 * uv[:, 0]) * np.cos(7 * uv[:, 1])]


def noisy_plane(n=900, sigma=0.01, seed=0):
    uv = square(n, seed)
    return np.c_[uv, sigma * np.random.default_rng(seed + 1).normal(size=n)], uv


def searched_distances(surface, points):
    """Distances by search alone: the nearest of a dense grid, and of ever finer ones around that."""
    low, high = surface.domain
    grid = np.stack(np.meshgrid(*np.linspace(low, high, 100).T), axis=-1).reshape(-1, 2)
    best, step = grid[cKDTree(evaluate(surface, grid)).query(points)[1]], (high - low) / 99
    around = np.stack(np.meshgrid(np.linspace(-1, 1, 11), np.linspace(-1, 1, 11)), axis=-1).reshape(-1, 2)
    for _ in range(8):
        near = np.clip(best[:, None] + step * around, low, high)
        off = evaluate(surface, near.reshape(-1, 2)).reshape(*near.shape[:2], 3) - points[:, None]
        nearest = np.argmin((off**2).sum(axis=2), axis=1)
        best, step = near[np.arange(len(points)), nearest], 0.25 * step
    return np.linalg.norm(evaluate(surface, best) - points, axis=1)


def rms(values):
    return np.sqrt((values**2).mean())


# What is promised


@pytest.mark.parametrize("outliers", [0.0, 0.02])
@pytest.mark.parametrize("tolerance", [0.02, 0.002])
def test_a_surface_that_meets_its_tolerance_does_so_by_an_independent_search(tolerance, outliers):
    uv = square()
    points = waves(uv)
    fit = fit_bspline(points, uv, tolerance=tolerance, outliers=outliers, fairness=FAIR)
    assert fit.is_met
    found = searched_distances(fit.surface, points)
    assert (found > tolerance).sum() <= outliers * len(points)
    assert np.allclose(np.linalg.norm(evaluate(fit.surface, fit.uv) - points, axis=1), found, rtol=0, atol=1e-6)


def test_the_corrected_parameters_are_those_of_the_nearest_points():
    """Not those that were given, which lag behind by as much as a tenth."""
    uv = square()
    points = waves(uv)
    skewed = uv + 0.1 * np.c_[np.sin(3 * uv[:, 1]), uv[:, 0] ** 2]
    fit = fit_bspline(points, skewed, tolerance=0.004, fairness=FAIR)
    better = closest_parameters(fit.surface, points, fit.uv)
    nearer = rms(evaluate(fit.surface, fit.uv) - points) - rms(evaluate(fit.surface, better) - points)
    assert 0 <= nearer < 1e-6
    assert np.abs(better - fit.uv).max() < 1e-3


@settings(max_examples=4)
@given(st.integers(2, 5), st.integers(0, 250), st.integers(150, 500))
def test_there_are_never_more_control_points_than_allowed_and_each_level_has_more(degree, more, n):
    uv, most = square(n), (4 + degree) ** 2 + more
    fit = fit_bspline(waves(uv), uv, tolerance=1e-9, max_control=most, degree=degree, fairness=FAIR)
    counts = [level.n_control for level in fit.levels]
    assert (np.diff(counts) > 0).all()
    assert counts[-1] <= min(n, most)
    assert fit.surface.n_control in counts
    assert fit.surface.degree == degree


@pytest.mark.parametrize("aspect", [3, 20, 300])
def test_a_strip_has_no_more_control_points_than_allowed_either(aspect):
    uv = square(600) * [aspect, 1]
    fit = fit_bspline(np.c_[uv, np.sin(uv[:, 0])], uv, tolerance=1e-9, max_control=100, fairness=FAIR)
    assert max(level.n_control for level in fit.levels) <= 100


def test_half_as_many_control_points_as_points_are_allowed_if_nothing_is_said():
    uv = square(300)
    points = waves(uv) + 0.02 * np.random.default_rng(5).normal(size=(300, 3))
    counts = [level.n_control for level in fit_bspline(points, uv, tolerance=1e-9, fairness=FAIR).levels]
    assert counts[0] == 49
    assert 49 < counts[-1] <= 150


@pytest.mark.parametrize("tolerance", [0.05, 0.01, 0.001])
def test_refinement_ends_at_the_first_level_within_the_tolerance(tolerance):
    uv = square()
    fit = fit_bspline(waves(uv), uv, tolerance=tolerance, fairness=FAIR)
    assert fit.is_met
    assert not fit.is_noise
    assert all(level.largest > tolerance for level in fit.levels[:-1])
    assert fit.levels[-1].largest <= tolerance
    assert fit.levels[-1].n_control == fit.surface.n_control


def test_a_finer_tolerance_takes_more_control_points_by_the_same_levels():
    uv = square()
    coarse, fine = (fit_bspline(waves(uv), uv, tolerance=t, fairness=FAIR) for t in (0.02, 1e-4))
    assert coarse.surface.n_control < fine.surface.n_control
    assert coarse.levels[0].rms == fine.levels[0].rms


@pytest.mark.parametrize("seed", [4, 5])
def test_a_tolerance_that_a_level_meets_is_met_in_the_end(seed):
    """The last fit, to all points, may be a little farther: then there are more control points to take."""
    points, uv = noisy_plane(200, seed=seed)
    just = fit_bspline(points, uv, tolerance=1.0, outliers=0.0, fairness=FAIR).levels[0].largest * (1 + 1e-7)
    fit = fit_bspline(points, uv, tolerance=just, outliers=0.0, max_control=150, fairness=FAIR)
    assert fit.is_met
    assert Deviation(np.linalg.norm(evaluate(fit.surface, fit.uv) - points, axis=1)).largest() <= just


@settings(max_examples=2)
@given(seeds)
def test_quadratic_patches_are_met_at_the_first_level(seed):
    rng = np.random.default_rng(seed)
    uv = square(300)
    u, v = uv.T
    bowl = np.c_[uv, np.stack([u * u, u * v, v * v], axis=1) @ rng.uniform(-1, 1, 3)]
    fit = fit_bspline(bowl, uv, tolerance=1e-5)
    assert fit.is_met
    assert [level.n_control for level in fit.levels] == [49]


def test_spans_are_halved_where_points_are_out_of_tolerance():
    """A bump in one corner draws knots there, in both directions."""
    uv = square(1500)
    bump = np.c_[uv, 0.05 * np.exp(-((uv - 0.8) ** 2).sum(axis=1) / 0.05**2)]
    surface = fit_bspline(bump, uv, tolerance=1e-3, fairness=FAIR).surface
    for knots in (surface.knots_u, surface.knots_v):
        spans = np.unique(knots)
        near = np.count_nonzero(np.abs(spans - 0.8) < 0.2)
        assert near > 2 * np.count_nonzero(np.abs(spans - 0.2) < 0.2)


@pytest.mark.parametrize("margin", [0.0, 0.3])
def test_the_domain_is_larger_than_the_parameters_by_the_margin(margin):
    uv = square(300) * [1, 3] + 7
    domain = fit_bspline(waves(uv), uv, tolerance=1.0, margin=margin, fairness=FAIR).surface.domain
    room = margin * np.ptp(uv, axis=0).min()
    assert np.allclose(domain, [uv.min(axis=0) - room, uv.max(axis=0) + room], rtol=0, atol=1e-13)


def test_points_held_out_choose_a_fair_surface_for_noise_and_a_near_one_for_shape():
    points, uv = noisy_plane(130)
    chosen = fit_bspline(points, uv, tolerance=1.0).levels[0]
    near = fit_bspline(points, uv, tolerance=1.0, fairness=1e-9).levels[0]
    assert (chosen.fairness, near.fairness) == (0.1, 1e-9)
    assert chosen.held_out < near.held_out
    assert fit_bspline(waves(square(400)), square(400), tolerance=1.0).levels[0].fairness == 1e-9


# Noise and outliers


@pytest.mark.parametrize("seed", [0])
def test_a_tolerance_far_under_the_noise_ends_at_noise_and_says_so(seed):
    points, uv = noisy_plane(900, seed=seed)
    fit = fit_bspline(points, uv, tolerance=1e-4)
    assert fit.is_noise
    assert not fit.is_met
    assert min(level.held_out for level in fit.levels) == pytest.approx(0.01, rel=0.25)
    # The surface itself is nearer to the plane than the noise is.
    assert rms(evaluate(fit.surface, fit.uv)[:, 2]) < 0.005


def test_noise_that_no_level_can_be_tried_for_ends_at_the_limit():
    points, uv = noisy_plane(900)
    fit = fit_bspline(points, uv, tolerance=1e-4, max_control=60)
    assert not fit.is_met
    assert not fit.is_noise
    assert len(fit.levels) == 1


def test_a_smooth_surface_is_not_taken_for_noise():
    uv = square()
    fit = fit_bspline(waves(uv), uv, tolerance=1e-12, max_control=250, fairness=FAIR)
    assert not fit.is_noise
    assert not fit.is_met


def with_spikes(share):
    """A bent sheet, and as many of its points as the share says moved by a tenth of its size to one side."""
    uv = square(1200)
    points = np.c_[uv, 0.3 * uv[:, 0] ** 2]
    spikes = np.random.default_rng(9).random(len(uv)) < share
    return points + np.outer(0.1 * spikes, [0, 0, 1.0]), uv, points, spikes


def test_gross_outliers_move_a_surface_of_huber_less_than_one_of_squares():
    points, uv, truth, _ = with_spikes(0.05)
    far = {}
    for loss in (squares, huber):
        fit = fit_bspline(points + 1e-3 * waves(uv)[:, ::-1], uv, tolerance=1.0, loss=loss, fairness=FAIR)
        far[loss] = rms(searched_distances(fit.surface, truth + 1e-3 * waves(uv)[:, ::-1]))
    assert far[huber] < 0.5 * far[squares]


def test_the_share_of_outliers_may_be_out_of_tolerance_and_no_more():
    points, uv, truth, spikes = with_spikes(0.01)
    options = {"tolerance": 0.02, "max_control": 60, "loss": huber, "fairness": FAIR}
    share = spikes.mean()
    allowed = fit_bspline(points, uv, outliers=share + 1e-6, **options)
    assert allowed.is_met
    assert rms(searched_distances(allowed.surface, truth)) < 0.005
    assert not fit_bspline(points, uv, outliers=share / 2, **options).is_met


@given(st.lists(st.floats(0, 1e6), min_size=1, max_size=40))
def test_huber_weighs_by_the_inverse_of_the_distance_beyond_a_reach(residuals):
    residuals = np.array(residuals)
    weights = huber(residuals)
    reach = 1.345 * 1.4826 * np.median(residuals)
    assert ((weights > 0) & (weights <= 1)).all()
    assert (weights[residuals <= reach] == 1).all()
    assert np.allclose((weights * residuals)[(residuals > reach) & (reach > 0)], reach, rtol=1e-12)
    assert np.allclose(huber(1024 * residuals), weights, rtol=1e-12)
    assert (squares(residuals) == 1).all()


def test_points_that_are_as_good_as_exact_all_count_the_same():
    assert huber(np.array([0.0, 0, 0, 5])).tolist() == [1, 1, 1, 1]


def test_weights_of_one_over_the_variance_bring_the_surface_nearer_and_equal_ones_change_nothing():
    uv = square(800)
    sigma = np.where(uv[:, 0] + 0.2 * np.random.default_rng(3).normal(size=len(uv)) < 0.5, 0.03, 0.001)
    points = waves(uv) + np.outer(sigma * np.random.default_rng(4).normal(size=len(uv)), [0, 0, 1])
    options = {"tolerance": 1e-9, "max_control": 150, "fairness": FAIR}
    plain, equal, weighed = (
        fit_bspline(points, uv, weights=w, **options) for w in (None, np.full(len(uv), 4.0), 1e-6 / sigma**2)
    )
    assert np.allclose(equal.surface.control, plain.surface.control, rtol=0, atol=1e-9)
    good = waves(uv)[sigma == 0.001]
    assert rms(searched_distances(weighed.surface, good)) < 0.5 * rms(searched_distances(plain.surface, good))


# Invariances


@settings(max_examples=2)
@given(rotations(), st.sampled_from([2.0**-20, 1.0, 2.0**10]))
def test_the_same_surface_comes_of_turned_and_scaled_points(rotation, scale):
    uv = square(400)
    points, shift = waves(uv), np.array([3.0, -2, 5])
    before = fit_bspline(points, uv, tolerance=0.01)
    after = fit_bspline(scale * (points @ rotation.T + shift), uv, tolerance=scale * 0.01)
    assert [level.n_control for level in after.levels] == [level.n_control for level in before.levels]
    expected = scale * (before.surface.control @ rotation.T + shift)
    assert np.allclose(after.surface.control, expected, rtol=0, atol=1e-7 * scale)
    assert np.allclose(after.uv, before.uv, rtol=0, atol=1e-7)


def test_a_scale_by_a_power_of_two_changes_not_a_bit():
    uv = square(400)
    before = fit_bspline(waves(uv), uv, tolerance=0.01)
    after = fit_bspline(1024 * waves(uv), uv, tolerance=10.24)
    assert np.array_equal(after.uv, before.uv)
    assert [level.rms for level in after.levels] == [1024 * level.rms for level in before.levels]


@pytest.mark.parametrize(("unit", "offset"), [(1e-6, 0.0), (1.0, 5.0), (4096.0, -1e4)])
def test_neither_the_unit_nor_the_offset_of_the_parameters_matters(unit, offset):
    uv = square(400)
    before = fit_bspline(waves(uv), uv, tolerance=0.01)
    after = fit_bspline(waves(uv), unit * uv + offset, tolerance=0.01)
    assert [level.n_control for level in after.levels] == [level.n_control for level in before.levels]
    # Their levels agree to the rounding of the offset over the unit.
    assert np.allclose(after.surface.control, before.surface.control, rtol=0, atol=1e-5)


# Rate


@cache
def spread_out(name):
    """Return the points of a shape and the parameters with a free boundary that come of them alone."""
    shape = {
        "half a sphere": lambda: shapes.hemisphere(2000),
        "a cap beyond the half sphere": lambda: shapes.hemisphere(2000, angle=130),
        "a rolled sheet": lambda: shapes.bent_sheet(270, nx=60, ny=35),
    }[name]()
    result = reconstruct(shape.points, chart=uv_free_boundary)
    return shape.points[result.rows], result.uv


def deviation_of(points, uv, n_spans):
    """Fit with even knots, correct the parameters, fit again; return the RMS at the feet."""
    room = 0.02 * np.ptp(uv, axis=0).min()
    low, high = uv.min(axis=0) - room, uv.max(axis=0) + room
    knots = [np.r_[[low[k]] * 3, np.linspace(low[k], high[k], n_spans + 1), [high[k]] * 3] for k in (0, 1)]
    for _ in range(4):
        surface = least_squares(points, uv, *knots, fairness=1e-9)
        uv = closest_parameters(surface, points, uv, n_steps=3)
    return measure_deviation(points, surface, uv).rms


@pytest.mark.parametrize("name", ["half a sphere", "a cap beyond the half sphere", "a rolled sheet"])
def test_the_deviation_of_cubic_surfaces_falls_with_the_fourth_power_of_the_spans(name):
    spans = (5, 8, 12)
    errors = [deviation_of(*spread_out(name), n) for n in spans]
    assert -np.polyfit(np.log(spans), np.log(errors), 1)[0] == pytest.approx(4, abs=0.3)


# Bad input


def test_input_that_determines_no_surface_is_refused_with_the_number_and_the_remedy():
    uv = square(400)
    points = waves(uv)
    lost = uv.copy()
    lost[[3, 8]] = np.nan, np.inf
    for given_points, given_uv, options, message in (
        (points, uv, {"tolerance": 0.0}, "the tolerance is 0; it has to be positive and finite, in the unit of the"),
        (points, uv, {"tolerance": -1.0}, "the tolerance is -1; it has"),
        (points, uv, {"tolerance": np.nan}, "the tolerance is nan; it has"),
        (points, uv, {"tolerance": np.inf}, "the tolerance is inf; it has"),
        (points, uv, {"outliers": 1.0}, "the share of outliers is 1; it has to be at least 0 and below 1"),
        (points, uv, {"outliers": -0.1}, "the share of outliers is -0.1; it"),
        (points, uv, {"outliers": np.nan}, "the share of outliers is nan; it"),
        (points, uv, {"degree": 1}, "the degree is 1; it has to be 2, 3, 4 or 5"),
        (points, uv, {"degree": 6}, "the degree is 6; it has"),
        (points, uv, {"max_control": 48}, "48 control points are too few: the coarsest surface of degree 3 has 49"),
        (points, uv, {"degree": 5, "max_control": 80}, "80 control .* coarsest surface of degree 5 has 81"),
        (
            points[:97],
            uv[:97],
            {},
            "48 control points, half as many as points, are too few: the coarsest surface of degree 3 has 49",
        ),
        (points, uv * [1, 0], {}, "the parameters lie on one line, so they hold no surface; give one-to-one"),
        (points, lost, {}, "the parameters of 2 points are NaN or infinite, the first of point 3"),
        (points, uv[1:], {}, r"parameters have shape \(399, 2\); \(400, 2\) is needed: u, v for each point"),
        (points, points, {}, r"parameters have shape \(400, 3\); \(400, 2\) is needed"),
        (points[:, :2], uv, {}, r"points have shape \(400, 2\); \(n, 3\) is needed"),
        (np.outer(uv[:, 0], [1, 2, 3]), uv, {}, "all 400 points lie on one line"),
        (points, uv, {"weights": np.ones(399)}, r"weights have shape \(399,\); \(400,\) is needed: one for each point"),
        (points, uv, {"weights": np.r_[-1.0, 0, np.ones(398)]}, "2 weights are not positive .* first -1 at index 0"),
        (points, uv, {"weights": np.r_[1.0, np.nan, np.ones(398)]}, "1 weights .* the first nan at index 1"),
    ):
        with pytest.raises(InputError, match=message):
            fit_bspline(given_points, given_uv, **{"tolerance": 0.01, "fairness": FAIR} | options)


def test_fewer_points_than_the_coarsest_surface_has_control_points_are_refused_whatever_is_allowed():
    uv = square(40)
    with pytest.raises(
        InputError,
        match=r"40 control points are too few: the coarsest surface of degree 3 has 49; allow more, up to the 40",
    ):
        fit_bspline(waves(uv), uv, tolerance=0.01, max_control=100)


def test_points_held_out_are_no_row_of_a_lattice():
    """Scanners deliver rows of ten points as well: then every tenth point would be the same border."""
    u, v = np.meshgrid(np.linspace(0, 1, 10), np.linspace(0, 3, 100))
    uv = np.column_stack([u.ravel(), v.ravel()])
    points = np.column_stack([uv, 0.1 * np.sin(6 * uv[:, 0]) * np.cos(9 * uv[:, 1])])
    fit = fit_bspline(points, uv, tolerance=1e-3, outliers=0.0)
    assert fit.is_met
    assert fit.levels[-1].held_out < 1e-3
