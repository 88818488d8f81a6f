"""Tensor-product B-splines: basis functions, values and derivatives, normal equations."""

import numpy as np
from numba import njit


@njit(cache=True, nogil=True)
def find_span(knots, degree, t):
    """Return s with knots[s] <= t < knots[s + 1], or the first or last span of the domain beyond its ends."""
    low, high = degree, len(knots) - degree - 1
    while high - low > 1:
        middle = (low + high) // 2
        if t < knots[middle]:
            high = middle
        else:
            low = middle
    # At the end of the domain, where knots coincide, back to the last span that has a length.
    while low > degree and knots[low] == knots[low + 1]:
        low -= 1
    return low


@njit(cache=True, nogil=True)
def basis(knots, degree, span, t, order, out, triangle, factors):
    """Write the derivatives up to `order` of the degree + 1 functions that are not 0 in a span (Piegl, Tiller A2.3)."""
    triangle[0, 0] = 1.0  # above its diagonal the functions of each degree, below the differences of knots
    for j in range(1, degree + 1):
        saved = 0.0
        for r in range(j):
            right, left = knots[span + r + 1], knots[span + r + 1 - j]
            triangle[j, r] = right - left
            share = triangle[r, j - 1] / triangle[j, r]
            triangle[r, j] = saved + (right - t) * share
            saved = (t - left) * share
        triangle[j, j] = saved
    for j in range(degree + 1):
        out[0, j] = triangle[j, degree]
    for r in range(degree + 1):
        old, new = 0, 1
        factors[0, 0] = 1.0
        for k in range(1, order + 1):
            value, rk, pk = 0.0, r - k, degree - k
            if pk < 0:  # more derivatives than the degree
                out[k, r] = 0.0
                continue
            if r >= k:
                factors[new, 0] = factors[old, 0] / triangle[pk + 1, rk]
                value = factors[new, 0] * triangle[rk, pk]
            for j in range(1 if rk >= -1 else -rk, (k - 1 if r - 1 <= pk else degree - r) + 1):
                factors[new, j] = (factors[old, j] - factors[old, j - 1]) / triangle[pk + 1, rk + j]
                value += factors[new, j] * triangle[rk + j, pk]
            if r <= pk:
                factors[new, k] = -factors[old, k - 1] / triangle[pk + 1, r]
                value += factors[new, k] * triangle[r, pk]
            out[k, r] = value
            old, new = new, old
    scale = 1.0
    for k in range(1, order + 1):
        scale *= degree + 1 - k
        for j in range(degree + 1):
            out[k, j] *= scale


@njit(cache=True, nogil=True)
def evaluate(knots_u, knots_v, degree, control, uv, du, dv, first, last, out):
    """Write the mixed derivative of order (du, dv) at parameters first..last."""
    triangle, factors = np.empty((degree + 1, degree + 1)), np.empty((2, degree + 1))
    in_u, in_v = np.empty((du + 1, degree + 1)), np.empty((dv + 1, degree + 1))
    for i in range(first, last):
        a, b = find_span(knots_u, degree, uv[i, 0]), find_span(knots_v, degree, uv[i, 1])
        basis(knots_u, degree, a, uv[i, 0], du, in_u, triangle, factors)
        basis(knots_v, degree, b, uv[i, 1], dv, in_v, triangle, factors)
        for c in range(3):
            out[i, c] = 0.0
        for j in range(degree + 1):
            for k in range(degree + 1):
                value = in_u[du, j] * in_v[dv, k]
                for c in range(3):
                    out[i, c] += value * control[a - degree + j, b - degree + k, c]


@njit(cache=True, nogil=True)
def gather(knots_u, knots_v, degree, uv, points, weights, band, right):
    """Add weighted products of basis functions: band[i * b + j, k, l] couples function (i, j) and (i+k-p, j+l-p)."""
    triangle, factors = np.empty((degree + 1, degree + 1)), np.empty((2, degree + 1))
    in_u, in_v = np.empty((1, degree + 1)), np.empty((1, degree + 1))
    n_v = len(knots_v) - degree - 1
    for i in range(len(uv)):
        a, b = find_span(knots_u, degree, uv[i, 0]), find_span(knots_v, degree, uv[i, 1])
        basis(knots_u, degree, a, uv[i, 0], 0, in_u, triangle, factors)
        basis(knots_v, degree, b, uv[i, 1], 0, in_v, triangle, factors)
        for j in range(degree + 1):
            for k in range(degree + 1):
                row, value = (a - degree + j) * n_v + b - degree + k, weights[i] * in_u[0, j] * in_v[0, k]
                for c in range(3):
                    right[row, c] += value * points[i, c]
                for m in range(degree + 1):
                    for n in range(degree + 1):
                        band[row, m - j + degree, n - k + degree] += value * in_u[0, m] * in_v[0, n]


@njit(cache=True, nogil=True)
def basis_rows(knots, degree, places, order, values, columns):
    """Write the derivatives of the functions that are not 0 at each place, and which they are."""
    triangle, factors = np.empty((degree + 1, degree + 1)), np.empty((2, degree + 1))
    out = np.empty((order + 1, degree + 1))
    for i in range(len(places)):
        span = find_span(knots, degree, places[i])
        basis(knots, degree, span, places[i], order, out, triangle, factors)
        for j in range(degree + 1):
            values[i, j], columns[i, j] = out[order, j], span - degree + j
