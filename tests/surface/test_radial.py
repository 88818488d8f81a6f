import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import flat, planar_discs, rotations, seeds

from pointchart import InputError, SolveError, shapes
from pointchart.surface import evaluate, fit_radial

ORDERS = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]


def wave(uv, du=0, dv=0):
    """A curved patch in closed form, and its derivatives."""
    of_u, of_v = np.array([1.0, 2, 3]), np.array([2.0, 1, 3])
    u, v = (uv[:, k, None] for k in (0, 1))
    return of_u**du * np.sin(of_u * u + du * np.pi / 2) * of_v**dv * np.sin(of_v * v + 1 + dv * np.pi / 2)


def noise(uv, seed=0):
    return np.random.default_rng(seed).normal(size=(len(uv), 3))


def inside(shape, seed=0, n=1000):
    """Random places in random triangles."""
    rng = np.random.default_rng(seed)
    corners = shape.uv[rng.choice(shape.triangles, n)]
    return np.einsum("nk,nkx->nx", rng.dirichlet(np.ones(3), n), corners)


def rms(values):
    return np.sqrt((values**2).mean())


@settings(max_examples=15)
@given(planar_discs(largest=1000), seeds)
def test_the_surface_passes_through_the_points(shape, seed):
    points = noise(shape.uv, seed)
    assert np.allclose(evaluate(fit_radial(points, shape.uv), shape.uv), points, rtol=0, atol=1e-10)


def test_the_surface_passes_through_points_whose_density_varies_a_hundred_times():
    shape = shapes.disc(2000, seed=4)
    uv = shape.uv * np.linalg.norm(shape.uv, axis=1, keepdims=True)
    surface = fit_radial(shape.points, uv)
    assert np.allclose(evaluate(surface, uv), shape.points, rtol=0, atol=1e-10)


@settings(max_examples=10)
@given(planar_discs(), seeds, st.sampled_from([0.0, 4.0]))
def test_quadratic_maps_are_reproduced_with_and_without_smoothing(shape, seed, smoothing):
    c = np.random.default_rng(seed).normal(size=(6, 3))
    u, v = shape.uv.T
    one, zero = np.ones_like(u), np.zeros_like(u)
    surface = fit_radial(np.stack([one, u, v, u * u, u * v, v * v], axis=1) @ c, shape.uv, smoothing=smoothing)
    slope = np.stack([zero, one, zero, 2 * u, v, zero], axis=1) @ c
    assert np.allclose(surface.derivatives(shape.uv, 1, 0), slope, rtol=0, atol=1e-8)
    assert np.allclose(surface.derivatives(shape.uv, 1, 1), c[4], rtol=0, atol=1e-6)
    assert np.allclose(surface.derivatives(shape.uv, 0, 2), 2 * c[5], rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    ("du", "dv", "below"), [(1, 0, (0, 0)), (0, 1, (0, 0)), (2, 0, (1, 0)), (1, 1, (1, 0)), (0, 2, (0, 1))]
)
def test_derivatives_are_the_limits_of_differences(du, dv, below):
    shape = shapes.disc(1000, seed=5)
    surface = fit_radial(wave(shape.uv), shape.uv)
    places, h = 0.9 * np.r_[inside(shape), shape.uv], 1e-5
    step = h * np.array([du - below[0], dv - below[1]])
    difference = (surface.derivatives(places + step, *below) - surface.derivatives(places - step, *below)) / (2 * h)
    assert np.allclose(difference, surface.derivatives(places, du, dv), rtol=0, atol=1e-6)


def test_second_derivatives_are_continuous():
    shape = shapes.disc(1000, seed=5)
    surface, places = fit_radial(wave(shape.uv), shape.uv), 0.9 * np.r_[inside(shape), shape.uv]
    for orders in ORDERS[3:]:
        jump = surface.derivatives(places + 1e-9, *orders) - surface.derivatives(places, *orders)
        assert np.abs(jump).max() < 1e-5


def test_errors_fall_with_the_third_power_of_the_spacing_and_a_power_less_for_each_derivative():
    counts, errors = (1000, 4000, 16000), []
    for n in counts:
        shape = shapes.disc(n, seed=1)
        surface, places = fit_radial(wave(shape.uv), shape.uv), inside(shape)
        errors.append([rms(surface.derivatives(places, k, 0) - wave(places, k, 0)) for k in range(3)])
    rates = -2 * np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert np.allclose(rates, [3.5, 2.4, 1.3], rtol=0, atol=0.5)


@pytest.mark.parametrize("smoothing", [4.0, 6.0, 8.0])
def test_noise_falls_as_one_over_the_smoothing(smoothing):
    sheet = shapes.grid(70, 70)
    surface = fit_radial(noise(sheet.uv), sheet.uv, smoothing=smoothing)
    inner = sheet.uv[np.abs(sheet.uv - 34.5).max(axis=1) < 25]
    share = 5 / 7 * np.pi / 7 / np.sin(2 * np.pi / 7)  # of the frequencies below that of the halved waves
    assert rms(evaluate(surface, inner)) == pytest.approx(np.sqrt(2 * np.pi * share) / smoothing, rel=0.1)


