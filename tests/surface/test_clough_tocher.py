from math import factorial

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.interpolate import CloughTocher2DInterpolator
from scipy.spatial import Delaunay
from strategies import convex_discs, flat, planar_discs, rotations, seeds

from pointchart import InputError, shapes
from pointchart.mesh.connectivity import half_edges
from pointchart.mesh.planar_delaunay import triangulate
from pointchart.surface import evaluate, interpolate_clough_tocher

SQUARE = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
HALVES = np.array([[0, 1, 2], [0, 2, 3]])
ORDERS = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]


def powers(degree):
    return [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]


def polynomial(seed, degree):
    """Return a random map to space and its derivatives as one function of uv, du and dv."""
    terms = dict(zip(powers(degree), np.random.default_rng(seed).normal(size=(10, 3)), strict=False))

    def derivative(uv, du=0, dv=0):
        u, v = uv.T
        total = np.zeros((len(uv), 3))
        for (i, j), c in terms.items():
            if i >= du and j >= dv:
                factor = factorial(i) / factorial(i - du) * factorial(j) / factorial(j - dv)
                total += (factor * u ** (i - du) * v ** (j - dv))[:, None] * c
        return total

    return derivative


def wave(uv, du=0, dv=0):
    """A curved patch in closed form, and its derivatives."""
    of_u, of_v = np.array([1.0, 2, 3]), np.array([2.0, 1, 3])
    u, v = (uv[:, k, None] for k in (0, 1))
    return of_u**du * np.sin(of_u * u + du * np.pi / 2) * of_v**dv * np.sin(of_v * v + 1 + dv * np.pi / 2)


def gradients(function, uv):
    return np.stack([function(uv, 1, 0), function(uv, 0, 1)], axis=1)


def inside(shape, seed, n=200):
    """Random places in random triangles."""
    rng = np.random.default_rng(seed)
    corners = shape.uv[rng.choice(shape.triangles, n)]
    return np.einsum("nk,nkx->nx", rng.dirichlet(np.ones(3), n), corners)


def expand(surface, places, steps, du, dv):
    """Go on from places by the Taylor series, which is exact on each cubic."""
    u, v = steps.T
    return sum(
        (u**i * v**j / factorial(i) / factorial(j))[:, None] * surface.derivatives(places, du + i, dv + j)
        for i, j in powers(3 - du - dv)
    )


def one_sided(surface, places, towards, du, dv):
    """Return a derivative at places on a seam, as the limit from one side."""
    beside = places + 0.1 * (towards - places)
    return expand(surface, beside, places - beside, du, dv)


@settings(max_examples=20)
@given(planar_discs(), seeds)
def test_the_surface_passes_through_the_points_exactly(shape, seed):
    points = np.random.default_rng(seed).normal(size=(len(shape.uv), 3))
    surface = interpolate_clough_tocher(points, shape.uv, shape.triangles)
    assert np.array_equal(evaluate(surface, shape.uv), points)


@settings(max_examples=40)
@given(convex_discs(), seeds)
def test_the_surface_passes_through_points_whose_parameters_huddle(disc, seed):
    uv, loop = disc
    assume(len(uv) > 3)
    points = np.random.default_rng(seed).normal(size=(len(uv), 3))
    surface = interpolate_clough_tocher(points, uv, triangulate(uv, loop))
    assert np.allclose(evaluate(surface, uv), points, rtol=0, atol=1e-9)
    assert np.isfinite(surface.gradients).all()


def assert_same(surface, exact, places):
    for du, dv in ORDERS:
        assert np.allclose(surface.derivatives(places, du, dv), exact(places, du, dv), rtol=0, atol=1e-9)


@settings(max_examples=10)
@given(planar_discs(), seeds)
def test_linear_maps_are_reproduced(shape, seed):
    exact = polynomial(seed, 1)
    surface = interpolate_clough_tocher(exact(shape.uv), shape.uv, shape.triangles)
    assert_same(surface, exact, inside(shape, seed))


@settings(max_examples=10)
@given(planar_discs(), seeds)
def test_quadratic_maps_are_reproduced_from_exact_gradients(shape, seed):
    exact = polynomial(seed, 2)
    slopes = gradients(exact, shape.uv)
    surface = interpolate_clough_tocher(exact(shape.uv), shape.uv, shape.triangles, gradients=slopes)
    assert_same(surface, exact, inside(shape, seed))


@settings(max_examples=10)
@given(planar_discs(), seeds)
def test_along_the_edges_cubic_maps_are_reproduced_from_exact_gradients(shape, seed):
    exact, edges, rng = polynomial(seed, 3), half_edges(shape.triangles, len(shape.uv)), np.random.default_rng(seed)
    slopes = gradients(exact, shape.uv)
    surface = interpolate_clough_tocher(exact(shape.uv), shape.uv, shape.triangles, gradients=slopes)
    share = rng.random((len(edges.origins), 1))
    places = share * shape.uv[edges.origins] + (1 - share) * shape.uv[edges.targets]
    assert np.allclose(evaluate(surface, places), exact(places), rtol=0, atol=1e-12)


