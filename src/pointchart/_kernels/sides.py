"""What the neighbours of a point say of a boundary: the angle they leave free, their centroid, its star's width."""

import math

import numpy as np
from numba import njit

from .planes import tangent_frame


@njit(cache=True, nogil=True)
def survey_sides(points, normals, indptr, indices, steepest, first, last, angle, offset):
    """Write, for points first..last, the largest angle between consecutive neighbours in the tangent plane (radians).

    `offset` is the distance of the neighbours' centroid from the point, over two thirds of the disc's radius: their
    mean distance. Neighbours steeper than `steepest` (sine against the plane) are left out.
    """
    most = 1
    for i in range(first, last):
        most = max(most, indptr[i + 1] - indptr[i])
    turns = np.empty(most)
    for i in range(first, last):
        ux, uy, uz, vx, vy, vz = tangent_frame(normals[i, 0], normals[i, 1], normals[i, 2])
        n, mx, my, mr = 0, 0.0, 0.0, 0.0
        for j in indices[indptr[i] : indptr[i + 1]]:
            x, y, z = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
            px, py = x * ux + y * uy + z * uz, x * vx + y * vy + z * vz
            flat = px * px + py * py
            if flat <= (1.0 - steepest * steepest) * (x * x + y * y + z * z):
                continue
            mx, my, mr = mx + px, my + py, mr + math.sqrt(flat)
            turn = math.atan2(py, px)
            k = n
            while k > 0 and turns[k - 1] > turn:
                turns[k] = turns[k - 1]
                k -= 1
            turns[k] = turn
            n += 1
        angle[i] = 2.0 * math.pi if n == 0 else turns[0] + 2.0 * math.pi - turns[n - 1]
        for k in range(n - 1):
            angle[i] = max(angle[i], turns[k + 1] - turns[k])
        offset[i] = math.sqrt(mx * mx + my * my) / mr if n > 0 else 1.0
