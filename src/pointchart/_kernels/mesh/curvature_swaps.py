"""Edge swaps that lower the discrete curvature of a mesh.

Each point has three sums, which are rows of `sums` or of the change that a swap makes to them: the angle defect, the
bends of its edges and a third of the area of its triangles.
"""

import math

import numpy as np
from numba import njit

from .half_edges import cross_at, following, preceding
from .swaps import angle_parts, are_joined, swap

NORMALS, MEAN, GAUSSIAN, PRINCIPAL = 0, 1, 2, 3  # the costs: numbers, as compiled code has no enumerations
DEFECT, BEND, AREA = 0, 1, 2  # columns of the sums
SHAPE_WEIGHT = 1e-3  # of the cotangents: turns of a thousandth of a radian are flat, and there Delaunay's rule decides
LEAST_GAIN = 1e-6  # the root of what rounding leaves of the angle defect in a plane
MOST_COTANGENTS = 500.0  # of a triangle: with more, getting rid of a sliver would be worth a fold


@njit(cache=True, nogil=True)
def area_vector(points, a, b, c):
    """Return the normal of a triangle with twice its area for length, to the last bit the same from every corner."""
    # From the least corner on, so that what is taken off the sums is to the bit what was added.
    if b < a and b < c:
        a, b, c = b, c, a
    elif c < a and c < b:
        a, b, c = c, a, b
    return cross_at(points, a, b, c)


@njit(cache=True, nogil=True)
def distance(points, a, b):
    """Return the distance of two points."""
    x, y, z = points[a, 0] - points[b, 0], points[a, 1] - points[b, 1], points[a, 2] - points[b, 2]
    return math.sqrt(x * x + y * y + z * z)


@njit(cache=True, nogil=True)
def cotangents(points, a, b, c):
    """Return the sum of the cotangents of a triangle's angles; over a plane mesh it is least for Delaunay's."""
    x, y, z = area_vector(points, a, b, c)
    squares = distance(points, a, b) ** 2 + distance(points, b, c) ** 2 + distance(points, c, a) ** 2
    doubled_area = math.sqrt(x * x + y * y + z * z)
    return 0.5 * squares / doubled_area if squares < 2.0 * MOST_COTANGENTS * doubled_area else MOST_COTANGENTS


@njit(cache=True, nogil=True)
def turn_at_edge(points, a, b, c, d):
    """Return the angle between the normals of triangles abc and bad; pi if one has no area, lest it hide a fold."""
    px, py, pz = area_vector(points, a, b, c)
    qx, qy, qz = area_vector(points, b, a, d)
    x, y, z = py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx
    cross, dot = math.sqrt(x * x + y * y + z * z), px * qx + py * qy + pz * qz
    return math.pi if cross == 0.0 and dot == 0.0 else math.atan2(cross, dot)


@njit(cache=True, nogil=True)
def add_bend(points, cost, a, b, c, d, i, j, sign, sums):
    """Add edge ab of triangles abc and bad to rows i and j; d is -1 on the boundary, which does not bend."""
    if d < 0:
        return
    length = 1.0 if cost == NORMALS else distance(points, a, b)
    # A half for mean curvature's mean of two directions, a half for each end of the edge.
    bend = 0.25 * sign * length * turn_at_edge(points, a, b, c, d)
    sums[i, BEND] += bend
    sums[j, BEND] += bend


@njit(cache=True, nogil=True)
def add_triangle(points, a, b, c, i, j, k, sign, sums):
    """Add triangle abc to rows i, j and k: its angles are taken off the defects."""
    for apex, left, right, row in ((a, b, c, i), (b, c, a, j), (c, a, b, k)):
        dot, cross, _ = angle_parts(points, apex, left, right)
        sums[row, DEFECT] -= sign * math.atan2(cross, dot)
        sums[row, AREA] += sign * cross / 6.0  # a third of the area, of which the cross product is twice


@njit(cache=True, nogil=True)
def add_pair(points, cost, corner, outer, row, sign, sums):
    """Add triangles abc and bad and their five edges to the rows of a, b, c and d.

    `outer` are the points of the triangles beyond bc, ca, ad and db, or -1.
    """
    a, b, c, d = corner
    i, j, k, m = row
    if cost in (GAUSSIAN, PRINCIPAL):
        add_triangle(points, a, b, c, i, j, k, sign, sums)
        add_triangle(points, b, a, d, j, i, m, sign, sums)
    if cost != GAUSSIAN:
        add_bend(points, cost, a, b, c, d, i, j, sign, sums)
        add_bend(points, cost, b, c, a, outer[0], j, k, sign, sums)
        add_bend(points, cost, c, a, b, outer[1], k, i, sign, sums)
        add_bend(points, cost, a, d, b, outer[2], i, m, sign, sums)
        add_bend(points, cost, d, b, a, outer[3], m, j, sign, sums)


