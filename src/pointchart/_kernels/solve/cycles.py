"""The steps of Bi-CGSTAB with an algebraic multigrid cycle for its preconditioner, for two right sides in one pass.

Sweeps go over blocks of rows one by one, each as if the others were known: blocks can be shared out among threads, and
the result does not depend on how. A matrix of a level is kept as in `coarsen`, without its diagonal; index arrays are
unsigned.
"""

from numba import njit

BLOCK = 2048  # rows: a choice between more that threads can share and more that one sweep couples


@njit(cache=True, nogil=True)
def sweep_forward(indptr, middle, indices, data, inverse, known, x, first, last):
    """Solve rows first..last for x by a Gauss-Seidel sweep from zero; `inverse` is that of the diagonal."""
    for begin in range(first, last, BLOCK):
        for i in range(begin, min(begin + BLOCK, last)):
            s, t = known[i, 0], known[i, 1]
            for e in range(indptr[i], middle[i]):
                j, a = indices[e], data[e]
                if j >= begin:  # other blocks may be under way on another thread, so they count as zero still
                    s, t = s - a * x[j, 0], t - a * x[j, 1]
            x[i, 0], x[i, 1] = s * inverse[i], t * inverse[i]


@njit(cache=True, nogil=True)
def find_rest(indptr, middle, indices, data, x, rest, first, last):
    """Write what a sweep forwards leaves of the right side: what columns over the diagonal and other blocks take."""
    for begin in range(first, last, BLOCK):
        for i in range(begin, min(begin + BLOCK, last)):
            s = t = 0.0
            for e in range(indptr[i], middle[i]):
                j, a = indices[e], data[e]
                if j >= begin:
                    break
                s, t = s - a * x[j, 0], t - a * x[j, 1]
            for e in range(middle[i], indptr[i + 1]):
                j, a = indices[e], data[e]
                s, t = s - a * x[j, 0], t - a * x[j, 1]
            rest[i, 0], rest[i, 1] = s, t


@njit(cache=True, nogil=True)
def restrict(indptr, indices, data, rest, known, first, last):
    """Write the right side of rows first..last of the next level."""
    for i in range(first, last):
        s = t = 0.0
        for e in range(indptr[i], indptr[i + 1]):
            j, a = indices[e], data[e]
            s, t = s + a * rest[j, 0], t + a * rest[j, 1]
        known[i, 0], known[i, 1] = s, t


@njit(cache=True, nogil=True)
def prolong(indptr, indices, data, below, x, first, last):
    """Add what the next level has found."""
    for i in range(first, last):
        s, t = x[i, 0], x[i, 1]
        for e in range(indptr[i], indptr[i + 1]):
            j, a = indices[e], data[e]
            s, t = s + a * below[j, 0], t + a * below[j, 1]
        x[i, 0], x[i, 1] = s, t


@njit(cache=True, nogil=True)
def sweep_backward(indptr, middle, indices, data, inverse, known, x, better, first, last):
    """Write to `better` what a Gauss-Seidel sweep backwards makes of x."""
    for begin in range(first, last, BLOCK):
        end = min(begin + BLOCK, last)
        for step in range(end - begin):
            i = end - 1 - step
            s, t = known[i, 0], known[i, 1]
            for e in range(indptr[i], middle[i]):
                j, a = indices[e], data[e]
                s, t = s - a * x[j, 0], t - a * x[j, 1]
            for e in range(middle[i], indptr[i + 1]):
                j, a = indices[e], data[e]
                # Hence two vectors: of other blocks the old values, whichever thread is ahead.
                u, v = (better[j, 0], better[j, 1]) if j < end else (x[j, 0], x[j, 1])
                s, t = s - a * u, t - a * v
            better[i, 0], better[i, 1] = s * inverse[i], t * inverse[i]


@njit(cache=True, nogil=True)
def multiply(indptr, indices, data, x, product, other, sums, first, last):
    """Write rows first..last of the product of a matrix and x; for `sums` of a block see `add_products`."""
    for begin in range(first, last, BLOCK):
        place = begin // BLOCK  # a sum a block, added up in one order later: the same digits on any number of threads
        sums[place] = 0.0
        for i in range(begin, min(begin + BLOCK, last)):
            s = t = 0.0
            for e in range(indptr[i], indptr[i + 1]):
                j, a = indices[e], data[e]
                s, t = s + a * x[j, 0], t + a * x[j, 1]
            product[i, 0], product[i, 1] = s, t
            add_products(sums, place, other, product, i)


@njit(cache=True, nogil=True)
def advance(x, rest, step, along, across, other, sums, first, last):
    """Add `step` times `along` to x, and take as much of `across` from `rest`; sums as those of `multiply`."""
    for begin in range(first, last, BLOCK):
        place = begin // BLOCK
        sums[place] = 0.0
        for i in range(begin, min(begin + BLOCK, last)):
            for k in range(2):
                x[i, k] += step[k] * along[i, k]
                rest[i, k] -= step[k] * across[i, k]
            add_products(sums, place, other, rest, i)


@njit(cache=True, nogil=True, inline="always")
def add_products(sums, place, other, vector, i):
    """Add to the scalar products of a block those of a row, of both columns: with `other`, with itself."""
    s, t = vector[i, 0], vector[i, 1]
    sums[place, 0] += other[i, 0] * s
    sums[place, 1] += other[i, 1] * t
    sums[place, 2] += s * s
    sums[place, 3] += t * t


@njit(cache=True, nogil=True)
def redirect(direction, rest, across, beta, omega, first, last):
    """Turn the direction of the search."""
    for i in range(first, last):
        for k in range(2):
            direction[i, k] = rest[i, k] + beta[k] * (direction[i, k] - omega[k] * across[i, k])
