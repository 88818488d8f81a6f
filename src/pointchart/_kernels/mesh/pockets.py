"""From the surface on which stars agree to a disc: one orientation, no pinches, pockets closed."""

import math

import numpy as np
from numba import njit

from .half_edges import cross_at, following, preceding
from .swaps import are_joined, link

# Ears that may fold back: as many, or a share of the rim. A choice: small pockets may fold back all round, as in noise;
# one that does at every fourth point of a long rim is no pocket, and there a map has to tell.
FEW_BAD, MOST_BAD = 6, 0.25
MOST_LOOKED_AT = 4000  # points of a rim up to which each ear is looked at for those it holds: the time is their square


@njit(cache=True, nogil=True)
def cap(points, corners, twins, loop, first_free):
    """Close a loop of boundary half-edges by cutting ears, those with the shortest base first.

    New triangles go to places `first_free` and on; returns the next free place, or -1 if all bases are edges already.
    Of all ears those are cut at once that are better than both beside them. Ears that fold back or hold a point of the
    rim wait until there are no others; if there are many, this is no pocket of the surface, and -1 is returned.
    """
    n = len(loop)
    edge, after, before = loop.copy(), np.empty(n, np.int64), np.empty(n, np.int64)
    cost, bad, active = np.empty(n), np.empty(n, np.bool_), np.arange(n)
    for k in range(n):
        after[k], before[k] = (k + 1) % n, (k - 1) % n
    for k in range(n):
        cost[k], bad[k] = ear_cost(points, corners, twins, edge, active, k, after[k], n == 3)
    left, may_be_bad, n_bad = n, False, 0
    while left > 3:
        cut = 0
        for place in range(len(active)):
            k = active[place]
            if edge[k] < 0 or left <= 3 or cost[k] == np.inf or (bad[k] and not may_be_bad):
                continue
            # Ears beside each other share a half-edge, so only one of them can be cut.
            if goes_before(cost, bad, before[k], k) or goes_before(cost, bad, after[k], k):
                continue
            other = after[k]
            edge[k] = add_ear(corners, twins, edge[k], edge[other], first_free)
            first_free, edge[other] = first_free + 1, -1
            after[k], before[after[other]] = after[other], k
            left, cut, n_bad = left - 1, cut + 1, n_bad + bad[k]
            for m in (before[k], k):
                cost[m], bad[m] = ear_cost(points, corners, twins, edge, active, m, after[m], left == 3)
        if (cut == 0 and may_be_bad) or n_bad > max(FEW_BAD, MOST_BAD * n):
            return -1
        active = active[edge[active] >= 0]
        may_be_bad = cut == 0
        if may_be_bad:
            for k in active:  # what an ear held may be gone
                cost[k], bad[k] = ear_cost(points, corners, twins, edge, active, k, after[k], left == 3)
                may_be_bad &= bad[k] or cost[k] == np.inf
            if not may_be_bad:
                continue
    for k in active:
        if edge[k] >= 0:
            third = add_ear(corners, twins, edge[k], edge[after[k]], first_free)
            link(twins, third, edge[before[k]])
            return first_free + 1
    return -1


@njit(cache=True, nogil=True, inline="always")
def goes_before(cost, bad, one, other):
    """Tell whether one ear is to be cut before another."""
    if bad[one] != bad[other]:
        return bad[other]
    return cost[one] < cost[other] or (cost[one] == cost[other] and one < other)


@njit(cache=True, nogil=True)
def add_ear(corners, twins, h, k, place):
    """Put a triangle on boundary half-edges h, ab, and k, bc; return its own half-edge along ac."""
    a, b, c = corners[h], corners[k], corners[following(k)]
    new = 3 * place
    corners[new], corners[new + 1], corners[new + 2] = a, c, b
    twins[new] = -1
    link(twins, new + 1, k)
    link(twins, new + 2, h)
    return new


@njit(cache=True, nogil=True)
def ear_cost(points, corners, twins, edge, active, one, next_one, is_last):
    """Return the squared base of the ear on two half-edges of a rim, inf if it is an edge, and whether the ear is bad.

    A bad one folds back on the triangles beside it, or holds another point of the rim.
    """
    h, k = edge[one], edge[next_one]
    a, b, c = corners[h], corners[k], corners[following(k)]
    # The last ear's base is the third side, an edge. Asked at both ends: at a pinch, a walk sees one fan of the point.
    if a == c or (not is_last and (are_joined(corners, twins, h, c) or are_joined(corners, twins, following(k), a))):
        return np.inf, True
    base = 0.0
    for d in range(3):
        base += (points[c, d] - points[a, d]) ** 2
    nx, ny, nz = cross_at(points, a, c, b)
    for side in (h, k):
        ox, oy, oz = cross_at(points, corners[side], corners[following(side)], corners[preceding(side)])
        if nx * ox + ny * oy + nz * oz < 0.0:
            return base, True
    if len(active) <= MOST_LOOKED_AT:
        for m in active:
            if edge[m] >= 0:
                v = corners[edge[m]]
                if v != a and v != b and v != c and is_over(points, v, a, c, b, nx, ny, nz):
                    return base, True
    return base, False


@njit(cache=True, nogil=True)
def is_over(points, v, a, b, c, nx, ny, nz):
    """Tell whether v lies over or under triangle abc of area vector n, and nearer than the triangle is wide."""
    height = 0.0
    for d, n in ((0, nx), (1, ny), (2, nz)):
        height += (points[v, d] - points[a, d]) * n
    area = nx * nx + ny * ny + nz * nz
    # The height is |n| times the distance, so this asks if the squared distance is over |n|, twice the area.
    if height * height > area * math.sqrt(area):
        return False
    for p, q in ((a, b), (b, c), (c, a)):
        x, y, z = cross_at(points, p, q, v)
        if x * nx + y * ny + z * nz < 0.0:
            return False
    return True
