"""Drafts of a mesh: edits of its half-edges that can be undone."""

from typing import Any, NamedTuple

import numpy as np
from numba import njit

from .half_edges import following, preceding
from .swaps import link, swap


# Kernels that were compiled for it are kept with its name: under another one, those kept before would not load.
class EditableMesh(NamedTuple):
    """A mesh under work: `leaving` is a half-edge from each point, `journal` holds triangles as they were."""

    points: Any
    corners: Any
    twins: Any
    leaving: Any
    journal: Any


@njit(cache=True, nogil=True)
def record(draft, n, t):
    """Note triangle t as it is in place n of the journal; return the next place."""
    draft.journal[n, 0] = t
    for k in range(3):
        draft.journal[n, 1 + k] = draft.corners[3 * t + k]
        draft.journal[n, 4 + k] = draft.twins[3 * t + k]
    return n + 1


@njit(cache=True, nogil=True)
def undo(draft, n):
    """Put the first n triangles of the journal back, the last first."""
    # The last first, so that of a triangle noted twice the oldest state stands.
    for place in range(n - 1, -1, -1):
        t = draft.journal[place, 0]
        for k in range(3):
            draft.corners[3 * t + k] = draft.journal[place, 1 + k]
            draft.twins[3 * t + k] = draft.journal[place, 4 + k]
    # Only when all are back: triangles that were not noted have to point at these again.
    for place in range(n):
        t = draft.journal[place, 0]
        for h in range(3 * t, 3 * t + 3):
            link(draft.twins, h, draft.twins[h])
        anchor(draft, t)


@njit(cache=True, nogil=True)
def anchor(draft, t):
    """Let the corners of triangle t be left by its half-edges."""
    for h in range(3 * t, 3 * t + 3):
        draft.leaving[draft.corners[h]] = h


@njit(cache=True, nogil=True)
def swap_noted(draft, n, h):
    """Swap the edge of half-edge h and note its triangles; return the next place in the journal."""
    t = draft.twins[h]
    n = record(draft, record(draft, n, h // 3), t // 3)
    swap(draft.corners, draft.twins, h)
    anchor(draft, h // 3)
    anchor(draft, t // 3)
    return n


@njit(cache=True, nogil=True)
def first_around(draft, v):
    """Return the half-edge from v that all others around v follow anticlockwise; any, if v is an inner point."""
    start = k = np.int64(draft.leaving[v])
    while draft.twins[k] >= 0:
        k = np.int64(following(draft.twins[k]))
        if k == start:
            break
    return k


@njit(cache=True, nogil=True)
def next_around(draft, h):
    """Return the half-edge that leaves the same point anticlockwise of h, or -1 past the boundary."""
    return np.int64(draft.twins[preceding(h)])


@njit(cache=True, nogil=True)
def inner_degree(draft, v):
    """Return how many triangles there are around v, 0 on the boundary."""
    start = k = np.int64(draft.leaving[v])
    degree = 0
    while True:
        k = next_around(draft, k)
        degree += 1
        if k < 0:
            return 0
        if k == start:
            return degree
