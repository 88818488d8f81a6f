"""Where polygons and chains of straight pieces meet themselves, decided exactly."""

import numpy as np

from .._kernels.plane.segments import has_crossing, measure_meetings
from .._parallel import over_ranges
from ..typing import UV, Indices, Mask


def is_simple(polygon: UV) -> bool:
    """Tell whether no two sides of a closed polygon meet but those that follow each other.

    Examples
    --------
    >>> bow_tie = np.array([[0.0, 0.0], [1, 1], [1, 0], [0, 1]])
    >>> is_simple(bow_tie), is_simple(bow_tie[[0, 2, 1, 3]])
    (False, True)
    """
    ends = np.roll(polygon, -1, axis=0)
    low, high = np.minimum(polygon[:, 0], ends[:, 0]), np.maximum(polygon[:, 0], ends[:, 0])
    return not has_crossing(np.ascontiguousarray(polygon), np.argsort(low), low, high)


def find_meetings(places: UV, after: Indices) -> Mask:
    """Tell which pieces, from place i to place ``after[i]``, have a place in common with one that does not follow.

    Pieces should be of about one length: those whose middles are farther apart than the longest are not looked at.

    Examples
    --------
    >>> bow = np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])
    >>> find_meetings(bow, np.array([1, 2, 3, 0])).tolist()
    [True, False, True, False]
    """
    from scipy.spatial import KDTree

    ends = places[after]
    longest = np.linalg.norm(ends - places, axis=1).max()
    pairs = KDTree((places + ends) / 2.0).query_pairs(longest * (1.0 + 1e-9), output_type="ndarray")
    pairs = pairs[(after[pairs[:, 0]] != pairs[:, 1]) & (after[pairs[:, 1]] != pairs[:, 0])]
    meets = np.empty(len(pairs), np.bool_)
    over_ranges(lambda first, last: measure_meetings(places, after, pairs, first, last, meets), len(pairs))
    found = np.zeros(len(places), np.bool_)
    found[pairs[meets]] = True
    return found
