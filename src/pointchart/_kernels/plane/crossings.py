"""Crossings among the sides of a polygon in the plane."""

from numba import njit

UNSURE = 2  # in place of a sign: -1, 0 and 1 are taken

# Shewchuk 1997: a computed orientation is right if it exceeds (3 + 16 eps) eps times the sum of its terms, eps 2^-53.
FILTER = 3.3306690738754716e-16


@njit(cache=True, nogil=True, inline="always")
def turn(ax, ay, bx, by, cx, cy):
    """Return the orientation of a, b, c: 1, -1, or 0 where floating point is unsure."""
    left, right = (ax - cx) * (by - cy), (ay - cy) * (bx - cx)
    if abs(left - right) <= FILTER * (abs(left) + abs(right)):
        return 0
    return 1 if left > right else -1


@njit(cache=True, nogil=True)
def find_crossing(polygon, order, low, high, unsure):
    """Sweep over the sides by `low`, their least x; return (crosses, number of pairs written to `unsure`).

    Sides that share a corner are left out. A pair counts as unsure when floating point cannot decide.
    """
    b, count = len(polygon), 0
    for p in range(b):
        i = order[p]
        ax, ay, bx, by = polygon[i, 0], polygon[i, 1], polygon[(i + 1) % b, 0], polygon[(i + 1) % b, 1]
        for q in range(p + 1, b):
            j = order[q]
            if low[j] > high[i]:
                break
            if j == (i + 1) % b or i == (j + 1) % b:
                continue
            cx, cy, dx, dy = polygon[j, 0], polygon[j, 1], polygon[(j + 1) % b, 0], polygon[(j + 1) % b, 1]
            # By x the sweep has asked already: these pairs have boxes that meet.
            if max(cy, dy) < min(ay, by) or min(cy, dy) > max(ay, by):
                continue
            c, d = turn(ax, ay, bx, by, cx, cy), turn(ax, ay, bx, by, dx, dy)
            if c * d > 0:
                continue
            a, e = turn(cx, cy, dx, dy, ax, ay), turn(cx, cy, dx, dy, bx, by)
            if a * e > 0:
                continue
            if c * d < 0 and a * e < 0:
                return True, count
            # No room to ask exactly: so many unsure pairs are those of a polygon that lies on itself.
            if count == len(unsure):
                return True, count
            unsure[count, 0], unsure[count, 1] = i, j
            count += 1
    return False, count


@njit(cache=True, nogil=True)
def sure_signs(uv, triangles, share, least, first, last, signs):
    """Write the signs of the areas of triangles first..last, UNSURE where rounding may have turned them.

    A sign is sure if the determinant exceeds `share` of the size of its terms, and `least`.
    """
    for t in range(first, last):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        left = (uv[a, 0] - uv[c, 0]) * (uv[b, 1] - uv[c, 1])
        right = (uv[a, 1] - uv[c, 1]) * (uv[b, 0] - uv[c, 0])
        area = left - right
        if abs(area) <= share * (abs(left) + abs(right)) + least:
            signs[t] = UNSURE
        else:
            signs[t] = 1 if area > 0.0 else -1
