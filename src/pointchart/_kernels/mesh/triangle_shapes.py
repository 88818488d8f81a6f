"""Areas, shapes and stretches of triangles, of a range of them at a time."""

import math

import numpy as np
from numba import njit

from ..plane.areas import doubled_area
from .half_edges import cross_at


@njit(cache=True, nogil=True)
def measure_areas(points, triangles, first, last, areas):
    """Write the area in space of triangles first..last."""
    for t in range(first, last):
        x, y, z = cross_at(points, triangles[t, 0], triangles[t, 1], triangles[t, 2])
        areas[t] = 0.5 * math.sqrt(x * x + y * y + z * z)


@njit(cache=True, nogil=True)
def measure_plane_areas(uv, triangles, first, last, areas):
    """Write the area in the plane of triangles first..last, negative for those that turn clockwise."""
    for t in range(first, last):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        areas[t] = 0.5 * doubled_area(uv, a, b, uv[c, 0], uv[c, 1])


@njit(cache=True, nogil=True)
def measure_shapes(points, triangles, first, last, ratios):
    """Write twice the inradius over the circumradius of triangles first..last: (b+c-a)(c+a-b)(a+b-c) / (abc)."""
    for t in range(first, last):
        i, j, k = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        a, b, c = distance(points, j, k), distance(points, k, i), distance(points, i, j)
        product = a * b * c
        shape = (b + c - a) * (c + a - b) * (a + b - c)
        ratios[t] = max(shape, 0.0) / (product if product > 0.0 else 1.0)


@njit(cache=True, nogil=True, inline="always")
def distance(points, i, j):
    """Return the distance of two points."""
    square = 0.0
    for d in range(3):
        square += (points[j, d] - points[i, d]) ** 2
    return math.sqrt(square)


@njit(cache=True, nogil=True)
def measure_stretches(points, triangles, uv, scale, first, last, largest, smallest):
    """Write the singular values of the map from the plane, drawn `scale` times as large, to triangles first..last.

    Those of a triangle that is flat in the plane are nan.
    """
    for t in range(first, last):
        i, j, k = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        u1, v1, u2, v2 = uv[j, 0] - uv[i, 0], uv[j, 1] - uv[i, 1], uv[k, 0] - uv[i, 0], uv[k, 1] - uv[i, 1]
        determinant = u1 * v2 - v1 * u2
        if determinant == 0.0:
            largest[t] = smallest[t] = np.nan
            continue
        a, b, c = 0.0, 0.0, 0.0
        for d in range(3):
            e1, e2 = points[j, d] - points[i, d], points[k, d] - points[i, d]
            along_u, along_v = scale * (v2 * e1 - v1 * e2) / determinant, scale * (u1 * e2 - u2 * e1) / determinant
            a, b, c = a + along_u * along_u, b + along_u * along_v, c + along_v * along_v
        root = math.hypot(a - c, 2.0 * b)
        largest[t], smallest[t] = math.sqrt(0.5 * (a + c + root)), math.sqrt(max(0.5 * (a + c - root), 0.0))
