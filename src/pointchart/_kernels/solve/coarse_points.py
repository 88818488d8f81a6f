"""The choice of coarse points by Ruge and Stueben.

A matrix is kept without its diagonal, as in `galerkin`.
"""

import numpy as np
from numba import njit

STRONG = 0.25  # of the largest weight of a row, from which on a link is strong (Ruge and Stueben 1987, as is usual)


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
    rank = np.empty(n, np.int32)
    most = 2 * rank_points(first, rank) + 2  # lists: no point counts more than twice in a rank
    head, after, before = np.full(most, -1, np.int32), np.empty(n, np.int32), np.empty(n, np.int32)
    for i in range(n - 1, -1, -1):
        push(head, after, before, i, rank[i])
    coarse[:] = -2
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
    return number_chosen(coarse)


@njit(cache=True, nogil=True)
def number_chosen(coarse):
    """Give the chosen points, marked by 0, their numbers in order; return how many they are."""
    count = 0
    for i in range(len(coarse)):
        if coarse[i] == 0:
            coarse[i] = count
            count += 1
    return count


@njit(cache=True, nogil=True)
def rank_points(first, rank):
    """Write how many points depend on each one; return the largest number."""
    most = 0
    for i in range(len(rank)):
        rank[i] = first[i + 1] - first[i]
        most = max(most, rank[i])
    return most


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
