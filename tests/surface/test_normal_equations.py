"""Least squares over B-splines: exact recovery, the energy of a thin plate, equivariance and rates."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BSpline
from strategies import rotations, seeds

from pointchart import InputError
from pointchart.surface import BSplineSurface, evaluate, least_squares
from pointchart.surface.normal_equations import thin_plate

degrees = st.integers(2, 5)


def uneven(rng, degree, n_spans=4):
    """Return clamped knots on the unit interval whose spans differ up to three times."""
    ends = np.r_[0.0, np.cumsum(rng.uniform(1, 3, n_spans))]
    return clamped(ends / ends[-1], degree)


def clamped(ends, degree):
    return np.r_[[ends[0]] * degree, ends, [ends[-1]] * degree].astype(np.float64)


def even(n_spans, degree=3):
    return clamped(np.linspace(0, 1, n_spans + 1), degree)


def scattered(rng, n=1500):
    """Random parameters in the unit square, and enough at its corners and borders."""
    t = np.linspace(0, 1, 25)
    rim = np.r_[np.c_[t, 0 * t], np.c_[t, 0 * t + 1], np.c_[0 * t, t], np.c_[0 * t + 1, t]]
    return np.r_[rng.random((n, 2)), rim]


def wave(uv):
    return np.c_[np.sin(3 * uv[:, 0]), np.cos(2 * uv[:, 1] + uv[:, 0]), np.exp(uv[:, 0] * uv[:, 1])]


def rms(values):
    return np.sqrt((values**2).mean())


def energy_of(control, knots_u, knots_v, degree):
    c = control.reshape(-1, 3)
    return (c * (thin_plate(knots_u, knots_v, degree) @ c)).sum()


# Exact answers


@settings(max_examples=10)
@given(degrees, seeds)
def test_a_spline_surface_is_recovered_from_scattered_points_with_its_own_knots(degree, seed):
    rng = np.random.default_rng(seed)
    knots = uneven(rng, degree, 3), uneven(rng, degree)
    truth = BSplineSurface(degree, *knots, rng.normal(size=(degree + 3, degree + 4, 3)))
    uv = scattered(rng)
    found = least_squares(evaluate(truth, uv), uv, *knots, degree=degree, fairness=0.0)
    assert np.allclose(found.control, truth.control, rtol=0, atol=1e-10)


@settings(max_examples=10)
@given(degrees, seeds)
def test_quadratic_patches_are_exact_with_any_knots(degree, seed):
    rng = np.random.default_rng(seed)
    u, v = scattered(rng).T
    patch = np.stack([np.ones_like(u), u, v, u * u, u * v, v * v], axis=1) @ rng.normal(size=(6, 3))
    uv = np.c_[u, v]
    surface = least_squares(patch, uv, uneven(rng, degree), uneven(rng, degree), degree=degree, fairness=0.0)
    assert np.allclose(evaluate(surface, uv), patch, rtol=0, atol=1e-11)


@settings(max_examples=10)
@given(st.integers(2, 5), seeds, st.sampled_from([1e-9, 1e-3, 1.0, 1e3]))
def test_planes_are_exact_with_any_fairness_also_where_there_are_no_points(degree, seed, fairness):
    rng = np.random.default_rng(seed)
    matrix, shift = rng.normal(size=(2, 3)), rng.normal(size=3)
    uv = rng.random((200, 2)) * [0.4, 0.7]
    surface = least_squares(uv @ matrix + shift, uv, even(6, degree), even(4, degree), degree=degree, fairness=fairness)
    everywhere = rng.random((200, 2))
    assert np.allclose(evaluate(surface, everywhere), everywhere @ matrix + shift, rtol=0, atol=1e-5)


def test_what_a_surface_of_least_squares_leaves_is_orthogonal_to_all_that_it_could_be():
    rng = np.random.default_rng(0)
    uv, knots = scattered(rng), even(5)
    points = wave(uv) + 0.1 * rng.normal(size=(len(uv), 3))
    left = points - evaluate(least_squares(points, uv, knots, knots, fairness=0.0), uv)
    for seed in range(5):
        control = np.random.default_rng(seed).normal(size=(8, 8, 3))
        other = evaluate(BSplineSurface(3, knots, knots, control), uv)
        assert abs((left * other).sum()) < 1e-9


# Thin plates


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
def test_the_energy_of_a_thin_plate_is_that_of_quadrature_span_by_span(degree):
    rng = np.random.default_rng(degree)
    knots_u, knots_v = uneven(rng, degree, 3), uneven(rng, degree, 2)
    control = rng.normal(size=(degree + 3, degree + 2))

    def products(knots):
        """Integrals of products of basis functions and their derivatives, with far more nodes than need be."""
        x, w = np.polynomial.legendre.leggauss(12)
        ends = np.unique(knots)
        places = np.concatenate([(a + b) / 2 + (b - a) / 2 * x for a, b in pairwise(ends)])
        weights = np.concatenate([(b - a) / 2 * w for a, b in pairwise(ends)])
        basis = BSpline(knots, np.eye(len(knots) - degree - 1), degree)
        rows = [basis(places, nu=order) if order <= degree else 0 * basis(places) for order in range(3)]
        return [row.T @ (weights[:, None] * row) for row in rows]

    u, v = products(knots_u), products(knots_v)
    expected = sum(
        share * np.einsum("ij,ik,kl,jl->", control, u[k], control, v[2 - k]) for k, share in ((0, 1), (1, 2), (2, 1))
    )
    energy = control.ravel() @ (thin_plate(knots_u, knots_v, degree) @ control.ravel())
    assert energy == pytest.approx(expected, rel=1e-11)


@settings(max_examples=10)
@given(st.integers(2, 5), seeds)
def test_thin_plates_have_no_energy_exactly_if_they_are_linear(degree, seed):
    rng = np.random.default_rng(seed)
    knots = uneven(rng, degree), uneven(rng, degree, 2)
    matrix = thin_plate(*knots, degree).toarray()
    assert np.allclose(matrix, matrix.T, rtol=0, atol=1e-12 * np.abs(matrix).max())
    values, vectors = np.linalg.eigh(matrix)
    assert (np.abs(values[:3]) < 1e-12 * values[-1]).all()
    assert (values[3:] > 1e-9 * values[-1]).all()
    greville = [np.convolve(k[1:-1], np.ones(degree) / degree, mode="valid") for k in knots]
    u, v = np.meshgrid(*greville, indexing="ij")
    linear = np.stack([np.ones(u.size), u.ravel(), v.ravel()], axis=1)
    assert np.allclose(vectors[:, :3] @ (vectors[:, :3].T @ linear), linear, rtol=0, atol=1e-7)


def test_the_energy_of_a_parabola_is_four_times_its_area():
    """s = u^2 has s_uu = 2: on 3 by 5, 4 times 15; s = u v has twice s_uv^2 = 1: 30."""
    uv = np.random.default_rng(0).random((900, 2)) * [3, 5]
    knots = clamped([0, 1, 3], 3), clamped([0, 2, 5], 3)
    u, v = uv.T
    for heights, energy in ((u * u, 60), (u * v, 30), (v * v, 60)):
        plate = least_squares(np.c_[u, v, heights], uv, *knots, fairness=0.0)
        assert energy_of(plate.control, *knots, 3) == pytest.approx(energy, rel=1e-9)


def test_the_fairer_the_smoother_and_the_farther():
    rng = np.random.default_rng(1)
    uv, knots = scattered(rng, 500), even(6)
    points = wave(uv) + 0.05 * rng.normal(size=(len(uv), 3))
    fits = [least_squares(points, uv, knots, knots, fairness=f) for f in (0.0, 1e-6, 1e-4, 1e-2, 1.0)]
    energies = [energy_of(fit.control, knots, knots, 3) for fit in fits]
    assert (np.diff(energies) < 0).all()
    assert (np.diff([rms(evaluate(fit, uv) - points) for fit in fits]) > 0).all()


# Points that do not determine the surface


def bare_functions(knots_u, knots_v, uv, degree=3):
    """Count the basis functions without points, by the design matrix of scipy."""
    has = [
        (BSpline.design_matrix(t, k, degree).toarray() > 0).astype(int)
        for k, t in zip((knots_u, knots_v), uv.T, strict=True)
    ]
    return int((has[0].T @ has[1] == 0).sum())


@pytest.mark.parametrize("reach", [[0.5, 1.0], [0.5, 0.3], [0.2, 0.2]])
def test_without_fairness_control_points_without_scan_points_are_counted(reach):
    uv = np.random.default_rng(0).random((800, 2)) * reach
    knots = even(8), even(6)
    bare = bare_functions(*knots, uv)
    assert bare > 0
    with pytest.raises(InputError, match=rf"^{bare} of 99 control points have no scan points, so their place is undet"):
        least_squares(wave(uv), uv, *knots, fairness=0.0)


@settings(max_examples=5)
@given(seeds)
def test_with_fairness_the_surface_goes_on_over_spans_without_points(seed):
    rng = np.random.default_rng(seed)
    uv = rng.random((1200, 2))
    uv = uv[np.linalg.norm(uv - 0.5, axis=1) > 0.3]
    surface = least_squares(wave(uv), uv, even(12), even(12), fairness=1e-9)
    low, high = wave(uv).min(axis=0) - 1, wave(uv).max(axis=0) + 1
    inside = evaluate(surface, 0.5 + 0.1 * rng.normal(size=(300, 2)).clip(-2, 2))
    assert ((inside > low) & (inside < high)).all()
    assert np.abs(evaluate(surface, uv) - wave(uv)).max() < 1e-3


# Weights


@settings(max_examples=10)
@given(seeds, st.sampled_from([0.0, 1e-4]))
def test_a_weight_of_two_is_a_point_given_twice(seed, fairness):
    rng = np.random.default_rng(seed)
    uv, knots = scattered(rng, 400), even(4)
    points = wave(uv) + rng.normal(size=(len(uv), 3))
    twice = rng.random(len(uv)) < 0.5
    weighed = least_squares(points, uv, knots, knots, weights=1.0 + twice, fairness=fairness)
    again = np.r_[points, points[twice]], np.r_[uv, uv[twice]]
    assert np.allclose(weighed.control, least_squares(*again, knots, knots, fairness=fairness).control, atol=1e-8)


def test_only_the_ratio_of_weights_counts_and_huge_ones_hold_their_points():
    rng = np.random.default_rng(2)
    uv, knots = scattered(rng, 400), even(4)
    points, weights = wave(uv) + rng.normal(size=(len(uv), 3)), rng.uniform(0.5, 2, len(uv))
    one, other = (
        least_squares(points, uv, knots, knots, weights=w, fairness=1e-6) for w in (weights, 1024.0 * weights)
    )
    assert np.allclose(one.control, other.control, rtol=0, atol=1e-11)
    weights[:5] = 1e8
    held = evaluate(least_squares(points, uv, knots, knots, weights=weights, fairness=0.0), uv[:5])
    assert np.allclose(held, points[:5], rtol=0, atol=1e-5)


# Equivariance


@settings(max_examples=10)
@given(seeds, rotations(), st.floats(0.01, 100), st.sampled_from([0.0, 1e-5]))
def test_the_surface_moves_with_the_points(seed, rotation, scale, fairness):
    rng = np.random.default_rng(seed)
    uv, knots, shift = scattered(rng, 400), even(4), 50 * rng.normal(size=3)
    points = wave(uv) + 0.1 * rng.normal(size=(len(uv), 3))
    before = least_squares(points, uv, knots, knots, fairness=fairness)
    after = least_squares(scale * points @ rotation.T + shift, uv, knots, knots, fairness=fairness)
    assert np.allclose(after.control, scale * before.control @ rotation.T + shift, rtol=1e-10, atol=1e-10 * scale)


@settings(max_examples=10)
@given(seeds, st.sampled_from([2.0**-30, 8.0, 2.0**20]), st.sampled_from([0.0, 1e-5]))
def test_the_unit_of_the_parameters_does_not_matter(seed, unit, fairness):
    rng = np.random.default_rng(seed)
    uv, knots = scattered(rng, 400), even(4)
    points = wave(uv) + 0.1 * rng.normal(size=(len(uv), 3))
    before = least_squares(points, uv, knots, knots, fairness=fairness)
    after = least_squares(points, unit * uv, unit * knots, unit * knots, fairness=fairness)
    assert np.allclose(after.control, before.control, rtol=0, atol=1e-9)


@settings(max_examples=10)
@given(seeds)
def test_neither_the_order_of_points_nor_that_of_directions_matters(seed):
    rng = np.random.default_rng(seed)
    uv, knots = scattered(rng, 400), (even(4), even(6))
    points, order = wave(uv), rng.permutation(len(uv))
    before = least_squares(points, uv, *knots)
    shuffled = least_squares(points[order], uv[order], *knots)
    across = least_squares(points, uv[:, ::-1], *knots[::-1])
    assert np.allclose(shuffled.control, before.control, rtol=0, atol=1e-8)
    assert np.allclose(across.control.transpose(1, 0, 2), before.control, rtol=0, atol=1e-8)


# Rates


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
def test_errors_fall_with_the_power_of_the_spans_that_is_one_more_than_the_degree(degree):
    uv, spans, errors = scattered(np.random.default_rng(3), 8000), (4, 8, 16), []
    for n in spans:
        surface = least_squares(wave(uv), uv, even(n, degree), even(n, degree), degree=degree, fairness=0.0)
        errors.append(rms(evaluate(surface, uv) - wave(uv)))
    rate = -np.polyfit(np.log(spans), np.log(errors), 1)[0]
    assert rate == pytest.approx(degree + 1, abs=0.3)


def test_noise_falls_as_the_root_of_the_control_points_for_each_point():
    """The mean square of what noise of variance one leaves on the surface is the share of control points."""
    rng = np.random.default_rng(4)
    uv, knots = scattered(rng, 8000), even(7)
    surface = least_squares(rng.normal(size=(len(uv), 3)), uv, knots, knots, fairness=0.0)
    assert rms(evaluate(surface, uv)) == pytest.approx(np.sqrt(100 / len(uv)), rel=0.1)


@pytest.mark.parametrize(
    ("knots", "options", "message"),
    [
        ([0.0, 0, 0, 0, 1], {}, r"knots_u has shape \(5,\)"),
        ([0.0, 0, 0, 0, 1, 1, 1, np.nan], {}, "finite knots"),
        ([0.0, 0, 0, 1, 2, 3, 3, 3], {}, "repeats its knots"),
        ([0.0, 0, 0, 0, 1, 1, 1, 1], {"fairness": -1.0}, "the fairness is -1"),
        ([0.0, 0, 0, 0, 1, 1, 1, 1], {"fairness": np.nan}, "the fairness is nan"),
        ([0.3, 0.3, 0.3, 0.3, 1, 1, 1, 1], {}, "lie beyond knots_u"),
        ([0.0, 0, 0, 0, 1, 1, 1, 1], {"fairness": 0.0}, "9 points do not determine 16 control points"),
        ([0.0, 0, 0, 0, 1, 1, 1, 1], {"weights": np.zeros(9)}, "9 weights are not positive"),
    ],
)
def test_knots_and_options_out_of_range_are_refused(knots, options, message):
    uv = np.array([[i / 2, j / 2] for i in range(3) for j in range(3)])
    with pytest.raises(InputError, match=message):
        least_squares(np.column_stack([uv, uv[:, 0]]), uv, np.array(knots), np.array([0.0] * 4 + [1.0] * 4), **options)
