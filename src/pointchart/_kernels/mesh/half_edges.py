"""Half-edges of a triangle mesh: half-edge 3 t + k runs from corner k of triangle t to its next corner."""

import math

import numpy as np
from numba import njit

from ..points.forest import join


@njit(cache=True, nogil=True, inline="always")
def following(h):
    """Return the next half-edge of the same triangle."""
    return h + 1 if h % 3 < 2 else h - 2


@njit(cache=True, nogil=True, inline="always")
def preceding(h):
    """Return the previous half-edge of the same triangle."""
    return h - 1 if h % 3 > 0 else h + 2


@njit(cache=True, nogil=True)
def pair_half_edges(corners, n_points, twins):
    """Write the opposite of each half-edge to `twin`, -1 on the boundary; return how many edges are no manifold ones.

    An edge is none when two half-edges run the same way along it: more than two triangles, or opposite orientations.
    """
    # Bucket v is filled through first[v + 1], which ends where bucket v + 1 begins: no second array is needed.
    first = np.zeros(n_points + 2, np.int32)
    for v in corners:
        first[v + 2] += 1
    for v in range(n_points):
        first[v + 2] += first[v + 1]
    # Half-edges bucketed by origin, their targets beside them, so that each search reads one short run of memory.
    leaving, target = np.empty_like(twins), np.empty_like(corners)
    for h in range(len(corners)):
        slot = first[corners[h] + 1]
        leaving[slot], target[slot] = h, corners[following(h)]
        first[corners[h] + 1] += 1
    twins[:] = -1
    overfull = 0
    for a in range(n_points):
        for e in range(first[a], first[a + 1]):
            b = target[e]
            for k in range(first[a], e):
                if target[k] == b:
                    overfull += 2
            if b < a:
                for k in range(first[b], first[b + 1]):
                    if target[k] == a:
                        twins[leaving[e]], twins[leaving[k]] = leaving[k], leaving[e]
    return overfull


@njit(cache=True, nogil=True)
def count_fans(corners, twins, fans, seen):
    """Count the fans of triangles around each point: 1 where the mesh is a manifold."""
    fans[:] = 0
    seen[:] = False
    for h in range(len(corners)):
        if seen[h]:
            continue
        fans[corners[h]] += 1
        k = h
        while k >= 0 and not seen[k]:
            seen[k] = True
            k = twins[preceding(k)]
        k = twins[h]  # and the other way round, for fans on the boundary that h does not begin
        while k >= 0 and not seen[following(k)]:
            k = following(k)
            seen[k] = True
            k = twins[k]


@njit(cache=True, nogil=True)
def order_rings(corners, twins, first, indptr, indices, is_open):
    """Write the neighbours of each point of a manifold mesh anticlockwise; `first` is a half-edge leaving each point.

    A boundary point begins with its neighbour along the boundary.
    """
    for v in range(len(first)):
        start = first[v]
        is_open[v] = True
        if start < 0:
            continue
        is_open[v] = False
        h = start
        while twins[h] >= 0:
            h = following(twins[h])
            if h == start:
                break
        if twins[h] < 0:
            is_open[v] = True
        begin = h
        e = indptr[v]
        while True:
            indices[e] = corners[following(h)]
            e += 1
            back = preceding(h)
            h = twins[back]
            if h < 0:
                indices[e] = corners[back]
                break
            if h == begin:
                break


@njit(cache=True, nogil=True)
def count_parts(corners, n_points):
    """Count the parts of a mesh that no edge joins; a point in no triangle is one."""
    part = np.arange(n_points).astype(np.int32)
    count = n_points
    for h in range(len(corners)):
        count -= join(part, corners[h], corners[following(h)])
    return count


@njit(cache=True, nogil=True)
def measure_edges(points, corners, twins, spacing, sharpest, first, last, ratios):
    """Write the length of half-edges first..last over the larger spacing at their ends; return how many are folds.

    Where the spacing is zero at both ends, as of vertices that coincide, zero is written.

    A fold turns by more than an angle of cosine `sharpest`.
    """
    folds = 0
    for h in range(first, last):
        a, b = corners[h], corners[following(h)]
        square = 0.0
        for k in range(3):
            square += (points[b, k] - points[a, k]) ** 2
        apart = max(spacing[a], spacing[b])
        ratios[h] = math.sqrt(square) / apart if apart > 0.0 else 0.0
        t = twins[h]
        if t > h:
            ux, uy, uz = cross_at(points, a, b, corners[preceding(h)])
            vx, vy, vz = cross_at(points, b, a, corners[preceding(t)])
            lengths = math.sqrt((ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz))
            folds += ux * vx + uy * vy + uz * vz < sharpest * lengths
    return folds


@njit(cache=True, nogil=True, inline="always")
def cross_at(points, a, b, c):
    """Return twice the area vector of a triangle."""
    ux, uy, uz = points[b, 0] - points[a, 0], points[b, 1] - points[a, 1], points[b, 2] - points[a, 2]
    vx, vy, vz = points[c, 0] - points[a, 0], points[c, 1] - points[a, 1], points[c, 2] - points[a, 2]
    return uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
