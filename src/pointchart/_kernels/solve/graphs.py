"""Directed graphs: what every path to the root must pass, and the scaling that makes a matrix symmetric."""

from numba import njit


@njit(cache=True, nogil=True)
def dominators(order, indptr, indices, root, rank, dominator):
    """Find the immediate dominator of each node: the nearest node that all its paths to the root pass.

    `order` lists the nodes in breadth-first order from the root, `rank` their places in it (-1: no path); row i of the
    graph lists the nodes that an edge leads to from i. Iterates the equations of Cooper, Harvey and Kennedy (2001); in
    breadth-first order a dominator precedes what it dominates, which is all that their intersection needs.
    """
    changed = True
    while changed:
        changed = False
        for node in order:
            if node == root:
                continue
            found = -1
            for e in range(indptr[node], indptr[node + 1]):
                other = indices[e]
                if rank[other] < 0 or dominator[other] < 0:
                    continue
                if found < 0:
                    found = other
                while found != other:
                    if rank[found] > rank[other]:
                        found = dominator[found]
                    else:
                        other = dominator[other]
            if found != dominator[node]:
                dominator[node] = found
                changed = True


@njit(cache=True, nogil=True)
def symmetrizer(order, parent, indptr, indices, values, scale):
    """Write row scales that make a structurally symmetric matrix symmetric along a spanning tree.

    Returns the first node whose tree edge has no counterpart, or -1.
    """
    for node in order:
        up = parent[node]
        if up < 0:
            scale[node] = 1.0
            continue
        there = back = 0.0
        for e in range(indptr[node], indptr[node + 1]):
            if indices[e] == up:
                there = values[e]
        for e in range(indptr[up], indptr[up + 1]):
            if indices[e] == node:
                back = values[e]
        if there == 0.0 or back == 0.0:
            return node
        scale[node] = scale[up] * back / there
    return -1


@njit(cache=True, nogil=True)
def reduce_rows(indptr, indices, data, free, number, full, left_indptr, left_indices, left_data, right):
    """Write the system of the free unknowns: the rows of 1 - Lambda, and what the fixed ones in `full` add to them.

    `free` lists the free unknowns, `number` is the place of each one there, -1 for fixed ones.
    """
    size = 0
    for i in range(len(free)):
        left_indptr[i] = size
        left_indices[size], left_data[size] = i, 1.0
        size += 1
        row = free[i]
        for e in range(indptr[row], indptr[row + 1]):
            j, a = indices[e], data[e]
            if number[j] >= 0:
                left_indices[size], left_data[size] = number[j], -a
                size += 1
            else:
                for k in range(full.shape[1]):
                    right[i, k] += a * full[j, k]
    left_indptr[len(free)] = size
    return size
