"""The triangles on which neighbouring stars agree, made a surface, and the rims of that surface."""

import math

import numpy as np
from numba import njit

from .link_trust import are_adjacent


@njit(cache=True, nogil=True)
def count_votes(indptr, indices, is_open, first, last, votes):
    """Count the stars that hold the triangle of each entry and its follower; the one of smallest index counts."""
    for i in range(first, last):
        begin, end = indptr[i], indptr[i + 1]
        for e in range(begin, end):
            following = e + 1 if e + 1 < end else begin
            votes[e] = 0
            if end - begin < 2 or (is_open[i] and following == begin):
                continue
            j, k = indices[e], indices[following]
            held_by_j = are_adjacent(indptr, indices, is_open, j, k, i)
            held_by_k = are_adjacent(indptr, indices, is_open, k, i, j)
            # Each triangle has an entry in every star that holds it: only one of them may count.
            if not (held_by_j and j < i) and not (held_by_k and k < i):
                votes[e] = 1 + held_by_j + held_by_k


@njit(cache=True, nogil=True)
def collect_triangles(points, indptr, indices, votes, spacing, widest, triangles, width, held):
    """Write the triangles with votes and a circumradius under `widest` local spacings; return how many.

    `width` is that radius in spacings, `held` the votes.
    """
    count = 0
    for i in range(len(points)):
        for e in range(indptr[i], indptr[i + 1]):
            if votes[e] == 0:
                continue
            j, k = indices[e], indices[e + 1 if e + 1 < indptr[i + 1] else indptr[i]]
            radius = circumradius(points, i, j, k) / max(spacing[i], spacing[j], spacing[k])
            if radius < widest:
                triangles[count, 0], triangles[count, 1], triangles[count, 2] = i, j, k
                width[count], held[count] = radius, votes[e]
                count += 1
    return count


@njit(cache=True, nogil=True, inline="always")
def circumradius(points, a, b, c):
    """Return the circumradius of a triangle, very large if it is flat."""
    ux, uy, uz = points[b, 0] - points[a, 0], points[b, 1] - points[a, 1], points[b, 2] - points[a, 2]
    vx, vy, vz = points[c, 0] - points[a, 0], points[c, 1] - points[a, 1], points[c, 2] - points[a, 2]
    wx, wy, wz = ux - vx, uy - vy, uz - vz
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    product = (ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz) * (wx * wx + wy * wy + wz * wz)
    return math.sqrt(product) / max(2.0 * math.sqrt(nx * nx + ny * ny + nz * nz), 1e-300)


@njit(cache=True, nogil=True)
def count_at_edges(edge_of, wanted, is_contested):
    """Count the triangles that want each edge, up to three, and mark those with an edge that three want."""
    for t in range(len(edge_of)):
        for e in edge_of[t]:
            wanted[e] = min(wanted[e] + 1, 3)  # all that is asked is if there are more than two, and a byte holds it
    for t in range(len(edge_of)):
        is_contested[t] = wanted[edge_of[t, 0]] > 2 or wanted[edge_of[t, 1]] > 2 or wanted[edge_of[t, 2]] > 2


@njit(cache=True, nogil=True)
def add_corner_angles(points, triangles, total):
    """Add the angles of each triangle to those at its corners, in radians."""
    for t in range(len(triangles)):
        for k in range(3):
            at, left, right = triangles[t, k], triangles[t, (k + 1) % 3], triangles[t, (k + 2) % 3]
            ux, uy, uz = (
                points[left, 0] - points[at, 0],
                points[left, 1] - points[at, 1],
                points[left, 2] - points[at, 2],
            )
            vx, vy, vz = (
                points[right, 0] - points[at, 0],
                points[right, 1] - points[at, 1],
                points[right, 2] - points[at, 2],
            )
            nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
            total[at] += math.atan2(math.sqrt(nx * nx + ny * ny + nz * nz), ux * vx + uy * vy + uz * vz)


@njit(cache=True, nogil=True)
def name_edges(triangles, first, ends, edge_of):
    """Give the edges of triangles numbers, whatever their orientation; return how many there are.

    Edge k of a triangle lies opposite to corner k. `first` is scratch space of (n_points + 1,), `ends` of (3 m, 2).
    """
    m = len(triangles)
    first[:] = 0
    for t in range(m):
        for k in range(3):
            first[min(triangles[t, (k + 1) % 3], triangles[t, (k + 2) % 3]) + 1] += 1
    for v in range(len(first) - 1):
        first[v + 1] += first[v]
    filled = np.zeros(len(first), np.int32)
    slots = np.full(3 * m, -1, np.int32)
    count = 0
    for t in range(m):
        for k in range(3):
            a, b = triangles[t, (k + 1) % 3], triangles[t, (k + 2) % 3]
            a, b = min(a, b), max(a, b)
            name = -1
            # Edges are bucketed by their smaller end: a bucket holds half a star, short enough to search in turn.
            for s in range(first[a], first[a] + filled[a]):
                if ends[slots[s], 1] == b:
                    name = slots[s]
            if name < 0:
                name = count
                ends[count, 0], ends[count, 1] = a, b
                slots[first[a] + filled[a]] = count
                filled[a] += 1
                count += 1
            edge_of[t, k] = name
    return count
