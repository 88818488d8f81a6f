"""Tensor-product B-splines: Marsden's identity, local support, and the splines of scipy."""

from math import comb

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BSpline
from strategies import rotations, seeds

from pointchart import InputError
from pointchart._kernels.surface.bspline_basis import find_span
from pointchart.surface import BSplineSurface, evaluate

degrees = st.integers(1, 5)


def random_knots(rng, degree):
    """Return clamped knots of uneven spans, inner ones up to `degree` times."""
    inner = np.repeat(rng.uniform(-1, 2, 4), rng.integers(1, degree + 1, 4))
    return np.r_[[-1.0] * (degree + 1), np.sort(inner), [2.0] * (degree + 1)]


@st.composite
def surfaces(draw, degree=None):
    rng = np.random.default_rng(draw(seeds))
    degree = draw(degrees) if degree is None else degree
    knots = random_knots(rng, degree), random_knots(rng, degree)
    return BSplineSurface(degree, *knots, rng.normal(size=(*(len(k) - degree - 1 for k in knots), 3)))


def places_on(surface, n=60):
    """Return random parameters, all pairs of knots, and the corners of the domain among these."""
    knots = np.stack(np.meshgrid(np.unique(surface.knots_u), np.unique(surface.knots_v)), axis=-1).reshape(-1, 2)
    return np.r_[np.random.default_rng(0).uniform(*surface.domain, (n, 2)), knots]


def by_scipy(surface, uv, du=0, dv=0):
    """Evaluate by scipy, one direction after the other."""
    along_u = BSpline(surface.knots_u, surface.control, surface.degree)(uv[:, 0], nu=du)
    return np.stack(
        [BSpline(surface.knots_v, c, surface.degree)(v, nu=dv) for c, v in zip(along_u, uv[:, 1], strict=True)]
    )


def with_control(surface, control):
    return BSplineSurface(surface.degree, surface.knots_u, surface.knots_v, control)


def polar_forms(knots, degree, power):
    """Control points of t to a power, by Marsden: its polar form at the inner knots of each basis function."""
    windows = np.lib.stride_tricks.sliding_window_view(knots[1:-1], degree)
    elementary = [np.poly(-window)[power] for window in windows]
    return np.array(elementary) / comb(degree, power)


