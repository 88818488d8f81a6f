"""Recover edges that a triangulation in the plane should have."""

from numba import njit

from ..plane.areas import doubled_area
from .editable import first_around, next_around, swap_noted, undo
from .energy import swap_gain
from .half_edges import following, preceding
from .swaps import are_joined

MOST_CROSSED = 200  # edges on the way from one end to the other
MOST_SWAPS = 300  # for one edge, a cap: the maze takes 89 at most for those that are recovered, the face 30
JOURNAL = 2 * MOST_SWAPS  # both triangles of each swap


@njit(cache=True, nogil=True, inline="always")
def side(uv, a, b, c):
    """Return a number that is positive where c lies left of the line from a to b."""
    return doubled_area(uv, a, b, uv[c, 0], uv[c, 1])


@njit(cache=True, nogil=True)
def recover(draft, uv, one, other):
    """Make each pair of points an edge where that lowers the energy; return how many were made and how many missed."""
    made = missed = 0
    for e in range(len(one)):
        done = recover_one(draft, uv, one[e], other[e])
        made += done > 0
        missed += done < 0
    return made, missed


@njit(cache=True, nogil=True)
def recover_one(draft, uv, a, b):
    """Swap edges that cross ab until ab is one; return the swaps, 0 if it was one before, -1 if it stays none."""
    n, change, made = 0, 0.0, (-1, -1)
    while n + 2 <= JOURNAL:
        h = edge_towards(draft, uv, a, b)
        if h == -1 and change <= 0.0:
            return n // 2
        if h >= 0:
            h = swappable(draft, uv, a, b, h, made)
        if h < 0:
            break
        made = draft.corners[preceding(h)], draft.corners[preceding(draft.twins[h])]
        change -= swap_gain(draft, h)
        n = swap_noted(draft, n, h)
    undo(draft, n)
    return -1


@njit(cache=True, nogil=True)
def edge_towards(draft, uv, a, b):
    """Return the edge opposite a that the line to b leaves by; -1 if ab is an edge, -2 if there is none."""
    start = h = first_around(draft, a)
    towards = -2
    while True:
        p, q = draft.corners[following(h)], draft.corners[preceding(h)]
        if p == b or q == b:
            return -1
        if side(uv, a, p, q) > 0.0 and side(uv, a, p, b) >= 0.0 and side(uv, a, b, q) >= 0.0:
            towards = following(h)
        h = next_around(draft, h)
        if h < 0 or h == start:
            return towards


@njit(cache=True, nogil=True)
def swappable(draft, uv, a, b, h, made):
    """Walk along ab from half-edge h that it crosses; return a crossed one that can be swapped, or -1.

    One whose replacement does not cross ab comes first; failing that, the first but the edge `made` last, which would
    go back and forth.
    """
    fallback = -1
    for _ in range(MOST_CROSSED):
        t = draft.twins[h]
        if t < 0:
            break
        p, q = draft.corners[h], draft.corners[t]
        c, d = draft.corners[preceding(h)], draft.corners[preceding(t)]
        is_convex = side(uv, c, p, d) > 0.0 and side(uv, d, q, c) > 0.0
        if is_convex and not are_joined(draft.corners, draft.twins, preceding(h), d):
            if c == a or d == b or (side(uv, a, b, c) >= 0.0) == (side(uv, a, b, d) >= 0.0):
                return h
            if fallback < 0 and made not in ((p, q), (q, p)):
                fallback = h
        if d == b:
            break
        # Half-edge t runs from q to p; the line goes on between d and the one of them on its other side.
        is_left = side(uv, a, b, d) >= 0.0
        h = following(t) if is_left == (side(uv, a, b, p) < 0.0) else preceding(t)
    return fallback
