"""The triangle of a planar mesh around a place."""

import math

from numba import njit


@njit(cache=True, nogil=True, inline="always")
def doubled_area(uv, a, b, x, y):
    """Return twice the signed area of the triangle of points a and b and the place (x, y)."""
    return (uv[b, 0] - uv[a, 0]) * (y - uv[a, 1]) - (uv[b, 1] - uv[a, 1]) * (x - uv[a, 0])


@njit(cache=True, nogil=True)
def depth(uv, triangle, x, y):
    """Return how far a place lies inside a triangle, from its nearest side; negative outside.

    Triangles without an area in floating point hold no place.
    """
    least, area = math.inf, 0.0
    for k in range(3):
        a, b = triangle[k], triangle[(k + 1) % 3]
        part = doubled_area(uv, a, b, x, y)
        area += part
        least = min(least, part / math.hypot(uv[b, 0] - uv[a, 0], uv[b, 1] - uv[a, 1]))
    return least if area > 0.0 else -math.inf


@njit(cache=True, nogil=True, inline="always")
def holds(boxes, v, x, y, slack):
    """Tell if box v, its least and its largest corner in space, holds a place of the plane z = 0, but for `slack`."""
    in_x = (boxes[v, 0] - slack <= x) & (x <= boxes[v, 3] + slack)
    return in_x & (boxes[v, 1] - slack <= y) & (y <= boxes[v, 4] + slack)


@njit(cache=True, nogil=True, inline="always")
def next_box(v):
    """Return the box after v and all below it in the order of depth, 0 at the end; boxes 2v and 2v + 1 are below v."""
    while v & 1:  # a right child: all below its parent has been seen
        v >>= 1
    return v + 1 if v > 0 else 0


@njit(cache=True, nogil=True)
def find_triangle(uv, triangles, boxes, x, y, slack):
    """Return the triangle that holds a place, -1 if that lies farther than `slack` from all of them.

    A place on an edge, or off it by rounding, is given to the triangle that it lies deepest in.
    """
    leaves, found, deepest, v = len(boxes) // 2, -1, -slack, 1
    while v > 0:
        if holds(boxes, v, x, y, slack):
            if v < leaves:
                v *= 2
                continue
            # The triangle of any hit will not do: one off by rounding may come first, and a deeper one after.
            inside = depth(uv, triangles[v - leaves], x, y)
            if inside >= deepest:
                found, deepest = v - leaves, inside
            if inside > slack:
                break
        v = next_box(v)
    return found
