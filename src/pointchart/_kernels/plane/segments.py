"""Sides of polygons that meet, and rays that they are hit by, decided exactly."""

from numba import njit

from .exact_turns import turn


@njit(cache=True, nogil=True, inline="always")
def do_meet(places, a, b, c, d):
    """Tell if the segments from place a to b and from c to d have a place in common."""
    ax, ay, bx, by = places[a, 0], places[a, 1], places[b, 0], places[b, 1]
    cx, cy, dx, dy = places[c, 0], places[c, 1], places[d, 0], places[d, 1]
    if max(cy, dy) < min(ay, by) or min(cy, dy) > max(ay, by) or max(cx, dx) < min(ax, bx) or min(cx, dx) > max(ax, bx):
        return False
    # Segments of one line pass both tests, but then they meet because their boxes do.
    if turn(ax, ay, bx, by, cx, cy) * turn(ax, ay, bx, by, dx, dy) > 0:
        return False
    return turn(cx, cy, dx, dy, ax, ay) * turn(cx, cy, dx, dy, bx, by) <= 0


@njit(cache=True, nogil=True)
def measure_meetings(places, after, pairs, first, last, meets):
    """Write which pairs first..last of segments, from place i to place after[i], meet."""
    for p in range(first, last):
        i, j = pairs[p, 0], pairs[p, 1]
        meets[p] = do_meet(places, i, after[i], j, after[j])


@njit(cache=True, nogil=True)
def has_crossing(polygon, order, low, high):
    """Tell if sides of a polygon meet that share no corner, by a sweep in the `order` of `low`, their least x."""
    b = len(polygon)
    for p in range(b):
        i = order[p]
        i_end = (i + 1) % b
        for q in range(p + 1, b):
            j = order[q]
            if low[j] > high[i]:
                break
            j_end = (j + 1) % b
            if j != i_end and i != j_end and do_meet(polygon, i, i_end, j, j_end):
                return True
    return False


@njit(cache=True, nogil=True)
def measure_inside(starts, ends, places, first, last, is_inside):
    """Write for places first..last whether a ray from them to the right hits an odd number of sides.

    A side has its lower end and not its upper one, and a place on a side counts as right of it (Shimrat 1962).
    """
    for i in range(first, last):
        x, y, is_odd = places[i, 0], places[i, 1], False
        for k in range(len(starts)):
            rises, falls = starts[k, 1] <= y < ends[k, 1], ends[k, 1] <= y < starts[k, 1]
            if rises or falls:
                way = turn(starts[k, 0], starts[k, 1], ends[k, 0], ends[k, 1], x, y)
                is_odd ^= way > 0 if rises else way < 0
        is_inside[i] = is_odd
