"""Spatial order: points renumbered along a Morton curve, so that neighbours in space are neighbours in memory."""

import numpy as np
from numpy.typing import NDArray

from .typing import Floats, Indices


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
    dimensions = points.shape[1]
    bits = 63 // dimensions
    low = points.min(axis=0)
    extent = float(np.max(points.max(axis=0) - low)) or 1.0
    cells = ((points - low) * ((2**bits - 1) / extent)).astype(np.uint64)
    key = np.zeros(len(points), np.uint64)
    for axis in range(dimensions):
        key |= (_spread2 if dimensions == 2 else _spread3)(cells[:, axis]) << np.uint64(axis)
    return np.argsort(key, kind="stable")


def _spread2(x: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Put one zero bit between the lowest 31 bits (binary magic numbers)."""
    for shift, mask in (
        (16, 0x0000FFFF0000FFFF),
        (8, 0x00FF00FF00FF00FF),
        (4, 0x0F0F0F0F0F0F0F0F),
        (2, 0x3333333333333333),
        (1, 0x5555555555555555),
    ):
        x = (x | (x << np.uint64(shift))) & np.uint64(mask)
    return x


def _spread3(x: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Put two zero bits between the lowest 21 bits."""
    for shift, mask in (
        (32, 0x001F00000000FFFF),
        (16, 0x001F0000FF0000FF),
        (8, 0x100F00F00F00F00F),
        (4, 0x10C30C30C30C30C3),
        (2, 0x1249249249249249),
    ):
        x = (x | (x << np.uint64(shift))) & np.uint64(mask)
    return x
