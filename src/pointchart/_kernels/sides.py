"""What the neighbours of a point say of a boundary: the angle they leave free, their centroid, its star's width."""

import math

import numpy as np
from numba import njit

from .planes import tangent_frame
from .stars import pseudo_angle


@njit(cache=True, nogil=True)
def survey_sides(points, normals, indptr, indices, steepest, first, last, angle, offset):
    """Write, for points first..last, the largest angle between consecutive neighbours in the tangent plane (radians).

    `offset` is the distance of the neighbours' centroid from the point, over two thirds of the disc's radius: their
    mean distance. Neighbours steeper than `steepest` (sine against the plane) are left out.
    """
    most = 1
    for i in range(first, last):
        most = max(most, indptr[i + 1] - indptr[i])
    x, y, turns = np.empty(most), np.empty(most), np.empty(most)
    for i in range(first, last):
        ux, uy, uz, vx, vy, vz = tangent_frame(normals[i, 0], normals[i, 1], normals[i, 2])
        n, mx, my, mr = 0, 0.0, 0.0, 0.0
        for j in indices[indptr[i] : indptr[i + 1]]:
            dx, dy, dz = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
            px, py = dx * ux + dy * uy + dz * uz, dx * vx + dy * vy + dz * vz
            flat = px * px + py * py
            if flat <= (1.0 - steepest * steepest) * (dx * dx + dy * dy + dz * dz):
                continue
            radius = math.sqrt(flat)
            mx, my, mr = mx + px, my + py, mr + radius
            turn = pseudo_angle(px, py)
            k = n
            while k > 0 and turns[k - 1] > turn:
                turns[k], x[k], y[k] = turns[k - 1], x[k - 1], y[k - 1]
                k -= 1
            turns[k], x[k], y[k] = turn, px / radius, py / radius
            n += 1
        angle[i] = widest_gap(x, y, n)
        offset[i] = math.sqrt(mx * mx + my * my) / mr if n > 0 else 1.0


@njit(cache=True, nogil=True, inline="always")
def widest_gap(x, y, n):
    """Return the largest angle from one of n sorted directions to the next."""
    if n < 2:
        return 2.0 * math.pi
    widest, best = -1.0, 0
    for k in range(n):
        m = k + 1 if k + 1 < n else 0
        cosine = x[k] * x[m] + y[k] * y[m]
        measure = 1.0 - cosine if x[k] * y[m] >= y[k] * x[m] else 3.0 + cosine
        if measure > widest:
            widest, best = measure, k
    after = best + 1 if best + 1 < n else 0
    angle = math.atan2(x[best] * y[after] - y[best] * x[after], x[best] * x[after] + y[best] * y[after])
    return angle if angle >= 0.0 else angle + 2.0 * math.pi
