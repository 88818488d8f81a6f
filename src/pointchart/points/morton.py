"""Spatial order: points renumbered along a Morton curve, so that neighbours in space are neighbours in memory."""

import numpy as np

from .._kernels.points.morton_curve import morton_keys as keys_kernel
from .._parallel import over_ranges
from ..typing import Floats, Indices


def morton_order(points: Floats) -> Indices:
    """Sort points along the Morton (Z-order) curve through their bounding box; ties keep their order.

    Parameters
    ----------
    points : (n, 2) or (n, 3) array

    Returns
    -------
    (n,) int64 array: the points in the order of the curve.

    Examples
    --------
    >>> import numpy as np
    >>> morton_order(np.array([[9.0, 9.0], [0.0, 0.0], [9.0, 0.0], [0.0, 9.0]]))
    array([1, 2, 3, 0])
    """
    return np.argsort(morton_keys(points), kind="stable")


def morton_keys(points: Floats) -> Indices:
    """Give the cells of points their numbers along the Morton curve; there are 2^21 an axis in space.

    Examples
    --------
    >>> import numpy as np
    >>> morton_keys(np.array([[0.0, 0.0], [9.0, 9.0]]))[0]
    np.int64(0)
    """
    low = points.min(axis=0)
    extent = float(np.max(points.max(axis=0) - low)) or 1.0
    keys, bits = np.empty(len(points), np.int64), 63 // points.shape[1]
    places, scale = np.ascontiguousarray(points, dtype=np.float64), (2**bits - 1) / extent
    over_ranges(lambda first, last: keys_kernel(places, low, scale, bits, first, last, keys), len(points))
    return keys
