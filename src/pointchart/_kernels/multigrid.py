"""Bi-CGSTAB with an algebraic multigrid cycle for its preconditioner, for two right sides in one pass.

The matrices of all levels follow each other, each without its diagonal and in sorted rows (see `coarsen`): those of
level l begin at row `rows[l]` of `indptr`, and its vectors and diagonal at place `places[l]`.
"""

from typing import Any, NamedTuple

import numpy as np
from numba import njit


class Levels(NamedTuple):
    """Matrices of all levels, interpolations to each from the next, and the inverse of the coarsest matrix.

    Entries may be of single precision: what they make is a preconditioner.
    """

    sizes: Any
    places: Any
    rows: Any
    indptr: Any
    middle: Any
    indices: Any
    data: Any
    diagonal: Any
    p_indptr: Any
    p_indices: Any
    p_data: Any
    coarsest: Any


@njit(cache=True, nogil=True)
def multiply(indptr, indices, data, x, y):
    """Write the product of a matrix in compressed rows and x, (n, 2), to y."""
    for i in range(len(y)):
        s = t = 0.0
        for e in range(indptr[i], indptr[i + 1]):
            j, a = indices[e], data[e]
            s, t = s + a * x[j, 0], t + a * x[j, 1]
        y[i, 0], y[i, 1] = s, t


@njit(cache=True, nogil=True)
def cycle(levels, x, b):
    """Solve for both right sides roughly by one V-cycle: `x` and `b` hold the vectors of all levels, (places, 2).

    One Gauss-Seidel sweep forwards on the way down, from zero, and one backwards on the way up.
    """
    last = len(levels.sizes) - 1
    for level in range(last):
        descend(levels, level, x, b)
    place = levels.places[last]
    for i in range(levels.sizes[last]):
        s = t = 0.0
        for j in range(levels.sizes[last]):
            a = levels.coarsest[i, j]
            s, t = s + a * b[place + j, 0], t + a * b[place + j, 1]
        x[place + i, 0], x[place + i, 1] = s, t
    for level in range(last - 1, -1, -1):
        ascend(levels, level, x, b)


@njit(cache=True, nogil=True)
def descend(levels, level, x, b):
    """Sweep forwards from zero, and write what is left of the right side to the next level.

    After such a sweep, what is left of a row is what its columns over the diagonal take.
    """
    n, place, row = levels.sizes[level], levels.places[level], levels.rows[level]
    x, b, below = x[place : place + n], b[place : place + n], b[levels.places[level + 1] :]
    for i in range(n):
        s, t = b[i, 0], b[i, 1]
        for e in range(levels.indptr[row + i], levels.middle[place + i]):
            j, a = levels.indices[e], levels.data[e]
            s, t = s - a * x[j, 0], t - a * x[j, 1]
        d = 1.0 / levels.diagonal[place + i]
        x[i, 0], x[i, 1] = s * d, t * d
    below[: levels.sizes[level + 1]] = 0.0
    for i in range(n):
        s = t = 0.0
        for e in range(levels.middle[place + i], levels.indptr[row + i + 1]):
            j, a = levels.indices[e], levels.data[e]
            s, t = s - a * x[j, 0], t - a * x[j, 1]
        for e in range(levels.p_indptr[row + i], levels.p_indptr[row + i + 1]):
            j, a = levels.p_indices[e], levels.p_data[e]
            below[j, 0] += a * s
            below[j, 1] += a * t


@njit(cache=True, nogil=True)
def ascend(levels, level, x, b):
    """Add what the next level has found, and sweep backwards."""
    n, place, row = levels.sizes[level], levels.places[level], levels.rows[level]
    below = x[levels.places[level + 1] :]
    x, b = x[place : place + n], b[place : place + n]
    for i in range(n):
        s, t = x[i, 0], x[i, 1]
        for e in range(levels.p_indptr[row + i], levels.p_indptr[row + i + 1]):
            j, a = levels.p_indices[e], levels.p_data[e]
            s, t = s + a * below[j, 0], t + a * below[j, 1]
        x[i, 0], x[i, 1] = s, t
    for i in range(n - 1, -1, -1):
        s, t = b[i, 0], b[i, 1]
        for e in range(levels.indptr[row + i], levels.indptr[row + i + 1]):
            j, a = levels.indices[e], levels.data[e]
            s, t = s - a * x[j, 0], t - a * x[j, 1]
        d = 1.0 / levels.diagonal[place + i]
        x[i, 0], x[i, 1] = s * d, t * d


@njit(cache=True, nogil=True)
def dots(a, b):
    """Return the scalar products of both columns."""
    s = t = 0.0
    for i in range(len(a)):
        s, t = s + a[i, 0] * b[i, 0], t + a[i, 1] * b[i, 1]
    return np.array([s, t])


@njit(cache=True, nogil=True)
def quotients(a, b, counts):
    """Divide two pairs of numbers; 0 for columns that are solved, or by 0."""
    c = np.zeros(2)
    for k in range(2):
        if counts[k] < 0 and b[k] != 0.0:
            c[k] = a[k] / b[k]
    return c


@njit(cache=True, nogil=True)
def advance(x, r, step, along, across):
    """Add `step` times `along` to x, and take as much of `across` from r."""
    for i in range(len(x)):
        for k in range(2):
            x[i, k] += step[k] * along[i, k]
            r[i, k] -= step[k] * across[i, k]


@njit(cache=True, nogil=True)
def bicgstab_pair(indptr, indices, data, levels, right, x, tolerance, most):
    """Solve for both columns of `right` from the start `x`; return the iterations of each, -1 where `most` are too few.

    The matrix is given in compressed rows, and by its levels.

    van der Vorst 1992, preconditioned from the right; a column that has converged is left alone.
    """
    n = len(right)
    guess, known = np.empty((levels.places[-1], 2)), np.empty((levels.places[-1], 2))
    v, t = np.empty((n, 2)), np.empty((n, 2))
    multiply(indptr, indices, data, x, v)
    r = right - v
    shadow, p = r.copy(), r.copy()
    rho, small = dots(shadow, r), tolerance**2 * dots(right, right)
    counts = np.full(2, -1)
    for step in range(most + 1):
        left = dots(r, r)
        for k in range(2):
            if counts[k] < 0 and left[k] <= small[k]:
                counts[k] = step
        if counts.min() >= 0 or step == most:
            break
        known[:n] = p
        cycle(levels, guess, known)
        multiply(indptr, indices, data, guess, v)
        alpha = quotients(rho, dots(shadow, v), counts)
        advance(x, r, alpha, guess, v)
        known[:n] = r
        cycle(levels, guess, known)
        multiply(indptr, indices, data, guess, t)
        omega = quotients(dots(t, r), dots(t, t), counts)
        advance(x, r, omega, guess, t)
        before, rho = rho, dots(shadow, r)
        beta = quotients(rho * alpha, before * omega, counts)
        for i in range(n):
            for k in range(2):
                p[i, k] = r[i, k] + beta[k] * (p[i, k] - omega[k] * v[i, k])
    return counts
