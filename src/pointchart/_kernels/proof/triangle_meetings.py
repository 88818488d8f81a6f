"""Meetings of triangles in space."""

from numba import njit

from ..plane.crossings import turn

# Shewchuk 1997: a computed determinant has the right sign if it exceeds (7 + 56 eps) eps times the sum of its terms;
# terms below the second number may have lost digits to underflow.
FILTER = 7.7715611723761027e-16
SMALLEST_SAFE = 1e-280


@njit(cache=True, nogil=True)
def side(points, a, b, c, d):
    """Return on which side of the plane through a, b, c point d lies: 1, -1, or 0 where floating point is unsure."""
    ax, ay, az = points[a, 0] - points[d, 0], points[a, 1] - points[d, 1], points[a, 2] - points[d, 2]
    bx, by, bz = points[b, 0] - points[d, 0], points[b, 1] - points[d, 1], points[b, 2] - points[d, 2]
    cx, cy, cz = points[c, 0] - points[d, 0], points[c, 1] - points[d, 1], points[c, 2] - points[d, 2]
    p, q, r, s, t, u = bx * cy, by * cx, cx * ay, cy * ax, ax * by, ay * bx
    volume = az * (p - q) + bz * (r - s) + cz * (t - u)
    terms = abs(az) * (abs(p) + abs(q)) + abs(bz) * (abs(r) + abs(s)) + abs(cz) * (abs(t) + abs(u))
    if abs(volume) <= FILTER * terms + SMALLEST_SAFE:
        return 0
    return 1 if volume > 0.0 else -1


@njit(cache=True, nogil=True)
def sides_of(points, one, other):
    """Return on which side of triangle `one` each corner of triangle `other` lies."""
    a, b, c = one
    return side(points, a, b, c, other[0]), side(points, a, b, c, other[1]), side(points, a, b, c, other[2])


@njit(cache=True, nogil=True)
def pierces(points, one, sides, other):
    """Tell if an edge of triangle `one`, its corners at `sides` of `other`, meets that: 1, -1 if not, 0 if unsure."""
    verdict, (a, b, c) = -1, other
    for k in range(3):
        p, q, product = one[k], one[(k + 1) % 3], sides[k] * sides[(k + 1) % 3]
        if product > 0:
            continue
        u, v, w = side(points, p, q, a, b), side(points, p, q, b, c), side(points, p, q, c, a)
        if min(u, v, w) < 0 < max(u, v, w):
            continue
        if product * u * v * w != 0:
            return 1
        verdict = 0  # unsure, but another edge may be sure
    return verdict


@njit(cache=True, nogil=True)
def is_apart_in_plane(points, one, other, x, y):
    """Tell if an edge of triangle `one`, seen in the plane of axes x and y, surely parts it from `other`."""
    for k in range(3):
        a, b, c = one[k], one[(k + 1) % 3], one[(k + 2) % 3]
        way = turn(points[a, x], points[a, y], points[b, x], points[b, y], points[c, x], points[c, y])
        n_beyond = 0
        for d in other:
            n_beyond += way * turn(points[a, x], points[a, y], points[b, x], points[b, y], points[d, x], points[d, y])
        if n_beyond == -3:
            return True
    return False


@njit(cache=True, nogil=True)
def meet(points, one, other):
    """Tell if two triangles, as tuples of corners, have a place in common: 1, -1 if not, 0 if unsure."""
    sides_of_one, sides_of_other = sides_of(points, one, other), sides_of(points, other, one)
    # Two triangles meet if and only if an edge of one meets the other.
    if abs(sum(sides_of_one)) == 3 or abs(sum(sides_of_other)) == 3:
        return -1
    verdict = max(pierces(points, other, sides_of_one, one), pierces(points, one, sides_of_other, other))
    if verdict == 0:  # mostly triangles in one plane: parted here, they need no exact arithmetic, which is slow
        for x in range(3):
            y = (x + 1) % 3
            if is_apart_in_plane(points, one, other, x, y) or is_apart_in_plane(points, other, one, x, y):
                return -1
    return verdict


@njit(cache=True, nogil=True)
def overlap(boxes, v, box):
    """Tell if box v of `boxes` and another one have a place in common; both hold the least and the largest corner."""
    # Without branches, which would be hard to predict.
    in_x = (boxes[v, 0] <= box[3]) & (box[0] <= boxes[v, 3])
    in_y = (boxes[v, 1] <= box[4]) & (box[1] <= boxes[v, 4])
    in_z = (boxes[v, 2] <= box[5]) & (box[2] <= boxes[v, 5])
    return in_x & in_y & in_z


@njit(cache=True, nogil=True)
def find_meetings(points, triangles, boxes, first, last, pairs):
    """Write which triangles first..last meet later ones without a common corner, and if that is sure; return how many.

    Node v of the tree of boxes has the children 2v and 2v + 1; the last of its levels, of half its size, are those of
    the triangles. Pairs are counted further when there is no room for them.
    """
    leaves, count = len(boxes) // 2, 0
    for i in range(first, last):
        one = (triangles[i, 0], triangles[i, 1], triangles[i, 2])
        v = leaves + i
        box = (boxes[v, 0], boxes[v, 1], boxes[v, 2], boxes[v, 3], boxes[v, 4], boxes[v, 5])
        while True:
            # On to the subtree at the right, which holds the triangles after those that were seen.
            while v & 1:
                v >>= 1
            if v == 0:
                break
            v += 1
            while overlap(boxes, v, box):
                if v < leaves:
                    v *= 2
                    continue
                other = (triangles[v - leaves, 0], triangles[v - leaves, 1], triangles[v - leaves, 2])
                if not (other[0] in one or other[1] in one or other[2] in one):
                    verdict = meet(points, one, other)
                    if verdict >= 0:
                        if count < len(pairs):
                            pairs[count, 0], pairs[count, 1], pairs[count, 2] = i, v - leaves, verdict
                        count += 1
                break
    return count
