"""Mean value weights in space."""

import math

from numba import njit


@njit(cache=True, nogil=True)
def mean_value(points, indptr, indices, is_open, least, first, last, weights):
    """Write the mean value weights of points first..last, of sum one; tangents under `least` count as that."""
    for i in range(first, last):
        begin, end = indptr[i], indptr[i + 1]
        for e in range(begin, end):
            weights[e] = 0.0
        for e in range(begin, end if not is_open[i] else end - 1):
            f = e + 1 if e + 1 < end else begin
            tangent = half_angle_tangent(points, i, indices[e], indices[f])
            weights[e] += tangent
            weights[f] += tangent
        total = 0.0
        for e in range(begin, end):
            total += weights[e]
        has_none, total = total == 0.0, 0.0  # a lone neighbour, or a fan without any angle
        for e in range(begin, end):
            j, square = indices[e], 0.0
            for k in range(3):
                square += (points[j, k] - points[i, k]) ** 2
            weights[e] = (1.0 if has_none else max(weights[e], least)) / math.sqrt(square)
            total += weights[e]
        for e in range(begin, end):
            weights[e] /= total


@njit(cache=True, nogil=True, inline="always")
def half_angle_tangent(points, apex, a, b):
    """Return tan(angle / 2) at `apex` without cancellation for small angles (Kahan 2006)."""
    ux, uy, uz = points[a, 0] - points[apex, 0], points[a, 1] - points[apex, 1], points[a, 2] - points[apex, 2]
    vx, vy, vz = points[b, 0] - points[apex, 0], points[b, 1] - points[apex, 1], points[b, 2] - points[apex, 2]
    u, v = math.sqrt(ux * ux + uy * uy + uz * uz), math.sqrt(vx * vx + vy * vy + vz * vz)
    # Of one length: then difference and sum are the diagonals of a rhombus, 2 sin and 2 cos of half the angle.
    px, py, pz, qx, qy, qz = ux * v, uy * v, uz * v, vx * u, vy * u, vz * u
    less = math.sqrt((px - qx) ** 2 + (py - qy) ** 2 + (pz - qz) ** 2)
    more = math.sqrt((px + qx) ** 2 + (py + qy) ** 2 + (pz + qz) ** 2)
    return less / max(more, 1e-15 * u * v)
