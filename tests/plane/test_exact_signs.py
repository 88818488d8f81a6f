from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import seeds

from pointchart._kernels.plane.exact_turns import long_turn, turn
from pointchart.plane.exact_signs import orientation_signs, sense

numbers = st.one_of(
    st.floats(allow_nan=False, allow_infinity=False),
    st.builds(lambda digits, power: digits * 2.0**power, st.integers(-4, 4), st.integers(-1074, 1000)),
)


@given(seeds)
def test_signs_change_with_every_exchange_of_corners(seed):
    rng = np.random.default_rng(seed)
    # Corners on a line up to a few last digits, where rounding alone would decide.
    uv = np.outer(rng.random(12), [1.0, 3.0]) + 2.0**-53 * rng.integers(-2, 3, (12, 2))
    triangles = np.array([rng.permutation(12)[:3] for _ in range(40)])
    signs = orientation_signs(uv, triangles)
    assert np.array_equal(signs, orientation_signs(uv, np.roll(triangles, 1, axis=1)))
    assert np.array_equal(signs, -orientation_signs(uv, triangles[:, ::-1]))


def test_signs_see_the_last_digit_and_denormal_areas():
    tiny = 5e-324
    uv = np.array([[0.0, 0.0], [1e17, 1e17], [2e17, 2e17 + 32], [tiny, 0], [0, tiny], [2e17, 2e17]])
    triangles = np.array([[0, 1, 2], [0, 2, 1], [0, 3, 4], [0, 4, 3], [0, 1, 5]])
    assert orientation_signs(uv, triangles).tolist() == [1, -1, 1, -1, 0]


@given(st.lists(numbers, min_size=6, max_size=6))
def test_a_turn_is_that_of_rational_arithmetic_for_tiny_and_huge_numbers(coordinates):
    ax, ay, bx, by, cx, cy = map(Fraction, coordinates)
    area = (ax - cx) * (by - cy) - (ay - cy) * (bx - cx)
    sign = (area > 0) - (area < 0)
    assert (turn(*coordinates), long_turn(*coordinates)) == (sign, sign)


@given(seeds, st.integers(-300, 300))
def test_a_turn_along_a_line_is_that_of_rational_arithmetic(seed, power):
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(2, 2))
    coordinates = (10.0**power * np.concatenate([a, b, a + rng.random() * (b - a)])).tolist()
    ax, ay, bx, by, cx, cy = map(Fraction, coordinates)
    area = (ax - cx) * (by - cy) - (ay - cy) * (bx - cx)
    assert turn(*coordinates) == (area > 0) - (area < 0)


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_turns_no_way(wrong):
    for place in range(6):
        coordinates = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0]
        coordinates[place] = wrong
        assert turn(*coordinates) == 0


@given(seeds)
def test_a_polygon_turned_round_runs_the_other_way(seed):
    rng = np.random.default_rng(seed)
    angles = (np.arange(9) + 0.9 * rng.random(9)) * 2.0 * np.pi / 9
    polygon = (0.1 + rng.random((9, 1))) * np.column_stack([np.cos(angles), np.sin(angles)])
    assert sense(np.roll(polygon, seed % 9, axis=0)) == 1
    assert sense(polygon[::-1]) == -1
