"""Ties of points on a common circle, broken by a hash of their coordinates."""

import numpy as np

from .._kernels.points.tie_hash import hash_points, move_points
from .._parallel import over_ranges
from ..typing import Floats, Keys, Points

TIE_BREAK = 1e-2  # spacings, a choice: over the rounding of grids in files, under what changes stars that have no ties


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

    bits = points.view(np.uint64)
    over_ranges(lambda first, last: hash_points(points, bits, first, last, keys), len(points))
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
    keys = tie_keys(points) if keys is None else keys
    moved = np.empty_like(points)

    over_ranges(
        lambda first, last: move_points(points, spacing, keys, TIE_BREAK, first, last, moved),
        len(points),
    )
    return moved
