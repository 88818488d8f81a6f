"""Delaunay edge swaps in space."""

import math

import numpy as np
from numba import njit

from .half_edges import following, preceding

LEAST_GAIN = 1e-12  # in the measure of the angles: smaller differences are rounding, and might swap for ever
MOST_SWAPS_OF_A_TRIANGLE = 100  # a cap: 16 real scans take 11 at most, and 27 where all of them are mapped


@njit(cache=True, nogil=True)
def angle_parts(points, apex, a, b):
    """Return dot product, cross product's norm and product of lengths of the edges from `apex` to a and b."""
    ux, uy, uz = points[a, 0] - points[apex, 0], points[a, 1] - points[apex, 1], points[a, 2] - points[apex, 2]
    vx, vy, vz = points[b, 0] - points[apex, 0], points[b, 1] - points[apex, 1], points[b, 2] - points[apex, 2]
    cx, cy, cz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    length = math.sqrt((ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz))
    return ux * vx + uy * vy + uz * vz, math.sqrt(cx * cx + cy * cy + cz * cz), length


@njit(cache=True, nogil=True, inline="always")
def angle_sum_measure(points, p, q, a, b):
    """Return a number in [0, 4] that grows with the sum of the angles at p and q opposite to edge ab."""
    dot_p, cross_p, length_p = angle_parts(points, p, a, b)
    dot_q, cross_q, length_q = angle_parts(points, q, a, b)
    length = length_p * length_q
    if length == 0.0:  # points that coincide: any other diagonal is better
        return 4.0
    # Cosine and sine of the sum, without the angles; past pi the sine is negative and the cosine rises again.
    cosine = (dot_p * dot_q - cross_p * cross_q) / length
    return 3.0 + cosine if dot_p * cross_q + cross_p * dot_q < 0.0 else 1.0 - cosine


@njit(cache=True, nogil=True)
def are_joined(corners, twins, h, other):
    """Tell whether the origin of half-edge h and the point `other` share an edge."""
    k = h
    while True:
        if corners[following(k)] == other or corners[preceding(k)] == other:
            return True
        k = twins[preceding(k)]
        if k < 0 or k == h:
            break
    if k == h:
        return False
    k = twins[h]  # the boundary was met: the rest of the fan lies the other way round
    while k >= 0:
        k = following(k)
        if corners[following(k)] == other or corners[preceding(k)] == other:
            return True
        k = twins[k]
    return False


@njit(cache=True, nogil=True)
def link(twins, h, k):
    """Make two half-edges opposite to each other; k may be -1."""
    twins[h] = k
    if k >= 0:
        twins[k] = h


@njit(cache=True, nogil=True)
def swap(corners, twins, h):
    """Replace edge ab, which half-edge h runs along, by the other diagonal cd of its two triangles.

    Triangles (a, b, c) and (b, a, d) become (d, b, c) and (c, a, d): each keeps two corners in their places.
    """
    t = twins[h]
    h_back, t_back = preceding(h), preceding(t)
    outside_ca, outside_db = twins[h_back], twins[t_back]  # bc and ad stay with their triangles
    corners[h], corners[t] = corners[t_back], corners[h_back]
    link(twins, h, outside_db)
    link(twins, t, outside_ca)
    link(twins, h_back, t_back)


@njit(cache=True, nogil=True)
def delaunay_swaps(points, corners, twins, stack, size, queued, swapped, barred):
    """Swap edges until all are Delaunay in space; return how many swaps that took.

    It begins with the first `size` half-edges of the stack, which `queued` marks. An edge is left alone, and marked in
    `barred`, when its replacement is there already, which a later swap may change. For points in a plane the swaps end
    by Lawson's theorem; in space no theorem is known, so no triangle takes the lead in more than a fixed number.
    """
    total = 0
    while size > 0:
        size -= 1
        h = np.int64(stack[size])
        queued[h] = False
        t = np.int64(twins[h])
        if t < 0 or swapped[h // 3] >= MOST_SWAPS_OF_A_TRIANGLE:
            continue
        a, b, c, d = corners[h], corners[t], corners[preceding(h)], corners[preceding(t)]
        if angle_sum_measure(points, c, d, a, b) <= angle_sum_measure(points, a, b, c, d) + LEAST_GAIN:
            continue
        if are_joined(corners, twins, preceding(h), d):
            barred[h] = True
            continue
        swap(corners, twins, h)
        total += 1
        swapped[h // 3] += 1
        for side in (h, following(h), t, following(t)):
            other = twins[side]
            if other < 0:
                continue
            # The caller may have queued either of the two; one name each keeps the stack within its room.
            edge = min(side, other)
            if not queued[edge] and not queued[max(side, other)]:
                queued[edge] = True
                stack[size] = edge
                size += 1
    return total