@settings(max_examples=10)
@given(planar_discs(), seeds)
def test_first_derivatives_agree_across_edges_and_second_ones_do_not(shape, seed):
    rng, edges = np.random.default_rng(seed), half_edges(shape.triangles, len(shape.uv))
    surface = interpolate_clough_tocher(rng.normal(size=(len(shape.uv), 3)), shape.uv, shape.triangles)
    h = np.flatnonzero(edges.twins > np.arange(len(edges.twins)))
    share = rng.random((len(h), 1))
    places = share * shape.uv[edges.origins[h]] + (1 - share) * shape.uv[edges.targets[h]]
    barycentres = shape.uv[shape.triangles].mean(axis=1)
    assert_smooth(surface, places, barycentres[h // 3], barycentres[edges.twins[h] // 3])


@settings(max_examples=10)
@given(planar_discs(), seeds)
def test_first_derivatives_agree_between_the_three_cubics_of_a_triangle(shape, seed):
    rng, corners = np.random.default_rng(seed), shape.uv[shape.triangles]
    surface = interpolate_clough_tocher(rng.normal(size=(len(shape.uv), 3)), shape.uv, shape.triangles)
    share, barycentres = rng.uniform(0.1, 0.9, (len(corners), 1)), corners.mean(axis=1)
    places = share * corners[:, 0] + (1 - share) * barycentres
    assert_smooth(surface, places, corners[:, 1], corners[:, 2])


def assert_smooth(surface, places, one, other):
    """Check that one-sided derivatives agree up to first order, and not beyond."""
    for orders in ORDERS[:3]:
        limits = [one_sided(surface, places, side, *orders) for side in (one, other)]
        assert np.allclose(*limits, rtol=0, atol=1e-9 * np.abs(limits).max())
    limits = [one_sided(surface, places, side, 2, 0) for side in (one, other)]
    assert not np.allclose(*limits, rtol=1e-3)


@pytest.mark.parametrize(
    ("du", "dv", "below"), [(1, 0, (0, 0)), (0, 1, (0, 0)), (2, 0, (1, 0)), (1, 1, (1, 0)), (0, 2, (0, 1))]
)
def test_derivatives_are_the_limits_of_differences(du, dv, below):
    shape = shapes.disc(300, seed=5)
    surface = interpolate_clough_tocher(wave(shape.uv), shape.uv, shape.triangles)
    corners = shape.uv[shape.triangles]
    places, h = corners.mean(axis=1) + 0.02 * (corners[:, 0] + corners[:, 1] - 2 * corners[:, 2]), 1e-5
    step = h * np.array([du - below[0], dv - below[1]])
    difference = (surface.derivatives(places + step, *below) - surface.derivatives(places - step, *below)) / (2 * h)
    assert np.allclose(difference, surface.derivatives(places, du, dv), rtol=0, atol=1e-7)


def test_third_derivatives_are_constant_on_each_cubic_and_higher_ones_vanish():
    surface = interpolate_clough_tocher(wave(SQUARE), SQUARE, HALVES)
    places = np.array([[0.5, 0.1], [0.6, 0.2], [2, 2]])
    third, fourth = surface.derivatives(places, 2, 1), surface.derivatives(places, 2, 2)
    assert np.allclose(third[0], third[1], rtol=1e-12)
    assert np.abs(third[0]).min() > 0
    assert np.array_equal(fourth, [[0] * 3, [0] * 3, [np.nan] * 3], equal_nan=True)


def rms_errors(counts, with_gradients):
    """Return the errors of the values and of the first derivatives for discs of more and more points."""
    errors = []
    for n in counts:
        shape = shapes.disc(n, seed=1)
        slopes = gradients(wave, shape.uv) if with_gradients else None
        surface = interpolate_clough_tocher(wave(shape.uv), shape.uv, shape.triangles, gradients=slopes)
        places = inside(shape, seed=2, n=5000)
        misses = [surface.derivatives(places, *orders) - wave(places, *orders) for orders in ORDERS[:2]]
        errors.append([np.sqrt((miss**2).mean()) for miss in misses])
    return np.array(errors)


@pytest.mark.parametrize(("with_gradients", "rate"), [(True, 3.0), (False, 2.25)])
def test_errors_fall_with_the_third_power_from_exact_gradients_and_with_the_second_at_least_without(
    with_gradients, rate
):
    counts = (500, 2000, 8000)
    values, slopes = -2 * np.polyfit(np.log(counts), np.log(rms_errors(counts, with_gradients)), 1)[0]
    assert values == pytest.approx(rate, abs=0.3)
    assert slopes == pytest.approx(rate - 1, abs=0.3)


def test_gradients_are_those_of_the_minimum_norm_network_of_scipy():
    uv = shapes.disc(400, seed=3).uv
    mesh, places = Delaunay(uv), np.random.default_rng(0).uniform(-1, 1, (2000, 2))
    expected = CloughTocher2DInterpolator(mesh, wave(uv), tol=1e-14, maxiter=2000)(places)
    surface = interpolate_clough_tocher(wave(uv), uv, mesh.simplices)
    assert np.allclose(evaluate(surface, places), expected, rtol=0, atol=1e-12, equal_nan=True)


@settings(max_examples=10)
@given(planar_discs(), rotations(), seeds)
def test_the_surface_moves_with_the_points(shape, rotation, seed):
    points = wave(shape.uv)
    surface = interpolate_clough_tocher(points, shape.uv, shape.triangles)
    moved = interpolate_clough_tocher(points @ rotation.T + 5, shape.uv, shape.triangles)
    places = inside(shape, seed)
    assert np.allclose(evaluate(moved, places), evaluate(surface, places) @ rotation.T + 5, rtol=0, atol=1e-12)


@settings(max_examples=10)
@given(planar_discs(), st.floats(0, 6.3), st.floats(0.01, 100))
def test_the_surface_stays_when_the_parameters_are_turned_and_scaled(shape, turn, scale):
    similarity = scale * np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    surface = interpolate_clough_tocher(wave(shape.uv), shape.uv, shape.triangles)
    turned = interpolate_clough_tocher(wave(shape.uv), shape.uv @ similarity, shape.triangles)
    places = inside(shape, seed=0)
    assert np.allclose(evaluate(turned, places @ similarity), evaluate(surface, places), rtol=0, atol=1e-10)


@settings(max_examples=10)
@given(planar_discs(), seeds)
def test_with_gradients_given_the_surface_stays_under_affine_maps_of_the_parameters(shape, seed):
    affine = np.array([[3.0, 1], [-1, 0.5]])
    slopes = np.random.default_rng(seed).normal(size=(len(shape.uv), 2, 3))
    mapped = np.linalg.inv(affine) @ slopes
    surface = interpolate_clough_tocher(wave(shape.uv), shape.uv, shape.triangles, gradients=slopes)
    sheared = interpolate_clough_tocher(wave(shape.uv), shape.uv @ affine, shape.triangles, gradients=mapped)
    places = inside(shape, seed)
    assert np.allclose(evaluate(sheared, places @ affine), evaluate(surface, places), rtol=0, atol=1e-10)


@settings(max_examples=10)
@given(planar_discs(), seeds)
def test_places_on_the_boundary_belong_to_the_surface_and_those_beyond_do_not(shape, seed):
    share = np.random.default_rng(seed).random((len(shape.boundary), 1))
    start, end = shape.uv[shape.boundary], shape.uv[np.roll(shape.boundary, -1)]
    rim, surface = share * start + (1 - share) * end, interpolate_clough_tocher(shape.points, shape.uv, shape.triangles)
    assert np.allclose(evaluate(surface, rim), flat(rim), rtol=0, atol=1e-9)
    assert np.isnan(evaluate(surface, rim * (1 + 1e-9))).all()


def test_there_is_no_surface_in_a_hole():
    whole = shapes.grid(7, 7)
    kept = whole.triangles[np.abs(whole.uv[whole.triangles].mean(axis=1) - 3).max(axis=1) > 1]
    used = np.unique(kept)
    surface = interpolate_clough_tocher(whole.points[used], whole.uv[used], np.searchsorted(used, kept))
    assert np.isnan(evaluate(surface, [[3.0, 3.0], [7, 3]])).all()
    assert np.allclose(evaluate(surface, [[2.0, 2.5], [1.2, 4.7]]), [[2, 2.5, 0], [1.2, 4.7, 0]], rtol=0, atol=1e-12)


STRIP = np.array([[np.cos(t) * r, np.sin(t) * r] for t in np.linspace(0, 7.5, 16) for r in (1.0, 2.0)])
LADDER = np.array([[[i, i + 1, i + 3], [i, i + 3, i + 2]] for i in range(0, 30, 2)]).reshape(-1, 3)


@pytest.mark.parametrize(
    ("uv", "triangles", "message"),
    [
        (SQUARE[:3], HALVES, "parameters have shape"),
        (SQUARE + np.array([np.nan, 0]), HALVES, "4 points are NaN or infinite, the first of point 0"),
        (SQUARE[[0, 1, 2, 0]], HALVES, "points 0, 3 share their parameters"),
        (SQUARE[::-1], HALVES, "triangles 0, 1 of 2 are flat or clockwise"),
        (np.array([[0, 0], [1, 0], [1, 1], [0.9, 0.1]]), HALVES, "triangles 1 of 2 are flat or clockwise"),
        (SQUARE, HALVES[:1], "1 points are in no triangle"),
        (SQUARE, HALVES[:0], "no triangles"),
        (STRIP, LADDER, "1 boundary loops cross or overlap in uv"),
    ],
)
def test_a_mesh_that_does_not_cover_the_plane_once_is_refused(uv, triangles, message):
    points = np.random.default_rng(0).normal(size=(max(len(uv), 4), 3))
    with pytest.raises(InputError, match=message):
        interpolate_clough_tocher(points, uv, triangles)


def test_gradients_of_another_shape_are_refused():
    with pytest.raises(InputError, match=r"give \(4, 2, 3\)"):
        interpolate_clough_tocher(flat(SQUARE), SQUARE, HALVES, gradients=np.zeros((4, 3)))
