import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import clouds, seeds

from pointchart.points.morton import morton_keys, morton_order


def interleaved(cell):
    """Take the bits of whole numbers in turn."""
    return sum(((int(c) >> bit) & 1) << (len(cell) * bit + axis) for bit in range(31) for axis, c in enumerate(cell))


@pytest.mark.parametrize("dimensions", [2, 3])
@given(seeds)
def test_keys_are_the_bits_of_the_cells_in_turn(dimensions, seed):
    most = 2 ** (63 // dimensions) - 1
    cells = np.random.default_rng(seed).integers(0, most, (50, dimensions))
    cells[0], cells[1] = 0, most
    # In the middle of cells, where rounding takes none to another.
    places = np.where(np.isin(np.arange(50), [0, 1])[:, None], cells, cells + 0.5)
    assert morton_keys(places).tolist() == [interleaved(cell) for cell in cells]


def test_the_curve_runs_through_a_square_of_squares_in_the_shape_of_z():
    y, x = np.divmod(np.arange(16), 4)
    order = morton_order(np.c_[x, y].astype(float))
    assert order.tolist() == [0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15]


@given(clouds())
def test_points_of_one_octant_follow_each_other(points):
    order = morton_order(points)
    low = points.min(axis=0)
    octant = ((points - low) >= np.ptp(points, axis=0).max() / 2) @ [1, 2, 4]
    assert np.array_equal(octant[order], np.sort(octant))


@given(clouds(), st.integers(-60, 60))
def test_a_power_of_two_of_scale_changes_no_key(points, exponent):
    assert np.array_equal(morton_keys(np.ldexp(points, exponent)), morton_keys(points))


@given(clouds(), seeds)
def test_the_curve_does_not_depend_on_the_numbering(points, seed):
    order = np.random.default_rng(seed).permutation(len(points))
    assert np.array_equal(morton_keys(points[order]), morton_keys(points)[order])


def test_points_that_coincide_keep_their_order():
    assert morton_order(np.full((9, 3), 7.0)).tolist() == list(range(9))
    assert morton_order(np.tile([[1.0, 2], [0, 0]], (3, 1))).tolist() == [1, 3, 5, 0, 2, 4]
