"""Where a surface of triangles is pinched: fans dropped, and its rims cut into loops."""

import numpy as np
from numba import njit

from .half_edges import following, preceding

ON_BOUNDARY = 1 << 30  # rank of a fan on the boundary asked for, over that of any size


@njit(cache=True, nogil=True)
def to_half_edges(triangles, edge_of, sides, number, corners, twins):
    """Write the corners of triangles that have a number, and their opposite half-edges, -1 where there is none."""
    for t in range(len(triangles)):
        if number[t] < 0:
            continue
        for k in range(3):
            h, e = 3 * number[t] + k, edge_of[t, (k + 2) % 3]
            corners[h], twins[h] = triangles[t, k], -1
            other = sides[e, 0] + sides[e, 1] - t  # -1 at an edge of one triangle
            if sides[e, 1] >= 0 and number[other] >= 0:
                for j in range(3):
                    if edge_of[other, (j + 2) % 3] == e:
                        twins[h] = 3 * number[other] + j


@njit(cache=True, nogil=True)
def keep_largest(twins, is_kept):
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
                other = twins[h] // 3
                if twins[h] >= 0 and is_kept[other] and part[other] < 0:
                    part[other], stack[depth] = seed, other
                    depth += 1
        if size > most:
            best, most = seed, size
    for t in range(len(is_kept)):
        is_kept[t] = part[t] == best


@njit(cache=True, nogil=True)
def along_rim(twins, h):
    """Return the boundary half-edge that follows h with the surface on its left."""
    k = following(h)
    while twins[k] >= 0:
        k = following(twins[k])
    return k


@njit(cache=True, nogil=True)
def mark_rims(twins, rim):
    """Give the boundary walks numbers, in `rim` for each half-edge, -1 inside; return how many there are."""
    rim[:] = -1
    count = 0
    for h in range(len(twins)):
        if twins[h] < 0 and rim[h] < 0:
            k = h
            while rim[k] < 0:
                rim[k] = count
                k = along_rim(twins, k)
            count += 1
    return count


@njit(cache=True, nogil=True)
def mark_pinching(corners, twins, rim, ahead, behind, first, is_kept):
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
        if twins[h] >= 0:
            continue
        v = corners[h]
        size, rank = fan_size(corners, twins, h, ahead[v], behind[v])
        n_triangles[v] -= size
        best = np.int64(first[v])
        if best < 0:
            first[v] = h
        elif rim[best] != rim[h]:
            is_better = rank > fan_size(corners, twins, best, ahead[v], behind[v])[1]
            drop_fan(twins, best if is_better else h, is_kept)
            first[v] = h if is_better else best
            dropped += 1
    for h in range(len(corners)):
        v = corners[h]
        if first[v] < 0 or n_triangles[v] == 0:
            continue
        # What is left besides the fans on the rim is a closed one, at an inner point.
        best = np.int64(first[v])
        if fan_size(corners, twins, best, ahead[v], behind[v])[1] < ON_BOUNDARY:
            drop_fan(twins, best, is_kept)
        else:
            k = twins[h]
            while k >= 0 and following(k) != h:
                k = twins[following(k)]
            if k < 0:  # this half-edge is of a fan on the rim
                continue
            drop_closed_fan(twins, h, is_kept)
        n_triangles[v] = 0
        dropped += 1
    return dropped


@njit(cache=True, nogil=True)
def fan_size(corners, twins, h, ahead, behind):
    """Count the triangles around the origin of boundary half-edge h, and rank the fan: first those with given ends."""
    size, one = 1, corners[following(h)]
    while twins[preceding(h)] >= 0:
        h = twins[preceding(h)]
        size += 1
    other = corners[preceding(h)]
    on_boundary = ahead >= 0 and (one in (ahead, behind) or other in (ahead, behind))
    return size, size + (ON_BOUNDARY if on_boundary else 0)


@njit(cache=True, nogil=True)
def drop_closed_fan(twins, h, is_kept):
    """Drop the triangles all around the origin of half-edge h."""
    is_kept[h // 3] = False
    k = twins[preceding(h)]
    while k != h:
        is_kept[k // 3] = False
        k = twins[preceding(k)]


@njit(cache=True, nogil=True)
def drop_fan(twins, h, is_kept):
    """Drop the triangles around the origin of boundary half-edge h."""
    is_kept[h // 3] = False
    while twins[preceding(h)] >= 0:
        h = twins[preceding(h)]
        is_kept[h // 3] = False


@njit(cache=True, nogil=True)
def cut_walks(corners, twins, ahead, behind, place, path, loops, starts, is_kept):
    """Cut the boundary walks into loops that pass no point twice; return how many, and how many fans are in the way.

    The half-edges of each loop follow each other in `loops`, beginning at `starts`. A walk that passes two points in
    turn, twice, is no rim of a surface in the plane: there the lower fan is dropped (see `mark_pinching`). `place`,
    (n_points,) of -1, and `path` are scratch space.
    """
    seen, closed = np.zeros(len(twins), np.bool_), np.full(len(place), -1, np.int64)
    walk = np.full(len(place), -1, np.int64)
    count = size = tangled = 0
    for seed in range(len(twins)):
        if twins[seed] >= 0 or seen[seed]:
            continue
        depth, h = 0, seed
        while not seen[h]:
            seen[h] = True
            v = corners[h]
            if walk[v] == seed:
                one = fan_size(corners, twins, h, ahead[v], behind[v])[1]
                other = fan_size(corners, twins, closed[v], ahead[v], behind[v])[1]
                drop_fan(twins, h if one < other else closed[v], is_kept)
                tangled += 1
            # The walk has come back to a point: what it went through since is a loop of its own.
            if place[v] >= 0:
                size, depth = close_loop(corners, place, path, np.int64(place[v]), depth, loops, starts, count, size)
                count += 1
                for k in range(starts[count - 1] + 1, size):
                    closed[corners[loops[k]]], walk[corners[loops[k]]] = loops[k], seed
            place[v], path[depth] = depth, h
            depth += 1
            h = along_rim(twins, h)
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
