"""From the surface on which stars agree to a disc: one orientation, no pinches, pockets closed."""

import math

import numpy as np
from numba import njit

from .half_edges import cross_at, following, preceding
from .swaps import are_joined, link

ON_BOUNDARY = 1 << 30  # rank of a fan on the boundary asked for, over that of any size
# Ears that may fold back: as many, or a share of the rim. A choice: small pockets may fold back all round, as in noise;
# one that does at every fourth point of a long rim is no pocket, and there a map has to tell.
FEW_BAD, MOST_BAD = 6, 0.25
MOST_LOOKED_AT = 4000  # points of a rim up to which each ear is looked at for those it holds: the time is their square


@njit(cache=True, nogil=True)
def to_half_edges(triangles, edge_of, sides, number, corners, twin):
    """Write the corners of triangles that have a number, and their opposite half-edges, -1 where there is none."""
    for t in range(len(triangles)):
        if number[t] < 0:
            continue
        for k in range(3):
            h, e = 3 * number[t] + k, edge_of[t, (k + 2) % 3]
            corners[h], twin[h] = triangles[t, k], -1
            other = sides[e, 0] + sides[e, 1] - t  # -1 at an edge of one triangle
            if sides[e, 1] >= 0 and number[other] >= 0:
                for j in range(3):
                    if edge_of[other, (j + 2) % 3] == e:
                        twin[h] = 3 * number[other] + j


@njit(cache=True, nogil=True)
def keep_largest(twin, is_kept):
    """Keep the largest part, of those kept, that edges join."""
    part, stack = np.full(len(is_kept), -1, np.int64), np.empty(len(is_kept), np.int64)
    best = most = -1
    for seed in range(len(is_kept)):
        if part[seed] >= 0 or not is_kept[seed]:
            continue
        part[seed], stack[0], depth, size = seed, seed, 1, 0
        while depth > 0:
            depth -= 1
            t = stack[depth]
            size += 1
            for h in range(3 * t, 3 * t + 3):
                other = twin[h] // 3
                if twin[h] >= 0 and is_kept[other] and part[other] < 0:
                    part[other], stack[depth] = seed, other
                    depth += 1
        if size > most:
            best, most = seed, size
    for t in range(len(is_kept)):
        is_kept[t] = part[t] == best


@njit(cache=True, nogil=True)
def along_rim(twin, h):
    """Return the boundary half-edge that follows h with the surface on its left."""
    k = following(h)
    while twin[k] >= 0:
        k = following(twin[k])
    return k


@njit(cache=True, nogil=True)
def mark_rims(twin, rim):
    """Give the boundary walks numbers, in `rim` for each half-edge, -1 inside; return how many there are."""
    rim[:] = -1
    count = 0
    for h in range(len(twin)):
        if twin[h] < 0 and rim[h] < 0:
            k = h
            while rim[k] < 0:
                rim[k] = count
                k = along_rim(twin, k)
            count += 1
    return count


@njit(cache=True, nogil=True)
def mark_pinching(corners, twin, rim, ahead, behind, first, is_kept):
    """Drop fans where two walks meet in a point, or one meets an inner point; return how many.

    The fan on the boundary asked for stays, else the larger one: `ahead` and `behind` are the points beside each one on
    that boundary, -1 elsewhere. A walk that passes a point twice is left: its loops are two pockets that touch. `first`
    is scratch space, -1.
    """
    n_triangles, dropped = np.zeros(len(first), np.int32), 0
    for v in corners:
        n_triangles[v] += 1
    # Each fan on a rim is met once, at the boundary half-edge that leaves its point.
    for h in range(len(corners)):
        if twin[h] >= 0:
            continue
        v = corners[h]
        size, rank = fan_size(corners, twin, h, ahead[v], behind[v])
        n_triangles[v] -= size
        best = np.int64(first[v])
        if best < 0:
            first[v] = h
        elif rim[best] != rim[h]:
            is_better = rank > fan_size(corners, twin, best, ahead[v], behind[v])[1]
            drop_fan(twin, best if is_better else h, is_kept)
            first[v] = h if is_better else best
            dropped += 1
    for h in range(len(corners)):
        v = corners[h]
        if first[v] < 0 or n_triangles[v] == 0:
            continue
        # What is left besides the fans on the rim is a closed one, at an inner point.
        best = np.int64(first[v])
        if fan_size(corners, twin, best, ahead[v], behind[v])[1] < ON_BOUNDARY:
            drop_fan(twin, best, is_kept)
        else:
            k = twin[h]
            while k >= 0 and following(k) != h:
                k = twin[following(k)]
            if k < 0:  # this half-edge is of a fan on the rim
                continue
            drop_closed_fan(twin, h, is_kept)
        n_triangles[v] = 0
        dropped += 1
    return dropped