@njit(cache=True, nogil=True)
def sum_curvature(points, corners, twins, cost, sums):
    """Write the sums of all points; the defects are those of inner points."""
    sums[:, DEFECT], sums[:, BEND], sums[:, AREA] = 2.0 * math.pi, 0.0, 0.0
    for h in range(len(corners)):
        a, b, c = corners[h], corners[following(h)], corners[preceding(h)]
        if h % 3 == 0:
            add_triangle(points, a, b, c, a, b, c, 1.0, sums)
        if twins[h] > h:
            add_bend(points, cost, a, b, c, corners[preceding(twins[h])], a, b, 1.0, sums)


@njit(cache=True, nogil=True)
def cost_at_point(cost, is_rim, defect, bend, area):
    """Return what a point adds to the total; on the boundary the angles tell of its shape and not of the surface's."""
    k = 0.0 if is_rim else defect
    if cost == GAUSSIAN:
        return abs(k)
    if cost == PRINCIPAL:
        # |k1| + |k2| is |2 H| for K >= 0, else 2 sqrt(H^2 - K); bend is |H| times the area, and k is K times the area.
        return 2.0 * bend if k >= 0.0 else 2.0 * math.sqrt(bend * bend - k * max(area, 0.0))
    return bend


@njit(cache=True, nogil=True)
def apex_beyond(corners, twins, h):
    """Return the third point of the triangle on the other side of half-edge h, or -1."""
    return corners[preceding(twins[h])] if twins[h] >= 0 else -1


@njit(cache=True, nogil=True)
def gain_of_swap(points, corners, twins, cost, unit, is_rim, h, sums, change):
    """Return by how much the swap of half-edge h lowers the total, and write what it adds to the sums of abcd."""
    t = twins[h]
    a, b, c, d = corners[h], corners[t], corners[preceding(h)], corners[preceding(t)]
    bc, ca = apex_beyond(corners, twins, following(h)), apex_beyond(corners, twins, preceding(h))
    ad, db = apex_beyond(corners, twins, following(t)), apex_beyond(corners, twins, preceding(t))
    change[:] = 0.0
    add_pair(points, cost, (a, b, c, d), (bc, ca, ad, db), (0, 1, 2, 3), -1.0, change)
    add_pair(points, cost, (c, d, b, a), (db, bc, ca, ad), (2, 3, 1, 0), 1.0, change)
    gain = cotangents(points, a, b, c) + cotangents(points, b, a, d)
    gain -= cotangents(points, c, d, b) + cotangents(points, d, c, a)
    gain *= SHAPE_WEIGHT * unit
    for row, v in enumerate((a, b, c, d)):
        defect, bend, area = sums[v, DEFECT], sums[v, BEND], sums[v, AREA]
        gain += cost_at_point(cost, is_rim[v], defect, bend, area)
        gain -= cost_at_point(
            cost, is_rim[v], defect + change[row, DEFECT], bend + change[row, BEND], area + change[row, AREA]
        )
    return gain


@njit(cache=True, nogil=True)
def curvature_swaps(points, corners, twins, cost, unit, is_rim, sums, touched):
    """Swap edges while that lowers the total; return how many swaps that took.

    Each sweep looks at the edges that have a corner which the last sweep or this one touched: the gain of a swap is a
    matter of the triangles round its four corners. As the total falls by more than rounding each time, it ends. The
    unit is a spacing of the points where the cost is a length, else 1.
    """
    change = np.empty((4, 3))
    total, before, sweep = 0, -1, 0
    touched[:] = 0
    while total > before:
        before = total
        sweep += 1
        for h in range(len(corners)):
            t = twins[h]
            if t < h:
                continue
            a, b, c, d = corners[h], corners[t], corners[preceding(h)], corners[preceding(t)]
            if max(touched[a], touched[b], touched[c], touched[d]) < sweep - 1:
                continue
            gain = gain_of_swap(points, corners, twins, cost, unit, is_rim, h, sums, change)
            # Asked so that a gain that is nan swaps nothing.
            if not gain > LEAST_GAIN * unit or are_joined(corners, twins, preceding(h), d):
                continue
            swap(corners, twins, h)
            total += 1
            for row, v in enumerate((a, b, c, d)):
                sums[v] += change[row]
                touched[v] = sweep
    return total
