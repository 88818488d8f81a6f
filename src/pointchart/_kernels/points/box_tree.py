"""The nearest points of points in spatial order, by a tree of boxes over runs of them.

Node 1 is the root of a complete binary tree, nodes 2 v and 2 v + 1 are below node v, and the last half are the leaves:
leaf l holds points `LEAF` l and on. Points that are near in space are mostly near in memory, so the search begins at
the leaf of the point itself and climbs.
"""

import math

import numpy as np
from numba import njit

LEAF = 8  # points; a choice between more boxes, which cost memory and steps, and more distances that lead nowhere
DEEPEST = 64  # levels of a tree, over those of any number of points that 64 bits hold
SLACK, SMALLEST = 1.0 + 1e-9, 1e-300  # for rounding, and for points that coincide


@njit(cache=True, nogil=True)
def bound_boxes(points, low, high):
    """Write the least box around the points of each node."""
    n, leaves = len(points), len(low) // 2
    low[:], high[:] = np.inf, -np.inf
    for i in range(n):
        node = leaves + i // LEAF
        for k in range(3):
            low[node, k], high[node, k] = min(low[node, k], points[i, k]), max(high[node, k], points[i, k])
    for node in range(leaves - 1, 0, -1):
        for k in range(3):
            low[node, k] = min(low[2 * node, k], low[2 * node + 1, k])
            high[node, k] = max(high[2 * node, k], high[2 * node + 1, k])


@njit(cache=True, nogil=True, inline="always")
def square_to_box(low, high, node, x, y, z):
    """Return the squared distance from a place to the box of a node."""
    a = max(max(low[node, 0] - x, x - high[node, 0]), 0.0)
    b = max(max(low[node, 1] - y, y - high[node, 1]), 0.0)
    c = max(max(low[node, 2] - z, z - high[node, 2]), 0.0)
    return a * a + b * b + c * c


@njit(cache=True, nogil=True)
def find_nearest(points, low, high, queries, found, squares):
    """Write the nearest other points of some points, nearest first, and their squared distances.

    As far from a point as the farthest found for the one before it, plus the way between the two, there are enough.
    """
    n, leaves, most = len(points), len(low) // 2, found.shape[1]
    stack, square = np.empty(DEEPEST, np.int64), np.empty(DEEPEST)
    before, reach = 0, np.inf
    for place in range(len(queries)):
        i, row, far = queries[place], found[place], squares[place]
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        # By the triangle inequality: what was found around the point before lies within reach + way of this one.
        way = math.sqrt((x - points[before, 0]) ** 2 + (y - points[before, 1]) ** 2 + (z - points[before, 2]) ** 2)
        count, worst = 0, (reach + way) ** 2 * SLACK + SMALLEST
        subtree = path = leaves + i // LEAF
        while True:
            size, stack[0], square[0] = 1, subtree, square_to_box(low, high, subtree, x, y, z)
            while size > 0:
                size -= 1
                if square[size] >= worst:
                    continue
                node = stack[size]
                if node < leaves:
                    near, other = 2 * node, 2 * node + 1
                    a, b = square_to_box(low, high, near, x, y, z), square_to_box(low, high, other, x, y, z)
                    if a > b:  # the nearer on top: what it holds may rule the other out
                        near, other, a, b = other, near, b, a
                    if b < worst:
                        stack[size], square[size] = other, b
                        size += 1
                    if a < worst:
                        stack[size], square[size] = near, a
                        size += 1
                    continue
                begin = (node - leaves) * LEAF
                # By insertion, as rows are short and mostly in order.
                for j in range(begin, min(begin + LEAF, n)):
                    dx, dy, dz = points[j, 0] - x, points[j, 1] - y, points[j, 2] - z
                    d = dx * dx + dy * dy + dz * dz
                    if d >= worst or j == i:
                        continue
                    k = count if count < most else most - 1
                    count = min(count + 1, most)
                    while k > 0 and far[k - 1] > d:
                        far[k], row[k] = far[k - 1], row[k - 1]
                        k -= 1
                    far[k], row[k] = d, j
                    if count == most:
                        worst = far[most - 1]
            if path == 1:
                break
            # One level up, of which this half has been searched: on with the other.
            subtree, path = path ^ 1, path // 2
        before, reach = np.int64(i), math.sqrt(far[most - 1])


@njit(cache=True, nogil=True)
def middle_distances(points, indptr, indices, one, other, first, last, spacing):
    """Write the mean distance of points first..last to their neighbours in two places of the row."""
    for i in range(first, last):
        total = 0.0
        for place in (one, other):
            j = indices[indptr[i] + place]
            dx, dy, dz = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
            total += math.sqrt(dx * dx + dy * dy + dz * dz)
        spacing[i] = 0.5 * total