@njit(cache=True, nogil=True)
def fan_size(corners, twin, h, ahead, behind):
    """Count the triangles around the origin of boundary half-edge h, and rank the fan: first those with given ends."""
    size, one = 1, corners[following(h)]
    while twin[preceding(h)] >= 0:
        h = twin[preceding(h)]
        size += 1
    other = corners[preceding(h)]
    on_boundary = ahead >= 0 and (one in (ahead, behind) or other in (ahead, behind))
    return size, size + (ON_BOUNDARY if on_boundary else 0)


@njit(cache=True, nogil=True)
def drop_closed_fan(twin, h, is_kept):
    """Drop the triangles all around the origin of half-edge h."""
    is_kept[h // 3] = False
    k = twin[preceding(h)]
    while k != h:
        is_kept[k // 3] = False
        k = twin[preceding(k)]


@njit(cache=True, nogil=True)
def drop_fan(twin, h, is_kept):
    """Drop the triangles around the origin of boundary half-edge h."""
    is_kept[h // 3] = False
    while twin[preceding(h)] >= 0:
        h = twin[preceding(h)]
        is_kept[h // 3] = False


@njit(cache=True, nogil=True)
def cut_walks(corners, twin, ahead, behind, place, path, loops, starts, is_kept):
    """Cut the boundary walks into loops that pass no point twice; return how many, and how many fans are in the way.

    The half-edges of each loop follow each other in `loops`, beginning at `starts`. A walk that passes two points in
    turn, twice, is no rim of a surface in the plane: there the lower fan is dropped (see `mark_pinching`). `place`,
    (n_points,) of -1, and `path` are scratch space.
    """
    seen, closed = np.zeros(len(twin), np.bool_), np.full(len(place), -1, np.int64)
    walk = np.full(len(place), -1, np.int64)
    count = size = tangled = 0
    for seed in range(len(twin)):
        if twin[seed] >= 0 or seen[seed]:
            continue
        depth, h = 0, seed
        while not seen[h]:
            seen[h] = True
            v = corners[h]
            if walk[v] == seed:
                one = fan_size(corners, twin, h, ahead[v], behind[v])[1]
                other = fan_size(corners, twin, closed[v], ahead[v], behind[v])[1]
                drop_fan(twin, h if one < other else closed[v], is_kept)
                tangled += 1
            # The walk has come back to a point: what it went through since is a loop of its own.
            if place[v] >= 0:
                size, depth = close_loop(corners, place, path, np.int64(place[v]), depth, loops, starts, count, size)
                count += 1
                for k in range(starts[count - 1] + 1, size):
                    closed[corners[loops[k]]], walk[corners[loops[k]]] = loops[k], seed
            place[v], path[depth] = depth, h
            depth += 1
            h = along_rim(twin, h)
        size, depth = close_loop(corners, place, path, 0, depth, loops, starts, count, size)
        count += 1
    starts[count] = size
    return count, tangled


@njit(cache=True, nogil=True)
def close_loop(corners, place, path, begin, depth, loops, starts, count, size):
    """Take the path from `begin` on off its end and write it as a loop; return the new sizes."""
    starts[count] = size
    for k in range(begin, depth):
        loops[size] = path[k]
        place[corners[path[k]]] = -1
        size += 1
    return size, begin


@njit(cache=True, nogil=True)
def cap(points, corners, twin, loop, first_free):
    """Close a loop of boundary half-edges by cutting ears, those with the shortest base first.

    New triangles go to places `first_free` and on; returns the next free place, or -1 if all bases are edges already.
    Of all ears those are cut at once that are better than both beside them. Ears that fold back or hold a point of the
    rim wait until there are no others; if there are many, this is no pocket of the surface, and -1 is returned.
    """
    n = len(loop)
    edge, after, before = loop.copy(), np.empty(n, np.int64), np.empty(n, np.int64)
    cost, bad, active = np.empty(n), np.empty(n, np.bool_), np.arange(n)
    for k in range(n):
        after[k], before[k] = (k + 1) % n, (k - 1) % n
    for k in range(n):
        cost[k], bad[k] = ear_cost(points, corners, twin, edge, active, k, after[k], n == 3)
    left, may_be_bad, n_bad = n, False, 0
    while left > 3:
        cut = 0
        for place in range(len(active)):
            k = active[place]
            if edge[k] < 0 or left <= 3 or cost[k] == np.inf or (bad[k] and not may_be_bad):
                continue
            # Ears beside each other share a half-edge, so only one of them can be cut.
            if goes_before(cost, bad, before[k], k) or goes_before(cost, bad, after[k], k):
                continue
            other = after[k]
            edge[k] = add_ear(corners, twin, edge[k], edge[other], first_free)
            first_free, edge[other] = first_free + 1, -1
            after[k], before[after[other]] = after[other], k
            left, cut, n_bad = left - 1, cut + 1, n_bad + bad[k]
            for m in (before[k], k):
                cost[m], bad[m] = ear_cost(points, corners, twin, edge, active, m, after[m], left == 3)
        if (cut == 0 and may_be_bad) or n_bad > max(FEW_BAD, MOST_BAD * n):
            return -1
        active = active[edge[active] >= 0]
        may_be_bad = cut == 0
        if may_be_bad:
            for k in active:  # what an ear held may be gone
                cost[k], bad[k] = ear_cost(points, corners, twin, edge, active, k, after[k], left == 3)
                may_be_bad &= bad[k] or cost[k] == np.inf
            if not may_be_bad:
                continue
    for k in active:
        if edge[k] >= 0:
            third = add_ear(corners, twin, edge[k], edge[after[k]], first_free)
            link(twin, third, edge[before[k]])
            return first_free + 1
    return -1


@njit(cache=True, nogil=True, inline="always")
def goes_before(cost, bad, one, other):
    """Tell whether one ear is to be cut before another."""
    if bad[one] != bad[other]:
        return bad[other]
    return cost[one] < cost[other] or (cost[one] == cost[other] and one < other)


@njit(cache=True, nogil=True)
def add_ear(corners, twin, h, k, place):
    """Put a triangle on boundary half-edges h, ab, and k, bc; return its own half-edge along ac."""
    a, b, c = corners[h], corners[k], corners[following(k)]
    new = 3 * place
    corners[new], corners[new + 1], corners[new + 2] = a, c, b
    twin[new] = -1
    link(twin, new + 1, k)
    link(twin, new + 2, h)
    return new


@njit(cache=True, nogil=True)
def ear_cost(points, corners, twin, edge, active, one, next_one, is_last):
    """Return the squared base of the ear on two half-edges of a rim, inf if it is an edge, and whether the ear is bad.

    A bad one folds back on the triangles beside it, or holds another point of the rim.
    """
    h, k = edge[one], edge[next_one]
    a, b, c = corners[h], corners[k], corners[following(k)]
    # The last ear's base is the third side, an edge. Asked at both ends: at a pinch, a walk sees one fan of the point.
    if a == c or (not is_last and (are_joined(corners, twin, h, c) or are_joined(corners, twin, following(k), a))):
        return np.inf, True
    base = 0.0
    for d in range(3):
        base += (points[c, d] - points[a, d]) ** 2
    nx, ny, nz = cross_at(points, a, c, b)
    for side in (h, k):
        ox, oy, oz = cross_at(points, corners[side], corners[following(side)], corners[preceding(side)])
        if nx * ox + ny * oy + nz * oz < 0.0:
            return base, True
    if len(active) <= MOST_LOOKED_AT:
        for m in active:
            if edge[m] >= 0:
                v = corners[edge[m]]
                if v != a and v != b and v != c and is_over(points, v, a, c, b, nx, ny, nz):
                    return base, True
    return base, False


@njit(cache=True, nogil=True)
def is_over(points, v, a, b, c, nx, ny, nz):
    """Tell whether v lies over or under triangle abc of area vector n, and nearer than the triangle is wide."""
    height = 0.0
    for d, n in ((0, nx), (1, ny), (2, nz)):
        height += (points[v, d] - points[a, d]) * n
    area = nx * nx + ny * ny + nz * nz
    # The height is |n| times the distance, so this asks if the squared distance is over |n|, twice the area.
    if height * height > area * math.sqrt(area):
        return False
    for p, q in ((a, b), (b, c), (c, a)):
        x, y, z = cross_at(points, p, q, v)
        if x * nx + y * ny + z * nz < 0.0:
            return False
    return True
