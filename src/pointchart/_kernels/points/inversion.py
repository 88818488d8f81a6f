"""Delaunay neighbourhoods by inversion: one small convex hull a point instead of one triangulation a point.

With the centre at the origin of its plane and q' = q / |q|^2, the Delaunay neighbours of the centre are the vertices
of the convex hull of {q'}. The centre is on the hull of its neighbours when a gap of at least pi opens between them;
its star is then the hull of {q'} and the origin, less the origin.
"""

import math

import numpy as np
from numba import njit

from .tangent_planes import tangent_frame

OPEN_GAP_SINE = 1e-6  # a gap within 1e-6 rad of pi counts as open: rounding must not wrap a star across it
FLAT_TURN_SINE = 1e-10  # neighbours on a common circle up to rounding: the middle one goes, so that a grid gives four


@njit(cache=True, nogil=True, inline="always")
def pseudo_angle(x, y):
    """Return a number in [0, 4) that grows with the angle of (x, y)."""
    p = x / (abs(x) + abs(y))
    return 1.0 - p if y >= 0.0 else 3.0 + p


@njit(cache=True, nogil=True, inline="always")
def turns_left(ax, ay, bx, by, cx, cy):
    """Tell whether the path a, b, c turns left by more than rounding."""
    ux, uy, vx, vy = bx - ax, by - ay, cx - bx, cy - by
    cross = ux * vy - uy * vx
    # Squared on both sides, to save two roots in the innermost loop; so the sign is asked first.
    return cross > 0.0 and cross * cross > FLAT_TURN_SINE**2 * ((ux * ux + uy * uy) * (vx * vx + vy * vy))


@njit(cache=True, nogil=True, inline="always")
def is_one_direction(ax, ay, bx, by):
    """Tell whether two vectors point the same way, but for rounding."""
    dot, cross = ax * bx + ay * by, ax * by - ay * bx
    return dot > 0.0 and abs(cross) <= FLAT_TURN_SINE * dot


@njit(cache=True, nogil=True)
def project(points, normal, i, neighbors, steepest, name, x, y, angle):
    """Project neighbours to the tangent plane, sorted by angle; return how many are left.

    Neighbours steeper than `steepest` (sine against the plane) belong to another sheet and go.
    """
    ux, uy, uz, vx, vy, vz = tangent_frame(normal[0], normal[1], normal[2])
    n = 0
    for j in neighbors:
        dx, dy, dz = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
        px, py = dx * ux + dy * uy + dz * uz, dx * vx + dy * vy + dz * vz
        flat = px * px + py * py
        # `<=`, so that a point that coincides goes too: it has no direction.
        if j == i or flat <= (1.0 - steepest * steepest) * (dx * dx + dy * dy + dz * dz):
            continue
        t = pseudo_angle(px, py)
        k = n
        while k > 0 and angle[k - 1] > t:
            name[k], x[k], y[k], angle[k] = name[k - 1], x[k - 1], y[k - 1], angle[k - 1]
            k -= 1
        name[k], x[k], y[k], angle[k] = j, px, py, t
        n += 1
    return n


@njit(cache=True, nogil=True)
def drop_hidden(name, x, y, n):
    """Keep of sorted neighbours in one direction the nearest; return how many are left."""
    kept = 0
    for k in range(n):
        if kept > 0 and is_one_direction(x[k], y[k], x[kept - 1], y[kept - 1]):
            if x[k] ** 2 + y[k] ** 2 >= x[kept - 1] ** 2 + y[kept - 1] ** 2:
                continue
            kept -= 1
        name[kept], x[kept], y[kept] = name[k], x[k], y[k]
        kept += 1
    # First and last may be one direction too, on both sides of where pseudo-angles begin anew.
    if kept > 1 and is_one_direction(x[0], y[0], x[kept - 1], y[kept - 1]):
        kept -= 1
        if x[kept] ** 2 + y[kept] ** 2 < x[0] ** 2 + y[0] ** 2:
            name[0], x[0], y[0] = name[kept], x[kept], y[kept]
    return kept


@njit(cache=True, nogil=True)
def measure_sides(x, y, turns, n):
    """Return the largest angle from one of n sorted neighbours to the next, and how far their centroid lies off.

    The latter is over their mean distance. `turns` are the pseudo-angles of the neighbours, which grow by 2 in half a
    turn and so tell on which side of one the next lies, whatever rounding does to those in one direction.
    """
    if n == 0:
        return 2.0 * math.pi, 1.0
    widest, angle, mx, my, mr = -1.0, 2.0 * math.pi, 0.0, 0.0, 0.0
    radius = math.sqrt(x[0] * x[0] + y[0] * y[0])
    for k in range(n):
        m = k + 1 if k + 1 < n else 0
        mx, my, mr = mx + x[k], my + y[k], mr + radius
        other = math.sqrt(x[m] * x[m] + y[m] * y[m])
        cosine = (x[k] * x[m] + y[k] * y[m]) / (radius * other)
        span = turns[m] - turns[k] if m > 0 else turns[m] - turns[k] + 4.0
        # Grows with the angle, from 0 to 4.
        measure = 1.0 - cosine if span <= 2.0 else 3.0 + cosine
        if measure > widest:
            between = math.atan2(abs(x[k] * y[m] - y[k] * x[m]), x[k] * x[m] + y[k] * y[m])
            widest, angle = measure, between if span <= 2.0 else 2.0 * math.pi - between
        radius = other
    return angle, math.sqrt(mx * mx + my * my) / mr


