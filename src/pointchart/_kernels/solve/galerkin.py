"""Interpolation from coarse points by Ruge and Stueben, and the matrix of the next level: Galerkin's product.

A matrix is kept without its diagonal: row i has the columns `indices[indptr[i]:indptr[i + 1]]`, ascending, those under
i before `middle[i]`.
"""

import numpy as np
from numba import njit


@njit(cache=True, nogil=True)
def split_rows(indptr, indices, data, new_indptr, middle, new_indices, new_data, diagonal):
    """Take the diagonal out of a matrix and sort its rows."""
    size = 0
    for i in range(len(indptr) - 1):
        new_indptr[i] = size
        diagonal[i] = 0.0
        for e in range(indptr[i], indptr[i + 1]):
            if indices[e] == i:
                diagonal[i] += data[e]
            else:
                size = insert_sorted(new_indices, new_data, new_indptr[i], size, indices[e], data[e])
        middle[i] = middle_of(new_indices, new_indptr[i], size, i)
    new_indptr[len(indptr) - 1] = size
    return size


@njit(cache=True, nogil=True, inline="always")
def insert_sorted(indices, data, begin, end, column, value):
    """Insert an entry into a sorted row; return the new end."""
    k = end
    while k > begin and indices[k - 1] > column:
        indices[k], data[k] = indices[k - 1], data[k - 1]
        k -= 1
    indices[k], data[k] = column, value
    return end + 1


@njit(cache=True, nogil=True, inline="always")
def middle_of(indices, begin, end, i):
    """Return the place of the first column over i."""
    k = begin
    while k < end and indices[k] < i:
        k += 1
    return k


@njit(cache=True, nogil=True)
def interpolate(indptr, indices, data, diagonal, strong, coarse, p_indptr, p_indices, p_data):
    """Write the interpolation from coarse points: direct, in proportion to the strong links to them; return its size.

    What the other links would take is shared out, so that constants are interpolated where a row sums to zero.
    """
    size = 0
    for i in range(len(indptr) - 1):
        p_indptr[i] = size
        if coarse[i] >= 0:
            p_indices[size], p_data[size] = coarse[i], 1.0
            size += 1
            continue
        # Positive entries have no place in an interpolation; on the diagonal they keep the sum of the row.
        total, taken, center = 0.0, 0.0, diagonal[i]
        for e in range(indptr[i], indptr[i + 1]):
            if data[e] < 0.0:
                total += data[e]
                if strong[e] and coarse[indices[e]] >= 0:
                    taken += data[e]
            else:
                center += data[e]
        for e in range(indptr[i], indptr[i + 1]):
            j = indices[e]
            if taken < 0.0 and strong[e] and coarse[j] >= 0:
                p_indices[size], p_data[size] = coarse[j], -data[e] * (total / taken) / center
                size += 1
    p_indptr[len(indptr) - 1] = size
    return size


@njit(cache=True, nogil=True)
def transpose(indptr, indices, data, first, rows, values):
    """Write the transpose of a matrix; `first` has a place more than it has rows."""
    first[:] = 0
    for j in indices:
        first[j + 1] += 1
    for i in range(len(first) - 1):
        first[i + 1] += first[i]
    filled = first[:-1].copy()
    for i in range(len(indptr) - 1):
        for e in range(indptr[i], indptr[i + 1]):
            k = filled[indices[e]]
            rows[k], values[k] = i, data[e]
            filled[indices[e]] += 1


@njit(cache=True, nogil=True)
def most_entries(indptr, p_indptr, indices, r_indptr, r_indices, first, last):
    """Return how many entries rows first..last of the product R A P have at the most."""
    total = 0
    for s in range(r_indptr[first], r_indptr[last]):
        i = r_indices[s]
        total += np.int64(p_indptr[i + 1] - p_indptr[i])
        for j in indices[indptr[i] : indptr[i + 1]]:
            total += np.int64(p_indptr[j + 1] - p_indptr[j])
    return total


@njit(cache=True, nogil=True)
def galerkin_rows(matrix, prolongation, restriction, first, last, mark, sizes, middle, diagonal, columns, values):
    """Write rows first..last of the product R A P, one after the other; return how many entries they have.

    `mark`, of -1, is scratch space of the number of rows; `sizes` and `middle` are those of each row, the latter from
    its beginning.
    """
    indptr, indices, data, center = matrix
    r_indptr, r_indices, r_data = restriction
    size = 0
    for row in range(first, last):
        begin, own = size, 0.0
        for s in range(r_indptr[row], r_indptr[row + 1]):
            i, r = r_indices[s], r_data[s]
            size, own = add_row(prolongation, i, r * center[i], row, begin, size, own, mark, columns, values)
            for e in range(indptr[i], indptr[i + 1]):
                j, a = indices[e], r * data[e]
                size, own = add_row(prolongation, j, a, row, begin, size, own, mark, columns, values)
        for k in range(begin, size):
            mark[columns[k]] = -1
        end = begin
        for k in range(begin, size):
            end = insert_sorted(columns, values, begin, end, columns[k], values[k])
        sizes[row], diagonal[row] = size - begin, own
        middle[row] = middle_of(columns, begin, size, row) - begin
    return size


@njit(cache=True, nogil=True)
def add_row(prolongation, j, factor, row, begin, size, own, mark, columns, values):
    """Add a multiple of a row of the interpolation to the row of a product from `begin`; return size and diagonal."""
    p_indptr, p_indices, p_data = prolongation
    for t in range(p_indptr[j], p_indptr[j + 1]):
        column, value = p_indices[t], factor * p_data[t]
        if column == row:
            own += value
        elif mark[column] >= begin and columns[mark[column]] == column:
            values[mark[column]] += value
        else:
            mark[column], columns[size], values[size] = size, column, value
            size += 1
    return size, own
