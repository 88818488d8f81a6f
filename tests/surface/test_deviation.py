"""How far points lie from a surface: exact distances, shares and invariances."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import rotations, seeds

from pointchart.errors import InputError
from pointchart.surface import BSplineSurface, Deviation, deviation_table, evaluate, measure_deviation, normals

UNIT = np.array([0.0, 0, 1, 1])
SQUARE = np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
SADDLE = SQUARE + np.array([[[0, 0, 0.3], [0, 0, -0.2]], [[0, 0, 0], [0, 0, 0.4]]])


def bilinear(control):
    return BSplineSurface(1, UNIT, UNIT, np.asarray(control, np.float64))


def above(surface, heights, seed=0):
    """Return points at signed heights over a surface, and their feet."""
    feet = np.random.default_rng(seed).random((len(heights), 2))
    return evaluate(surface, feet) + np.asarray(heights)[:, None] * normals(surface, feet), feet


@given(st.lists(st.floats(-9, 9), min_size=4, max_size=30), seeds)
def test_points_raised_along_the_normals_deviate_by_their_heights(heights, seed):
    points, feet = above(bilinear(SADDLE), heights, seed)
    assert np.allclose(measure_deviation(points, bilinear(SADDLE), feet).signed, heights, rtol=0, atol=1e-13)


@given(rotations(), seeds)
def test_deviation_is_invariant_under_rigid_motion(rotation, seed):
    shift = np.random.default_rng(seed).uniform(-5, 5, 3)
    points, feet = above(bilinear(SADDLE), [1, -2, 3, 0.5], seed)
    moved = measure_deviation(points @ rotation.T + shift, bilinear(SADDLE @ rotation.T + shift), feet)
    assert np.allclose(moved.signed, [1, -2, 3, 0.5], rtol=0, atol=1e-12)


def test_deviation_is_invariant_under_reparameterization():
    points, feet = above(bilinear(SADDLE), [1, -2, 3, 0.5])
    stretched = BSplineSurface(1, 8 * UNIT, 0.25 * UNIT, SADDLE)
    assert np.allclose(measure_deviation(points, stretched, feet * [8, 0.25]).signed, [1, -2, 3, 0.5], atol=1e-14)


def test_exchanging_u_and_v_turns_the_sign():
    points, feet = above(bilinear(SADDLE), [1, -2, 3, 0.5])
    exchanged = measure_deviation(points, bilinear(SADDLE.transpose(1, 0, 2)), feet[:, ::-1])
    assert np.allclose(exchanged.signed, [-1, 2, -3, -0.5], atol=1e-14)


def test_the_distance_counts_in_full_where_the_foot_is_on_the_rim():
    points = [[-3.0, 0, -4], [4, 0, 4], [0, 0, 0], [1, 1, 7]]
    feet = [[0.0, 0], [1, 0], [0, 0], [1, 1]]
    assert measure_deviation(points, bilinear(SQUARE), feet).signed.tolist() == [-5, 5, 0, 7]


def test_deviation_is_positive_where_the_surface_has_no_normal():
    line = bilinear(SQUARE * [1, 0, 0])
    points = [[0.0, 0, -1], [0, 0, 2], [1, 3, 0], [1, -4, 0]]
    assert measure_deviation(points, line, [[0.0, 0], [0, 0], [1, 0], [1, 0]]).signed.tolist() == [1, 2, 3, 4]


@pytest.mark.parametrize(
    ("outliers", "largest"),
    [(0.0, 100), (0.0099, 100), (0.01, 99), (0.0199, 99), (0.29, 71), (0.57, 43), (0.58, 42), (0.99, 1), (0.999, 1)],
)
def test_the_share_of_outliers_is_rounded_down_as_it_is_written(outliers, largest):
    signed = np.random.default_rng(0).permutation(np.arange(1.0, 101)) * np.resize([1, -1], 100)
    assert Deviation(signed).largest(outliers) == largest


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=40), st.floats(0, 0.99), st.floats(0, 0.99))
def test_more_outliers_never_deviate_more(signed, one, other):
    deviation = Deviation(np.array(signed))
    assert deviation.largest(max(one, other)) <= deviation.largest(min(one, other)) <= deviation.largest()


def test_percentiles_interpolate_absolute_deviations():
    deviation = Deviation(np.array([-4.0, 1, -2, 3, 0]))
    assert [deviation.percentile(q) for q in (0, 25, 50, 62.5, 100)] == [0, 1, 2, 2.5, 4]


@pytest.mark.parametrize("unit", [1e-200, 1.0, 1e200])
def test_the_root_mean_square_scales_with_the_unit(unit):
    assert Deviation(unit * np.array([3.0, -4, 0, 0])).rms == pytest.approx(2.5 * unit, rel=1e-15)


def test_points_on_the_surface_deviate_by_nothing():
    rows = dict(deviation_table(Deviation(np.zeros(7)), tolerance=0.1))
    assert rows.pop("within 0.1") == 1.0
    assert not any(rows.values())


def test_the_tolerance_itself_is_within_it():
    assert deviation_table(Deviation(np.array([0.5, -0.5, 0.6, 0.0])), tolerance=0.5)[-1] == ("within 0.5", 0.75)


@pytest.mark.parametrize("outliers", [-0.1, 1.0, 2.0, float("nan")])
def test_a_share_that_leaves_no_points_is_refused(outliers):
    with pytest.raises(InputError, match=r"the share of outliers is .*; take at least 0 and less than 1"):
        Deviation(np.ones(3)).largest(outliers)


def test_missing_feet_are_counted():
    points, feet = above(bilinear(SQUARE), [1, 2, 3, 4])
    with pytest.raises(InputError, match=r"parameters have shape \(3, 2\); \(4, 2\) is needed"):
        measure_deviation(points, bilinear(SQUARE), feet[:3])


def test_lost_feet_are_counted():
    points, feet = above(bilinear(SQUARE), [1, 2, 3, 4])
    feet[[1, 3], 0] = np.nan, np.inf
    with pytest.raises(InputError, match="the parameters of 2 points are NaN or infinite, the first of point 1"):
        measure_deviation(points, bilinear(SQUARE), feet)
