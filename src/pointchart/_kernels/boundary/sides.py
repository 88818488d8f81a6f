"""What the neighbours of a point say of a boundary: the angle they leave free, and their centroid."""

import numpy as np
from numba import njit

from ..points.inversion import measure_sides, project


@njit(cache=True, nogil=True)
def survey_sides(points, normals, indptr, indices, steepest, first, last, angle, offset):
    """Write, for points first..last, the largest angle between consecutive neighbours in the tangent plane (radians).

    `offset` is the distance of the neighbours' centroid from the point, over two thirds of the disc's radius: their
    mean distance. Neighbours steeper than `steepest` (sine against the plane) are left out.
    """
    most = 1
    for i in range(first, last):
        most = max(most, np.int64(indptr[i + 1] - indptr[i]))
    name, x, y, turns = np.empty(most, np.int64), np.empty(most), np.empty(most), np.empty(most)
    for i in range(first, last):
        row = indices[indptr[i] : indptr[i + 1]]
        n = project(points, normals[i], i, row, steepest, name, x, y, turns)
        angle[i], offset[i] = measure_sides(x, y, turns, n)