@settings(max_examples=40)
@given(surfaces(), st.integers(0, 5), st.integers(0, 5))
def test_derivatives_are_those_of_scipy_at_random_places_at_knots_and_at_the_ends(surface, du, dv):
    uv = places_on(surface)
    expected = by_scipy(surface, uv, min(du, surface.degree), min(dv, surface.degree))
    got = surface.derivatives(uv, min(du, surface.degree), min(dv, surface.degree))
    assert np.allclose(got, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


@settings(max_examples=20)
@given(surfaces())
def test_the_outermost_polynomials_go_on_beyond_the_domain(surface):
    low, high = surface.domain
    outside = np.random.default_rng(0).uniform(low - 0.5, high + 0.5, (60, 2))
    expected = by_scipy(surface, outside)
    assert np.allclose(evaluate(surface, outside), expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


@settings(max_examples=25)
@given(surfaces())
def test_derivatives_beyond_the_degree_vanish(surface):
    uv = places_on(surface)
    for orders in ((surface.degree + 1, 0), (0, surface.degree + 1), (1, surface.degree + 2)):
        assert not surface.derivatives(uv, *orders).any()


@settings(max_examples=25)
@given(surfaces(), seeds)
def test_basis_functions_sum_to_one(surface, seed):
    point = np.random.default_rng(seed).normal(size=3)
    all_the_same = with_control(surface, np.broadcast_to(point, surface.control.shape).copy())
    assert np.allclose(evaluate(all_the_same, places_on(surface)), point, rtol=0, atol=1e-13)


@settings(max_examples=25)
@given(surfaces())
def test_points_lie_in_the_box_of_their_control_points(surface):
    points, control = evaluate(surface, places_on(surface)), surface.control.reshape(-1, 3)
    assert (points >= control.min(axis=0) - 1e-12).all()
    assert (points <= control.max(axis=0) + 1e-12).all()


@settings(max_examples=25)
@given(surfaces(), seeds)
def test_a_control_point_moves_the_surface_between_its_own_knots_only(surface, seed):
    rng, p = np.random.default_rng(seed), surface.degree
    i, j = (int(rng.integers(n)) for n in surface.control.shape[:2])
    moved = surface.control.copy()
    moved[i, j] += 1.0
    low, high = np.array([[k[m], k[m + p + 1]] for k, m in ((surface.knots_u, i), (surface.knots_v, j))]).T
    uv = np.r_[places_on(surface), rng.uniform(low, high, (9, 2))]
    has_moved = (evaluate(with_control(surface, moved), uv) != evaluate(surface, uv)).any(axis=1)
    assert has_moved[-9:].any()
    assert not has_moved[((uv < low) | (uv > high)).any(axis=1)].any()


@settings(max_examples=25)
@given(surfaces(), st.integers(0, 5), st.integers(0, 5))
def test_polynomials_up_to_the_degree_are_reproduced(surface, in_u, in_v):
    p = surface.degree
    powers = min(in_u, p), min(in_v, p)
    of_u, of_v = (polar_forms(k, p, n) for k, n in zip((surface.knots_u, surface.knots_v), powers, strict=True))
    monomial = with_control(surface, np.repeat(np.outer(of_u, of_v)[:, :, None], 3, axis=2))
    uv = places_on(surface)
    expected = np.prod(uv ** np.array(powers), axis=1)
    assert np.allclose(evaluate(monomial, uv)[:, 1], expected, rtol=0, atol=1e-11)


@settings(max_examples=25)
@given(surfaces(), rotations(), seeds)
def test_the_surface_moves_with_its_control_points_under_affine_maps(surface, rotation, seed):
    rng = np.random.default_rng(seed)
    matrix, shift = rotation * rng.uniform(0.1, 3, 3), rng.normal(size=3)
    uv = places_on(surface)
    moved = with_control(surface, surface.control @ matrix.T + shift)
    assert np.allclose(evaluate(moved, uv), evaluate(surface, uv) @ matrix.T + shift, rtol=0, atol=1e-12)
    slopes = surface.derivatives(uv, 1, 0) @ matrix.T
    assert np.allclose(moved.derivatives(uv, 1, 0), slopes, rtol=0, atol=1e-12 * np.abs(slopes).max())


@settings(max_examples=25)
@given(surfaces())
def test_exchanging_the_directions_exchanges_the_derivatives(surface):
    exchanged = BSplineSurface(
        surface.degree, surface.knots_v, surface.knots_u, surface.control.transpose(1, 0, 2).copy()
    )
    uv, slopes = places_on(surface), surface.derivatives(places_on(surface), 1, 0)
    assert np.allclose(exchanged.derivatives(uv[:, ::-1], 0, 1), slopes, rtol=0, atol=1e-12 * np.abs(slopes).max())


@settings(max_examples=25)
@given(surfaces())
def test_a_clamped_surface_has_its_corners_in_the_corner_control_points(surface):
    (u0, v0), (u1, v1) = surface.domain
    corners = evaluate(surface, [[u0, v0], [u0, v1], [u1, v0], [u1, v1]])
    assert np.allclose(corners, surface.control[[0, 0, -1, -1], [0, -1, 0, -1]], rtol=0, atol=1e-13)


@given(degrees, seeds, st.floats(-2, 3))
def test_the_span_of_a_parameter_holds_it_and_is_not_empty(degree, seed, t):
    knots = random_knots(np.random.default_rng(seed), degree)
    span = find_span(knots, degree, t)
    assert knots[span] < knots[span + 1]
    assert knots[span] <= min(max(t, -1.0), 2.0) <= knots[span + 1]
    assert t != knots[span + 1] or t == 2.0


def test_a_bilinear_patch_has_four_control_points_and_the_domain_of_its_knots():
    patch = BSplineSurface(1, np.array([2.0, 2, 5, 5]), np.array([0.0, 0, 7, 7]), np.zeros((2, 2, 3)))
    assert patch.n_control == 4
    assert patch.domain.tolist() == [[2, 0], [5, 7]]


@pytest.mark.parametrize("n", [0, 1, 20_000])
def test_any_number_of_parameters_is_evaluated(n):
    corners = np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    square = BSplineSurface(1, np.array([0.0, 0, 1, 1]), np.array([0.0, 0, 1, 1]), corners)
    uv = np.random.default_rng(0).random((n, 2))
    assert np.allclose(evaluate(square, uv)[:, :2], uv, rtol=0, atol=1e-15)


def test_control_points_and_orders_that_fit_no_surface_are_refused():
    clamped = np.array([0.0, 0, 1, 1])
    with pytest.raises(InputError, match="knots_u has shape"):
        BSplineSurface(1, clamped, clamped, np.zeros((5, 2, 3)))
    with pytest.raises(InputError, match="at least 0"):
        BSplineSurface(1, clamped, clamped, np.zeros((2, 2, 3))).derivatives(np.array([[0.5, 0.5]]), -1, 0)
