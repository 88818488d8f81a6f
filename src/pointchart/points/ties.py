"""Ties of points on a common circle, broken by a hash of their coordinates."""

import numpy as np

from .._check import check_points
from .._parallel import over_ranges
from ..typing import Floats, Keys, Points

TIE_BREAK = 1e-2  # spacings, a choice: over the rounding of grids in files, under what changes stars that have no ties
MANTISSA, EXPONENT = np.uint64(52), np.uint64(0x7FF)  # bits of a double: places of the one, mask of the other
ZERO = np.uint64(2**64 - 1)  # in place of the bits of 0: those of a scaled power of two may be 0
GOLDEN = 0x9E3779B97F4A7C15  # 2^64 over the golden ratio: the step of SplitMix64 from one number to the next


def tie_keys(points: Points) -> Keys:
    """Hash the coordinates of each point, (n,): different points have different keys, but for one in 2^64 pairs.

    Nothing but the point itself decides on its key, so that a part of a scan breaks ties as the whole does. A power of
    two of scale changes no key, nor does the sign of a zero.

    Examples
    --------
    >>> corners = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0]])
    >>> np.array_equal(tie_keys(8 * corners[1:]), tie_keys(corners)[1:]), len(set(tie_keys(corners).tolist()))
    (True, 3)
    """
    keys = np.empty(len(points), np.uint64)

    def find(first: int, last: int) -> None:
        bits = (points[first:last].T + 0.0).view(np.uint64)  # adding 0.0 makes -0.0 a 0.0
        largest = (bits >> MANTISSA & EXPONENT).max(axis=0) << MANTISSA
        key = np.zeros(last - first, np.uint64)
        for axis in range(3):
            key = _mixed(key + np.where(bits[axis] == 0, ZERO, bits[axis] - largest), axis + 1)
        keys[first:last] = key

    over_ranges(find, len(points))
    return keys


def break_ties(points: Points, spacing: Floats, keys: Keys | None = None) -> Points:
    """Move each point by up to a hundredth of the spacing, the same way on every call and in any part of the cloud.

    On a grid all circles hold four points, and neighbouring stars cannot agree on a diagonal. So stars that have to
    agree are searched among points in general position; nothing else ever sees the moved points.

    Parameters
    ----------
    points : (n, 3) array
    spacing : (n,) array
        Local spacing.
    keys : (n,) uint64 array, optional
        What decides on the ways; those of `tie_keys`, if not given.

    Returns
    -------
    (n, 3) float64 array.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    >>> bool(np.abs(break_ties(corners, np.ones(4)) - corners).max() < 1e-2)
    True
    """
    cloud = check_points(points)
    keys = tie_keys(cloud) if keys is None else keys
    moved = np.empty_like(cloud)

    def move(first: int, last: int) -> None:
        for axis in range(3):
            # 53 bits make a number in [0, 2), less 1.
            way = np.ldexp((_mixed(keys[first:last], axis + 1) >> np.uint64(11)).astype(np.float64), -52) - 1.0
            moved[first:last, axis] = cloud[first:last, axis] + TIE_BREAK * spacing[first:last] * way

    over_ranges(move, len(cloud))
    return moved


def _mixed(key: Keys, step: int) -> Keys:
    """Return the number of SplitMix64 that is `step` after the state `key` (Steele, Lea and Flood 2014)."""
    key = key + np.uint64(step * GOLDEN % 2**64)
    key = (key ^ (key >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    key = (key ^ (key >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return np.asarray(key ^ (key >> np.uint64(31)))
