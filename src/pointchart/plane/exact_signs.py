"""Exact signs of triangle areas in the plane."""

from fractions import Fraction

import numpy as np

from .._kernels.plane.crossings import UNSURE, find_crossing, sure_signs
from .._parallel import over_ranges
from ..typing import UV, Indices, Triangles

# Shewchuk 1997: a computed sign is right if the determinant exceeds (3 + 16 eps) eps times the sum of its terms.
FILTER = (3.0 + 16.0 * 2.0**-53) * 2.0**-53
SMALLEST_SAFE = 1e-280


def orientation_signs(uv: UV, triangles: Triangles) -> Indices:
    """Return the exact sign of each triangle's area: 1 anticlockwise, -1 clockwise, 0 flat.

    Floating point decides where it can be trusted, rational arithmetic elsewhere.

    Examples
    --------
    >>> import numpy as np
    >>> corners = np.array([[0.0, 0.0], [1.0, 1.0], [3.0, 3.0], [0.5, 0.5 + 2.0**-53]])
    >>> orientation_signs(corners, np.array([[0, 1, 2], [0, 2, 3], [0, 3, 2]]))
    array([ 0,  1, -1], dtype=int8)
    """
    plane, faces = np.ascontiguousarray(uv, dtype=np.float64), np.asarray(triangles)
    signs = np.empty(len(faces), np.int8)
    over_ranges(lambda first, last: sure_signs(plane, faces, FILTER, SMALLEST_SAFE, first, last, signs), len(faces))
    for t in np.flatnonzero(signs == UNSURE):
        (ax, ay), (bx, by), (cx, cy) = (map(Fraction, uv[corner].tolist()) for corner in triangles[t])
        area = (ax - cx) * (by - cy) - (ay - cy) * (bx - cx)
        signs[t] = (area > 0) - (area < 0)
    return signs


def is_simple(polygon: UV) -> bool:
    """Tell whether a closed polygon neither crosses nor touches itself, by exact arithmetic where floats are unsure.

    Examples
    --------
    >>> import numpy as np
    >>> bow_tie = np.array([[0.0, 0.0], [1, 1], [1, 0], [0, 1]])
    >>> is_simple(bow_tie), is_simple(bow_tie[[0, 2, 1, 3]])
    (False, True)
    """
    ends = np.roll(polygon, -1, axis=0)
    low, high = np.minimum(polygon[:, 0], ends[:, 0]), np.maximum(polygon[:, 0], ends[:, 0])
    unsure = np.empty((64 * len(polygon), 2), np.int64)
    crosses, count = find_crossing(np.ascontiguousarray(polygon), np.argsort(low), low, high, unsure)
    return not crosses and not any(_touch(polygon, i, j) for i, j in unsure[:count].tolist())


def _touch(polygon: UV, i: int, j: int) -> bool:
    """Tell exactly whether sides i and j of a polygon have a point in common."""
    b = len(polygon)
    corners = np.array([i, (i + 1) % b, j, (j + 1) % b])
    c, d, a, e = orientation_signs(polygon[corners], np.array([[0, 1, 2], [0, 1, 3], [2, 3, 0], [2, 3, 1]])).tolist()
    if c == d == 0:
        spans = [np.sort(polygon[corners[k : k + 2]], axis=0) for k in (0, 2)]
        return bool(np.all(spans[0][0] <= spans[1][1]) and np.all(spans[1][0] <= spans[0][1]))
    return bool(c * d <= 0 and a * e <= 0)
