"""Trim a triangulation to the inside of a given boundary loop."""

from numba import njit

from .half_edges import following


@njit(cache=True, nogil=True)
def peel(corners, twins, successor, stack, removed):
    """Remove triangles from the rim inwards until every boundary half-edge runs along the loop.

    `successor[v]` is the point after v on the loop, -1 for interior points. Marks triangles in `removed`.
    """
    size = 0
    for h in range(len(corners)):
        if twins[h] < 0 and successor[corners[h]] != corners[following(h)]:
            stack[size] = h
            size += 1
    # A triangle may wait by more than one of its sides, so it may be gone when its turn comes.
    while size > 0:
        size -= 1
        h = stack[size]
        if removed[h // 3]:
            continue
        removed[h // 3] = True
        for side in (h, following(h), following(following(h))):
            other = twins[side]
            if other >= 0:
                twins[other] = -1
                if not removed[other // 3] and successor[corners[other]] != corners[following(other)]:
                    stack[size] = other
                    size += 1
