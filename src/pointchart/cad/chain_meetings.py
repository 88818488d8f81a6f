"""Where chains of short straight pieces meet."""

import numpy as np
from scipy.spatial import KDTree

from ..typing import UV, Floats, Indices, Mask


def find_meetings(places: UV, after: Indices) -> Mask:
    """Tell which pieces, from place i to place ``after[i]``, have a place in common with one that does not follow.

    Pieces should be of about one length: those whose middles are farther apart than the longest are not looked at.

    Examples
    --------
    >>> bow = np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])
    >>> find_meetings(bow, np.array([1, 2, 3, 0])).tolist()
    [True, False, True, False]
    """
    ends = places[after]
    longest = np.linalg.norm(ends - places, axis=1).max()
    pairs = KDTree((places + ends) / 2.0).query_pairs(longest * (1.0 + 1e-9), output_type="ndarray")
    i, j = pairs[(after[pairs[:, 0]] != pairs[:, 1]) & (after[pairs[:, 1]] != pairs[:, 0])].T
    a, b, c, d = places[i], ends[i], places[j], ends[j]
    meets = (_turn(a, b, c) * _turn(a, b, d) <= 0.0) & (_turn(c, d, a) * _turn(c, d, b) <= 0.0)
    # Pieces of one line pass both tests wherever they lie.
    apart = (np.maximum(a, b) < np.minimum(c, d)) | (np.maximum(c, d) < np.minimum(a, b))
    meets &= ~apart.any(axis=1)
    found = np.zeros(len(places), np.bool_)
    found[i[meets]] = found[j[meets]] = True
    return found


def _turn(a: UV, b: UV, c: UV) -> Floats:
    """Return the sign of the area of abc."""
    first, second = b - a, c - a
    return np.sign(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
