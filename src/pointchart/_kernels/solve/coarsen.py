"""Algebraic coarsening by Ruge and Stueben: coarse points, interpolation, the matrix of the next level.

A matrix is kept without its diagonal: row i has the columns `indices[indptr[i]:indptr[i + 1]]`, ascending, those under
i before `middle[i]`.
"""

import numpy as np
from numba import njit

STRONG = 0.25  # of the largest weight of a row, from which on a link is strong (Ruge and Stueben 1987, as is usual)


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
def mark_strong(indptr, data, strong):
    """Mark the links that are strong, of negative entries only."""
    for i in range(len(indptr) - 1):
        largest = 0.0
        for e in range(indptr[i], indptr[i + 1]):
            largest = max(largest, -data[e])
        for e in range(indptr[i], indptr[i + 1]):
            strong[e] = data[e] < 0.0 and -data[e] >= STRONG * largest


@njit(cache=True, nogil=True)
def reverse_strong(indptr, indices, strong, first, origins):
    """List the points with a strong link to each point, from `first[i]` to `first[i + 1]` of `origins`."""
    n = len(indptr) - 1
    first[:] = 0
    for e in range(len(strong)):
        if strong[e]:
            first[indices[e] + 1] += 1
    for i in range(n):
        first[i + 1] += first[i]
    filled = first[:n].copy()
    for i in range(n):
        for e in range(indptr[i], indptr[i + 1]):
            if strong[e]:
                j = indices[e]
                origins[filled[j]] = i
                filled[j] += 1


@njit(cache=True, nogil=True)
def choose_coarse(indptr, indices, first, origins, strong, coarse):
    """Choose points so that each other one has a strong link to one, few of them; return how many.

    The point on which most others depend comes next, those that have become dependent counting twice. `coarse` becomes
    the number of each chosen point, -1 for the others. Points are kept in lists by their rank.
    """
    n = len(indptr) - 1
    rank, most = np.empty(n, np.int32), 0
    for i in range(n):
        rank[i] = first[i + 1] - first[i]
        most = max(most, rank[i])
    most = 2 * most + 2  # lists: no point counts more than twice in a rank
    head, after, before = np.full(most, -1, np.int32), np.empty(n, np.int32), np.empty(n, np.int32)
    for i in range(n - 1, -1, -1):
        push(head, after, before, i, rank[i])
        coarse[i] = -2
    top = most - 1
    while True:
        while top >= 0 and head[top] < 0:
            top -= 1
        if top < 0:
            break
        i = head[top]
        pull(head, after, before, i, rank[i])
        if rank[i] == 0:
            # Nothing depends on it any more: interpolated if it depends on others, solved for if it is alone.
            coarse[i] = -1 if has_strong(indptr, strong, i) else 0
            continue
        coarse[i] = 0
        for s in range(first[i], first[i + 1]):
            j = origins[s]
            if coarse[j] != -2:
                continue
            coarse[j] = -1
            pull(head, after, before, j, rank[j])
            for e in range(indptr[j], indptr[j + 1]):
                k = indices[e]
                if strong[e] and coarse[k] == -2 and rank[k] + 1 < most:
                    pull(head, after, before, k, rank[k])
                    rank[k] += 1
                    push(head, after, before, k, rank[k])
                    top = max(top, rank[k])
        for e in range(indptr[i], indptr[i + 1]):
            k = indices[e]
            if strong[e] and coarse[k] == -2 and rank[k] > 0:
                pull(head, after, before, k, rank[k])
                rank[k] -= 1
                push(head, after, before, k, rank[k])
    count = 0
    for i in range(n):
        if coarse[i] == 0:
            coarse[i] = count
            count += 1
    return count


@njit(cache=True, nogil=True, inline="always")
def has_strong(indptr, strong, i):
    """Tell whether a row has a strong link."""
    return strong[indptr[i] : indptr[i + 1]].any()


@njit(cache=True, nogil=True, inline="always")
def push(head, after, before, i, rank):
    """Put a point at the head of the list of its rank."""
    following = head[rank]
    head[rank], after[i], before[i] = i, following, -1
    if following >= 0:
        before[following] = i


@njit(cache=True, nogil=True, inline="always")
def pull(head, after, before, i, rank):
    """Take a point out of the list of its rank."""
    if before[i] >= 0:
        after[before[i]] = after[i]
    else:
        head[rank] = after[i]
    if after[i] >= 0:
        before[after[i]] = before[i]


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