@njit(cache=True, nogil=True)
def gap_end(x, y, n):
    """Return the neighbour behind a gap of at least pi, anticlockwise, or -1 where there is none."""
    if n < 3:  # such a gap is there always
        return 0 if n < 2 or x[0] * y[1] - y[0] * x[1] > 0.0 else 1
    for k in range(n):
        m = k + 1 if k + 1 < n else 0
        cross = x[k] * y[m] - y[k] * x[m]
        slack = OPEN_GAP_SINE * math.sqrt((x[k] ** 2 + y[k] ** 2) * (x[m] ** 2 + y[m] ** 2))
        if cross < -slack or (cross <= slack and x[k] * x[m] + y[k] * y[m] < 0.0):
            return m
    return -1


@njit(cache=True, nogil=True)
def hull_of_inverses(x, y, n, start, is_open, p, q, stack):
    """Write the Delaunay neighbours among n sorted ones to `stack`, anticlockwise from `start`; return how many.

    `p` and `q` are scratch space, for the inverses.
    """
    for k in range(n):
        square = x[k] * x[k] + y[k] * y[k]
        p[k], q[k] = x[k] / square, y[k] / square
    size = 0
    # Graham's scan; a closed star begins with the nearest, a corner for certain, and ends when it comes round to it.
    for step in range(n if is_open else n + 1):
        k = start + step if start + step < n else start + step - n
        while size > 1:
            a, b = stack[size - 2], stack[size - 1]
            if turns_left(p[a], q[a], p[b], q[b], p[k], q[k]):
                break
            size -= 1
        stack[size] = k
        size += 1
    return size if is_open else size - 1


@njit(cache=True, nogil=True)
def circumdiameter(ax, ay, bx, by):
    """Return the diameter of the circle through the origin, a and b."""
    cross = abs(ax * by - ay * bx)
    if cross == 0.0:
        return np.inf
    return math.sqrt((ax * ax + ay * ay) * (bx * bx + by * by) * ((ax - bx) ** 2 + (ay - by) ** 2)) / cross


@njit(cache=True, nogil=True)
def delaunay_stars(
    points,
    normals,
    indptr,
    indices,
    steepest,
    first,
    last,
    star,
    local,
    count,
    is_open,
    is_short,
    width,
    angle,
    offset,
):
    """Find the Delaunay neighbours of points first..last among their candidates; return how many there are in all.

    Stars follow each other: names in `star`, planar positions in `local`, anticlockwise, `count[i]` of them for point
    i. `width` is the largest circumradius, infinite for an open star; one is short whose circles reach beyond the last
    of its candidates. `angle` and `offset` tell of a boundary (see `measure_sides`).
    """
    most = 1
    for i in range(first, last):
        most = max(most, np.int64(indptr[i + 1] - indptr[i]))
    name, stack = np.empty(most, np.int64), np.empty(most + 2, np.int64)
    x, y, turns, p, q = np.empty(most), np.empty(most), np.empty(most), np.empty(most), np.empty(most)
    total = 0
    for i in range(first, last):
        row = indices[indptr[i] : indptr[i + 1]]
        n = project(points, normals[i], i, row, steepest, name, x, y, turns)
        angle[i], offset[i] = measure_sides(x, y, turns, n)
        n = drop_hidden(name, x, y, n)
        start = gap_end(x, y, n)
        is_open[i] = start >= 0
        if not is_open[i]:  # the nearest neighbour is the farthest inverse, so it is on the hull
            start = 0
            for k in range(1, n):
                if x[k] ** 2 + y[k] ** 2 < x[start] ** 2 + y[start] ** 2:
                    start = k
        size = hull_of_inverses(x, y, n, start, is_open[i], p, q, stack) if n > 0 else 0
        count[i], diameter = size, 0.0
        for s in range(size):
            k, m = stack[s], stack[s + 1 if s + 1 < size else 0]
            star[total], local[total, 0], local[total, 1] = name[k], x[k], y[k]
            total += 1
            if s + 1 < size or not is_open[i]:
                diameter = max(diameter, circumdiameter(x[k], y[k], x[m], y[m]))
        square = 0.0
        for k in range(3 if len(row) > 0 else 0):
            square += (points[row[-1], k] - points[i, k]) ** 2
        is_short[i] = not is_open[i] and diameter > math.sqrt(square)
        width[i] = np.inf if is_open[i] else 0.5 * diameter
    return total
