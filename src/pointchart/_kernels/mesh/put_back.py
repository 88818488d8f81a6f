"""Take points out of a mesh and put them back where they cost less."""

import numpy as np
from numba import njit

from .editable import anchor, first_around, inner_degree, next_around, record, swap_noted, undo
from .energy import alone_energy, swap_gain, tent_energy
from .half_edges import following, preceding
from .swaps import are_joined, link

MOST_TRIANGLES = 60  # around a point that is taken out, a cap: on the face there are 17 at most
MOST_SWAPS = 400  # after one is put in, a cap: on the face there are 21 at most
STACK = 5 * MOST_SWAPS + 20  # each swap asks for five edges; it begins with the twelve of four triangles
# Both triangles of each swap are noted; taking out notes three more and putting in one.
JOURNAL = 2 * (MOST_TRIANGLES + MOST_SWAPS) + 10


@njit(cache=True, nogil=True)
def relocate(draft, queue, waiting, count, indptr, indices, least, most, is_touched):
    """Relocate the points of a ring buffer and all that this touches; return the moves that were made.

    `waiting` tells which points are in the queue, the first `count` of it; a move has to lower the energy by more than
    `least`, and `most` moves are tried. `is_touched` marks the points of all triangles that moves have changed.
    """
    stack = np.empty(STACK, np.int64)
    head = moves = tried = 0
    while count > 0 and tried < most:
        v = queue[head]
        # A point waits once at most, so the ring of as many places as points has room.
        head, count, tried = (head + 1) % len(queue), count - 1, tried + 1
        waiting[v] = False
        n = relocate_one(draft, v, indices[indptr[v] : indptr[v + 1]], stack, least)
        moves += n > 0
        for place in range(n):
            t = draft.journal[place, 0]
            for u in draft.corners[3 * t : 3 * t + 3]:
                is_touched[u] = True
                if not waiting[u]:
                    queue[(head + count) % len(queue)] = u
                    count += 1
                    waiting[u] = True
    return moves


@njit(cache=True, nogil=True)
def relocate_one(draft, v, near, stack, least):
    """Move v to the place near by where it costs least; return the length of the journal, 0 if v stays."""
    degree = inner_degree(draft, v)
    if degree == 0 or degree > MOST_TRIANGLES:
        return 0
    n, change = thin_out(draft, v, degree)
    if n < 0:
        return 0
    h = np.int64(draft.leaving[v])
    one, two = next_around(draft, h), next_around(draft, next_around(draft, h))
    n, taken = take_out(draft, n, v, h, one, two)
    place, added = cheapest_place(draft, v, near)
    if place < 0:
        undo(draft, n)
        return 0
    n = put_in(draft, n, v, place, one // 3, two // 3)
    size = 0
    for t in (h // 3, place, one // 3, two // 3):
        for k in range(3 * t, 3 * t + 3):
            stack[size] = k
            size += 1
    n, smoothed = descend(draft, n, stack, size, least)
    # Where its own place is the cheapest, nothing is gained, and all is undone.
    if not change + taken + added + smoothed < -least:
        undo(draft, n)
        return 0
    return n


@njit(cache=True, nogil=True)
def thin_out(draft, v, degree):
    """Swap edges of v until three are left; return the length of the journal, -1 if it cannot be, and the change."""
    n, change = 0, 0.0
    while degree > 3:
        best, gain, h = np.int64(-1), -np.inf, np.int64(draft.leaving[v])
        for _ in range(degree):
            apex, other = preceding(h), draft.corners[preceding(draft.twins[h])]
            if not are_joined(draft.corners, draft.twins, apex, other):
                g = swap_gain(draft, h)
                if g > gain:
                    best, gain = h, g
            h = next_around(draft, h)
        if best < 0:
            undo(draft, n)
            return -1, 0.0
        n, change, degree = swap_noted(draft, n, best), change - gain, degree - 1
    return n, change


@njit(cache=True, nogil=True)
def take_out(draft, n, v, h, one, two):
    """Replace the three triangles around v, which these half-edges leave, by one in the place of the first."""
    a, b, c = draft.corners[following(h)], draft.corners[following(one)], draft.corners[following(two)]
    ab, bc, ca = following(h), following(one), following(two)
    before = tent_energy(draft, v, a, b, c, ab, bc, ca)
    out_ab, out_bc, out_ca = draft.twins[ab], draft.twins[bc], draft.twins[ca]
    for k in (h, one, two):  # all three: `put_in` fills two of them without noting what they were
        n = record(draft, n, k // 3)
    first = 3 * (h // 3)
    draft.corners[first], draft.corners[first + 1], draft.corners[first + 2] = a, b, c
    link(draft.twins, first, out_ab)
    link(draft.twins, first + 1, out_bc)
    link(draft.twins, first + 2, out_ca)
    anchor(draft, first // 3)  # a, b and c must not leave by the two triangles that are free now
    return n, alone_energy(draft, a, b, c, first, first + 1, first + 2) - before


@njit(cache=True, nogil=True)
def cheapest_place(draft, v, near):
    """Return the triangle at one of the near points where v costs least, and what it costs there."""
    place, least = -1, np.inf
    for u in near:
        start = h = first_around(draft, u)
        while True:
            ab = 3 * (h // 3)
            a, b, c = draft.corners[ab], draft.corners[ab + 1], draft.corners[ab + 2]
            cost = tent_energy(draft, v, a, b, c, ab, ab + 1, ab + 2)
            cost -= alone_energy(draft, a, b, c, ab, ab + 1, ab + 2)
            if cost < least:
                place, least = ab // 3, cost
            h = next_around(draft, h)
            if h < 0 or h == start:
                break
    return place, least


@njit(cache=True, nogil=True)
def put_in(draft, n, v, place, one, two):
    """Replace a triangle by three around v; two of them take the free places `one` and `two`."""
    n = record(draft, n, place)
    a, b, c = draft.corners[3 * place], draft.corners[3 * place + 1], draft.corners[3 * place + 2]
    out_ab, out_bc, out_ca = draft.twins[3 * place], draft.twins[3 * place + 1], draft.twins[3 * place + 2]
    for t, p, q, outside in ((place, a, b, out_ab), (one, b, c, out_bc), (two, c, a, out_ca)):
        draft.corners[3 * t], draft.corners[3 * t + 1], draft.corners[3 * t + 2] = v, p, q
        link(draft.twins, 3 * t + 1, outside)
        anchor(draft, t)
    link(draft.twins, 3 * place + 2, 3 * one)
    link(draft.twins, 3 * one + 2, 3 * two)
    link(draft.twins, 3 * two + 2, 3 * place)
    return n


@njit(cache=True, nogil=True)
def descend(draft, n, stack, size, least):
    """Swap edges from a stack while that lowers the energy; return the length of the journal and the change."""
    change, swaps = 0.0, 0
    while size > 0 and swaps < MOST_SWAPS:
        size -= 1
        h = stack[size]
        t = np.int64(draft.twins[h])
        if t < 0:
            continue
        gain = swap_gain(draft, h)
        if gain <= least or are_joined(draft.corners, draft.twins, preceding(h), draft.corners[preceding(t)]):
            continue
        n, change, swaps = swap_noted(draft, n, h), change - gain, swaps + 1
        for side in (h, following(h), t, following(t), preceding(h)):
            stack[size] = side
            size += 1
    return n, change
