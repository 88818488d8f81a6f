"""The Clough-Tocher element: three cubics on a triangle, which is split at its barycentre.

Side k of a triangle runs from corner k to the next one, and piece k lies between side k and the barycentre.
"""

import math

import numpy as np
from numba import njit

from ..plane.locate import doubled_area, find_triangle


@njit(cache=True, nogil=True)
def write_net(points, gradients, uv, triangle, crossing, k, net):
    """Write the control points of piece k (Farin 1986, section 5): rows along the side, from there to the barycentre.

    The derivative across side k along a line that meets it at ``crossing[k]`` of its first end is linear on the side.
    """
    start, end, spoke, middle, hub = np.empty(3), np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    for c in range(3):
        for i in range(3):
            a, b = triangle[i], triangle[(i + 1) % 3]
            x, y = (uv[b, 0] - uv[a, 0]) / 3.0, (uv[b, 1] - uv[a, 1]) / 3.0
            start[i] = points[a, c] + x * gradients[a, 0, c] + y * gradients[a, 1, c]
            end[i] = points[b, c] - x * gradients[b, 0, c] - y * gradients[b, 1, c]
        for i in range(3):
            spoke[i] = (points[triangle[i], c] + start[i] + end[i - 1]) / 3.0
        for i in range(3):
            j = (i + 1) % 3
            first = points[triangle[i], c] - 2.0 * start[i] + end[i]
            last = start[i] - 2.0 * end[i] + points[triangle[j], c]
            middle[i] = 0.5 * (spoke[i] + spoke[j] - crossing[i] * first - (1.0 - crossing[i]) * last)
        for i in range(3):
            hub[i] = (spoke[i] + middle[i] + middle[i - 1]) / 3.0
        j = (k + 1) % 3
        net[0, c], net[1, c], net[2, c], net[3, c] = points[triangle[k], c], start[k], end[k], points[triangle[j], c]
        net[4, c], net[5, c], net[6, c] = spoke[k], middle[k], spoke[j]
        net[7, c], net[8, c], net[9, c] = hub[k], hub[j], (hub[0] + hub[1] + hub[2]) / 3.0


@njit(cache=True, nogil=True)
def contract(net, degree, a, b, c):
    """Lower the degree of a net by one, in place: a step of de Casteljau's algorithm with weights a, b and c."""
    new, old = 0, 0
    for row in range(degree):
        length = degree + 1 - row
        for i in range(old, old + length - 1):
            for x in range(3):
                net[new, x] = a * net[i, x] + b * net[i + 1, x] + c * net[i + length, x]
            new += 1
        old += length


@njit(cache=True, nogil=True)
def coordinates(uv, triangle, x, y, out):
    """Write the barycentric coordinates of a place, and the rates at which they change along u and v; return the least.

    Row 0 is the place, row 1 u, row 2 v. What is returned is the corner whose coordinate is least.
    """
    area, least = 0.0, 0
    for i in range(3):
        a, b = triangle[(i + 1) % 3], triangle[(i + 2) % 3]
        out[0, i], out[1, i], out[2, i] = doubled_area(uv, a, b, x, y), uv[a, 1] - uv[b, 1], uv[b, 0] - uv[a, 0]
        area += out[0, i]
        if out[0, i] < out[0, least]:
            least = i
    out /= area
    return least


@njit(cache=True, nogil=True)
def evaluate(uv, triangles, boxes, slack, points, gradients, crossings, places, du, dv, first, last, out):
    """Write the mixed derivative of order (du, dv), at most 3 in all, at places first..last; nan off the mesh."""
    net, weights = np.empty((10, 3)), np.empty((3, 3))
    factor = 6.0 / math.gamma(4 - du - dv)  # 3! / (3 - du - dv)!, as each derivative of a cubic takes down its degree
    for p in range(first, last):
        out[p] = math.nan
        t = find_triangle(uv, triangles, boxes, places[p, 0], places[p, 1], slack)
        if t < 0:
            continue
        # The place lies in the piece at the side across from the corner whose coordinate is least.
        apex = coordinates(uv, triangles[t], places[p, 0], places[p, 1], weights)
        i, j = (apex + 1) % 3, (apex + 2) % 3
        write_net(points, gradients, uv, triangles[t], crossings[t], i, net)
        for step in range(3):
            row = 1 if step < du else 2 if step < du + dv else 0
            # Coordinates in the piece: its third corner is the barycentre g, so the apex is 3 g less the other two.
            third = weights[row, apex]
            contract(net, 3 - step, weights[row, i] - third, weights[row, j] - third, 3.0 * third)
        for c in range(3):
            out[p, c] = factor * net[0, c]
