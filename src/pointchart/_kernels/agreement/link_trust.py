"""Which links between neighbours can be trusted."""

import numpy as np
from numba import njit

from ..mesh.editable import first_around, next_around
from ..mesh.half_edges import following, preceding

RING = 32  # points at hand, two a triangle: rings of over 16 triangles, against six mostly, are walked once more


@njit(cache=True, nogil=True, inline="always")
def are_adjacent(indptr, indices, is_open, center, a, b):
    """Tell whether a and b follow each other, either way round, in the star of `center`."""
    begin, end = indptr[center], indptr[center + 1]
    for e in range(begin, end):
        if indices[e] == a:
            following = e + 1 if e + 1 < end else begin
            preceding = e - 1 if e > begin else end - 1
            if indices[following] == b and not (is_open[center] and following == begin):
                return True
            return indices[preceding] == b and not (is_open[center] and e == begin)
    return False


@njit(cache=True, nogil=True)
def agreement(indptr, indices, is_open, first, last, agrees):
    """Mark the links of stars first..last that are an edge of a triangle which at least two stars hold."""
    for i in range(first, last):
        begin, end = indptr[i], indptr[i + 1]
        for e in range(begin, end):
            following = e + 1 if e + 1 < end else begin
            if following == e or (is_open[i] and following == begin):
                continue
            j, k = indices[e], indices[following]
            if are_adjacent(indptr, indices, is_open, j, k, i) or are_adjacent(indptr, indices, is_open, k, i, j):
                agrees[e] = agrees[following] = True


@njit(cache=True, nogil=True)
def mark_far(draft, indptr, indices, first, last, points, is_far):
    """Mark both ends of the links of points[first..last] whose ends are more than two edges apart on a mesh."""
    ring = np.empty(RING, np.int64)
    for place in range(first, last):
        i, size = points[place], 0
        start = h = first_around(draft, i)
        while h >= 0 and size + 2 <= RING:
            ring[size], ring[size + 1] = draft.corners[following(h)], draft.corners[preceding(h)]
            size += 2
            h = next_around(draft, h)
            if h == start:
                break
        for e in range(indptr[i], indptr[i + 1]):
            # Most links are edges of the mesh: the ring at hand tells of them without a walk.
            j, is_beside = indices[e], False
            for k in range(size):
                is_beside |= ring[k] == j
            if not is_beside and not is_around(draft, i, j) and not is_beyond(draft, i, j):
                is_far[i] = is_far[j] = True


@njit(cache=True, nogil=True)
def is_around(draft, v, other):
    """Tell whether an edge joins v and `other`."""
    start = h = first_around(draft, v)
    while h >= 0:
        if draft.corners[following(h)] == other or draft.corners[preceding(h)] == other:
            return True
        h = next_around(draft, h)
        if h == start:
            break
    return False


@njit(cache=True, nogil=True)
def is_beyond(draft, v, other):
    """Tell whether an edge joins some neighbour of v and `other`."""
    start = h = first_around(draft, v)
    while h >= 0:
        if is_around(draft, draft.corners[following(h)], other):
            return True
        back = draft.corners[preceding(h)]
        h = next_around(draft, h)
        if h < 0:  # v is on the boundary: the last neighbour begins no triangle of the fan
            return is_around(draft, back, other)
        if h == start:
            break
    return False
