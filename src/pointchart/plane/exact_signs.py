"""Exact signs of areas in the plane."""

import numpy as np

from .._kernels.plane.exact_turns import measure_signs
from .._parallel import over_ranges
from ..typing import UV, Indices, Triangles


def orientation_signs(uv: UV, triangles: Triangles) -> Indices:
    """Return the exact sign of each triangle's area: 1 anticlockwise, -1 clockwise, 0 flat.

    Floating point decides where it can be trusted, a number of 4448 bits elsewhere: it holds all that products of
    coordinates can be, so there is no exception for tiny or huge ones. Triangles that are not finite count as flat.

    Parameters
    ----------
    uv : (n, 2) array
    triangles : (m, 3) int array

    Returns
    -------
    (m,) int8 array.

    References
    ----------
    Shewchuk 1997, Adaptive precision floating-point arithmetic and fast robust geometric predicates (the filter).
    Kulisch and Miranker 1986, The arithmetic of the digital computer: a new approach (the long number).

    Examples
    --------
    >>> import numpy as np
    >>> corners = np.array([[0.0, 0.0], [1.0, 1.0], [3.0, 3.0], [0.5, 0.5 + 2.0**-53]])
    >>> orientation_signs(corners, np.array([[0, 1, 2], [0, 2, 3], [0, 3, 2]]))
    array([ 0,  1, -1], dtype=int8)
    """
    plane, faces = np.ascontiguousarray(uv, dtype=np.float64), np.asarray(triangles)
    signs = np.empty(len(faces), np.int8)
    over_ranges(lambda first, last: measure_signs(plane, faces, first, last, signs), len(faces))
    return signs


def sense(polygon: UV) -> int:
    """Return which way a simple polygon runs: 1 anticlockwise, -1 clockwise, by its exact turn at its lowest corner.

    Examples
    --------
    >>> import numpy as np
    >>> sense(np.array([[0.0, 0.0], [1, 0], [1, 1e-300]]))
    1
    """
    lowest = int(np.lexsort(polygon.T)[0])
    corner = np.array([[lowest - 1, lowest, (lowest + 1) % len(polygon)]])
    return int(orientation_signs(polygon, corner)[0])
