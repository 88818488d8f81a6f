"""Sides that a triangulation in the plane must have, by edge swaps and exact signs."""

from numba import njit

from ..mesh.editable import first_around, next_around, swap_noted
from ..mesh.half_edges import following, preceding
from ..plane.exact_turns import turn


@njit(cache=True, nogil=True)
def constrain(draft, ahead):
    """Make an edge from each point to the one `ahead` of it, or none if that is -1.

    Return (-1, -1), or the first point whose side is in the way of another and a point of that other one.
    """
    for a in range(len(ahead)):
        if ahead[a] >= 0:
            obstacle = insert_side(draft, ahead, a, ahead[a])
            if obstacle >= 0:
                return a, obstacle
    return -1, -1


@njit(cache=True, nogil=True)
def insert_side(draft, ahead, a, b):
    """Make ab an edge; return -1, or a point on it or an end of a side that crosses it: then the mesh is spoilt.

    First each edge that crosses ab is swapped for one from a, whether or not its triangles fold over; then the fans of
    a on both sides are unfolded. That takes less than two swaps for each edge that crosses.
    """
    k, obstacle = edge_before(draft, a, b)
    if k < 0:
        return obstacle
    h, n_left, n_right = following(k), 0, 0
    while True:
        p, q = draft.corners[h], draft.corners[following(h)]
        if ahead[p] == q or ahead[q] == p:
            return p
        t = draft.twins[h]
        d = draft.corners[preceding(t)]
        side = 0 if d == b else turn_of(draft.points, a, b, d)
        if side == 0 and d != b:
            return d
        swap_noted(draft, 0, h)
        if d == b:
            break
        n_left, n_right = n_left + (side > 0), n_right + (side < 0)
        h = following(t) if side > 0 else h
    along = k = preceding(h)
    for _ in range(n_right + 1):
        k = following(draft.twins[k])
    unfold(draft, k, n_right)
    unfold(draft, along, n_left)
    return -1


@njit(cache=True, nogil=True)
def edge_before(draft, a, b):
    """Return (the last edge around the inner point a that is not left of ab, -1).

    That is (-1, -1) if ab is an edge, and (-1, p) if the point p is on it.
    """
    h = first_around(draft, a)
    while True:
        p, q = draft.corners[following(h)], draft.corners[preceding(h)]
        if p == b or q == b:
            return -1, -1
        if turn_of(draft.points, a, b, q) > 0:
            side = turn_of(draft.points, a, p, b)
            if side >= 0:
                return (h, -1) if side > 0 else (-1, p)
        h = next_around(draft, h)


@njit(cache=True, nogil=True)
def unfold(draft, k, n):
    """Clip ears off the fan of the n + 2 edges from half-edge k on, anticlockwise around its origin.

    The ends of the fan's edges bound a polygon that is seen from one of its sides, so Graham's scan finds ears only,
    and in one pass (Toussaint and Avis 1982); what is left is seen from the origin.
    """
    passed = 0
    while n > 0:
        h = next_around(draft, k)
        p, u, v = draft.corners[following(k)], draft.corners[following(h)], draft.corners[preceding(h)]
        if turn_of(draft.points, p, u, v) <= 0:
            k, n, passed = h, n - 1, passed + 1
            continue
        swap_noted(draft, 0, h)
        if passed > 0:
            k, passed = following(draft.twins[k]), passed - 1
        else:
            n -= 1


@njit(cache=True, nogil=True, inline="always")
def turn_of(points, a, b, c):
    """Return the exact orientation of three points in the plane: 1 anticlockwise, -1, or 0."""
    return turn(points[a, 0], points[a, 1], points[b, 0], points[b, 1], points[c, 0], points[c, 1])
