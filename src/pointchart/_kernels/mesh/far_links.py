"""Which links between neighbours a mesh has far apart."""

import numpy as np
from numba import njit

from .editable import first_around, next_around
from .half_edges import following, preceding

RING = 32  # points at hand, two a triangle: rings of over 16 triangles, against six mostly, are walked once more


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