@pytest.mark.parametrize("length", [5.0, 6.0, 8.0])
def test_waves_as_long_as_the_smoothing_are_halved_by_wide_discs_and_others_follow_the_seventh_power(length):
    sheet = shapes.grid(60, 60)
    points = sheet.points + np.outer(np.cos(2 * np.pi * sheet.uv[:, 0] / length), [0, 0, 1])
    inner = np.abs(sheet.uv - 29.5).max(axis=1) < 15
    smooth = evaluate(fit_radial(points, sheet.uv, smoothing=6.0, nearby=432), sheet.uv[inner])[:, 2]
    left = (smooth @ points[inner, 2]) / (points[inner, 2] @ points[inner, 2])
    assert left == pytest.approx(1 / (1 + (6.0 / length) ** 7), abs=0.02)


@settings(max_examples=10)
@given(planar_discs(), rotations(), st.sampled_from([0.0, 4.0]))
def test_the_surface_moves_with_the_points(shape, rotation, smoothing):
    surface = fit_radial(wave(shape.uv), shape.uv, smoothing=smoothing)
    moved = fit_radial(wave(shape.uv) @ rotation.T + 5, shape.uv, smoothing=smoothing)
    for orders, shift in (((0, 0), 5), ((1, 0), 0), ((1, 1), 0)):
        expected = surface.derivatives(shape.uv, *orders) @ rotation.T + shift
        assert np.allclose(moved.derivatives(shape.uv, *orders), expected, rtol=0, atol=1e-8)


@settings(max_examples=10)
@given(planar_discs(), st.sampled_from([2.0**-9, 2.0**12]), st.sampled_from([0.0, 4.0]))
def test_the_surface_stays_when_the_parameters_are_scaled(shape, scale, smoothing):
    surface = fit_radial(wave(shape.uv), shape.uv, smoothing=smoothing)
    scaled = fit_radial(wave(shape.uv), scale * shape.uv, smoothing=smoothing)
    places = inside(shape)
    assert np.allclose(evaluate(scaled, scale * places), evaluate(surface, places), rtol=0, atol=1e-10)


@settings(max_examples=10)
@given(planar_discs(), seeds)
def test_discs_cover_the_rectangle_of_the_parameters_and_nothing_is_beyond(shape, seed):
    surface = fit_radial(shape.points, shape.uv, nearby=20)
    low, high = surface.domain
    places = np.random.default_rng(seed).uniform(low, high, (500, 2))
    assert np.isfinite(evaluate(surface, places)).all()
    assert np.isnan(evaluate(surface, places + (high - low))).all()


@settings(max_examples=10)
@given(planar_discs(), st.integers(12, 60))
def test_no_disc_reaches_a_point_that_its_spline_does_not_pass_through(shape, nearby):
    surface = fit_radial(shape.points, shape.uv, nearby=nearby)
    for u, v, radius, _ in surface.discs:
        assert (np.linalg.norm(shape.uv - [u, v], axis=1) < radius).sum() <= nearby


def test_the_surface_grows_in_proportion_to_the_points():
    sizes = [len(fit_radial(shape.points, shape.uv).discs) for shape in (shapes.grid(40, 40), shapes.grid(80, 80))]
    assert 3.5 < sizes[1] / sizes[0] < 4.5


SHEET = shapes.grid(9, 9)


@pytest.mark.parametrize(
    ("uv", "options", "message"),
    [
        (SHEET.uv[1:], {}, "parameters have shape"),
        (np.where(SHEET.uv == 0, np.nan, SHEET.uv), {}, "17 points are NaN or infinite"),
        (SHEET.uv - (SHEET.uv == 8), {}, r"points \d+, \d+, \d+ and 29 more share their parameters"),
        (SHEET.uv * [1, 50], {"nearby": 8}, "the 8 parameters nearest to .* raise nearby"),
        (SHEET.uv, {"smoothing": -1}, "the smoothing is -1 spacings; it has to be 0 to 10"),
        (SHEET.uv, {"smoothing": np.nan}, "the smoothing is nan"),
        (SHEET.uv, {"nearby": 5}, "5 nearby points determine no quadratic"),
    ],
)
def test_input_that_determines_no_surface_is_refused(uv, options, message):
    with pytest.raises(InputError, match=message):
        fit_radial(SHEET.points, uv, **options)


def test_too_few_points_are_refused():
    with pytest.raises(InputError, match="the scan has 5 points; a surface patch needs at least 6"):
        fit_radial(flat(np.eye(5, 2)), np.eye(5, 2))


@pytest.mark.parametrize("gap", [1e-9, 1e-15])
def test_a_surface_that_misses_points_is_refused_and_smoothing_is_the_remedy(gap):
    uv = SHEET.uv.copy()
    uv[40] = uv[41] - [gap, 0]
    with pytest.raises(SolveError, match=r"misses point \d+ by .* points 4[01], 4[01] are only .* spacings apart"):
        fit_radial(noise(uv), uv)
    assert np.isfinite(evaluate(fit_radial(noise(uv), uv, smoothing=4.0), uv)).all()


def test_derivatives_that_are_not_continuous_are_refused():
    with pytest.raises(InputError, match="order 2 in u and 1 in v is not continuous"):
        fit_radial(SHEET.points, SHEET.uv).derivatives(SHEET.uv, 2, 1)
