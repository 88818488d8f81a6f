"""The energy of a mesh in space: long, large and bent triangles cost.

Areas are doubled throughout, and so is the energy. A triangle costs its area times the sum of its squared edges, which
for points in a plane is least for the Delaunay triangulation (Musin 1997); an edge costs twice its square times the
area beside it times the fourth power of the sine of half the angle by which the surface turns there.
"""

import math

from numba import njit

from .half_edges import following, preceding


@njit(cache=True, nogil=True, inline="always")
def triangle_energy(points, a, b, c):
    """Return the energy of a triangle, its area vector and area."""
    ux, uy, uz = points[b, 0] - points[a, 0], points[b, 1] - points[a, 1], points[b, 2] - points[a, 2]
    vx, vy, vz = points[c, 0] - points[a, 0], points[c, 1] - points[a, 1], points[c, 2] - points[a, 2]
    wx, wy, wz = ux - vx, uy - vy, uz - vz
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    area = math.sqrt(nx * nx + ny * ny + nz * nz)
    squares = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz
    return area * squares, (nx, ny, nz, area)


@njit(cache=True, nogil=True, inline="always")
def bend_energy(points, a, b, one, other):
    """Return the energy of edge ab between two triangles, given by their area vectors and areas."""
    x, y, z = points[a, 0] - points[b, 0], points[a, 1] - points[b, 1], points[a, 2] - points[b, 2]
    product = one[3] * other[3]
    # A triangle without an area counts as folded back, lest a sliver hide a fold.
    cosine = (one[0] * other[0] + one[1] * other[1] + one[2] * other[2]) / product if product > 0.0 else -1.0
    # sin^4(theta / 2) is (1 - cos theta)^2 / 4: no angle is needed.
    return 0.5 * (x * x + y * y + z * z) * (one[3] + other[3]) * (1.0 - cosine) ** 2


@njit(cache=True, nogil=True)
def bend_across(draft, h, area):
    """Return the energy of the edge of half-edge h, whose own triangle is given by its area vector and area."""
    t = draft.twins[h]
    if t < 0:
        return 0.0
    a, b, c = draft.corners[t], draft.corners[following(t)], draft.corners[preceding(t)]
    return bend_energy(draft.points, a, b, area, triangle_energy(draft.points, a, b, c)[1])


@njit(cache=True, nogil=True)
def pair_energy(draft, a, b, c, d, bc, ca, ad, db):
    """Return the energy of triangles abc and bad and of their five edges; the outer four are given as half-edges."""
    one, area_one = triangle_energy(draft.points, a, b, c)
    other, area_other = triangle_energy(draft.points, b, a, d)
    energy = one + other + bend_energy(draft.points, a, b, area_one, area_other)
    energy += bend_across(draft, bc, area_one) + bend_across(draft, ca, area_one)
    return energy + bend_across(draft, ad, area_other) + bend_across(draft, db, area_other)


@njit(cache=True, nogil=True)
def swap_gain(draft, h):
    """Return by how much the energy falls when the edge of half-edge h is swapped."""
    t = draft.twins[h]
    bc, ca, ad, db = following(h), preceding(h), following(t), preceding(t)
    a, b, c, d = draft.corners[h], draft.corners[t], draft.corners[ca], draft.corners[db]
    return pair_energy(draft, a, b, c, d, bc, ca, ad, db) - pair_energy(draft, c, d, b, a, db, bc, ca, ad)


@njit(cache=True, nogil=True)
def alone_energy(draft, a, b, c, ab, bc, ca):
    """Return the energy of triangle abc and its three edges, given as half-edges."""
    energy, area = triangle_energy(draft.points, a, b, c)
    return energy + bend_across(draft, ab, area) + bend_across(draft, bc, area) + bend_across(draft, ca, area)


@njit(cache=True, nogil=True)
def tent_energy(draft, v, a, b, c, ab, bc, ca):
    """Return the energy of triangles vab, vbc, vca and their six edges; the outer three are given as half-edges."""
    one, area_one = triangle_energy(draft.points, v, a, b)
    two, area_two = triangle_energy(draft.points, v, b, c)
    three, area_three = triangle_energy(draft.points, v, c, a)
    energy = one + two + three
    energy += bend_energy(draft.points, v, b, area_one, area_two) + bend_energy(
        draft.points, v, c, area_two, area_three
    )
    energy += bend_energy(draft.points, v, a, area_three, area_one) + bend_across(draft, ab, area_one)
    return energy + bend_across(draft, bc, area_two) + bend_across(draft, ca, area_three)


@njit(cache=True, nogil=True)
def total_energy(draft):
    """Return the energy of the whole mesh."""
    total = 0.0
    for t in range(len(draft.corners) // 3):
        h = 3 * t
        energy, area = triangle_energy(draft.points, draft.corners[h], draft.corners[h + 1], draft.corners[h + 2])
        total += energy
        for k in range(h, h + 3):
            if draft.twins[k] > k:
                total += bend_across(draft, k, area)
    return total
