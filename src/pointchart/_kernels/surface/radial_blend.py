"""Surfaces of radial functions that weights of overlapping discs blend.

A jet holds a value and its derivatives in u, v, uu, uv and vv. The fourth coordinate of a local surface is 1, so that
the weights are summed along with what they weigh.
"""

import math

import numpy as np
from numba import njit

from ..plane.locate import holds, next_box


@njit(cache=True, nogil=True)
def weight_jet(x, y, radius, jet):
    """Write the jet of (1 - t)^4 (4 t + 1), t the distance from the middle in radii (Wendland 1995); 0 for t >= 1."""
    x, y = x / radius, y / radius
    t = math.sqrt(x * x + y * y)
    if t >= 1.0:
        jet[:] = 0.0
        return
    rest = 1.0 - t
    # w' is -20 t (1 - t)^3: over t it has no pole; the bend has one, which x and y in the jet take away.
    slope, bend = -20.0 * rest**3 / radius, 60.0 * rest**2 / max(t, 1e-300)
    jet[0] = rest**4 * (4.0 * t + 1.0)
    jet[1], jet[2] = slope * x, slope * y
    jet[3], jet[4], jet[5] = bend * x * x, bend * x * y, bend * y * y
    for k in range(3, 6):
        jet[k] = jet[k] / radius**2
    jet[3] += slope / radius
    jet[5] += slope / radius


@njit(cache=True, nogil=True)
def start_jet(coefficients, x, y, jet):
    """Write the jet of a quadratic, given by its coefficients of 1, x, y, x^2, x y and y^2."""
    for c in range(3):
        one, in_x, in_y, xx, xy, yy = coefficients[:, c]
        jet[0, c] = one + (in_x + xx * x + xy * y) * x + (in_y + yy * y) * y
        jet[1, c], jet[2, c] = in_x + 2.0 * xx * x + xy * y, in_y + xy * x + 2.0 * yy * y
        jet[3, c], jet[4, c], jet[5, c] = 2.0 * xx, xy, 2.0 * yy


@njit(cache=True, nogil=True)
def surface_jet(centers, coefficients, x, y, spacing, order, jet):
    """Write the jet of a local surface up to `order`: fifth powers of distances, and a quadratic in the last rows.

    Its own unit of length is `spacing`.
    """
    x, y = x / spacing, y / spacing
    start_jet(coefficients[len(centers) :], x, y, jet)
    for i in range(len(centers)):
        dx, dy = x - centers[i, 0], y - centers[i, 1]
        square = dx * dx + dy * dy
        r = math.sqrt(square)
        value, slope, bend = square * square * r, 5.0 * square * r, 15.0 * r
        for c in range(3):
            w = coefficients[i, c]
            jet[0, c] += w * value
            if order > 0:
                jet[1, c] += w * slope * dx
                jet[2, c] += w * slope * dy
            if order > 1:
                jet[3, c] += w * (slope + bend * dx * dx)
                jet[4, c] += w * bend * dx * dy
                jet[5, c] += w * (slope + bend * dy * dy)
    for c in range(3):
        jet[1, c], jet[2, c] = jet[1, c] / spacing, jet[2, c] / spacing
        for k in range(3, 6):
            jet[k, c] = jet[k, c] / spacing**2


@njit(cache=True, nogil=True)
def add_product(f, g, total):
    """Add the jet of the product of a number and a vector to `total`."""
    for c in range(g.shape[1]):
        total[0, c] += f[0] * g[0, c]
        total[1, c] += f[1] * g[0, c] + f[0] * g[1, c]
        total[2, c] += f[2] * g[0, c] + f[0] * g[2, c]
        total[3, c] += f[3] * g[0, c] + 2.0 * f[1] * g[1, c] + f[0] * g[3, c]
        total[4, c] += f[4] * g[0, c] + f[1] * g[2, c] + f[2] * g[1, c] + f[0] * g[4, c]
        total[5, c] += f[5] * g[0, c] + 2.0 * f[2] * g[2, c] + f[0] * g[5, c]


@njit(cache=True, nogil=True)
def divide(jet):
    """Divide the first three columns of a jet by the fourth, in place."""
    w = jet[:, 3]
    for c in range(3):
        s = jet[0, c] / w[0]
        u, v = (jet[1, c] - s * w[1]) / w[0], (jet[2, c] - s * w[2]) / w[0]
        jet[3, c] = (jet[3, c] - 2.0 * u * w[1] - s * w[3]) / w[0]
        jet[4, c] = (jet[4, c] - u * w[2] - v * w[1] - s * w[4]) / w[0]
        jet[5, c] = (jet[5, c] - 2.0 * v * w[2] - s * w[5]) / w[0]
        jet[0, c], jet[1, c], jet[2, c] = s, u, v


@njit(cache=True, nogil=True)
def evaluate(domain, discs, boxes, centers, coefficients, places, k, first, last, out):
    """Write number k of the jet of the blended surface at places first..last; nan outside the domain."""
    leaves = len(boxes) // 2
    order = 0 if k == 0 else 1 if k < 3 else 2
    weight, local, total = np.empty(6), np.zeros((6, 4)), np.empty((6, 4))
    local[0, 3] = 1.0
    for p in range(first, last):
        x, y = places[p, 0], places[p, 1]
        out[p] = math.nan
        if not (domain[0, 0] <= x <= domain[1, 0] and domain[0, 1] <= y <= domain[1, 1]):
            continue
        total[:] = 0.0
        v = 1
        while v > 0:
            if holds(boxes, v, x, y, 0.0):
                if v < leaves:
                    v *= 2
                    continue
                d = v - leaves
                u, w = x - discs[d, 0], y - discs[d, 1]
                weight_jet(u, w, discs[d, 2], weight)
                if weight[0] > 0.0:
                    surface_jet(centers[d], coefficients[d], u, w, discs[d, 3], order, local)
                    add_product(weight, local, total)
            v = next_box(v)
        divide(total)
        for c in range(3):
            out[p, c] = total[k, c]
