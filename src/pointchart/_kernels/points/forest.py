"""Forests of points: those that links join have one root."""

from numba import njit


@njit(cache=True, nogil=True)
def join(part, a, b):
    """Join the parts of a and b in a forest whose roots are the smallest of each; return whether they were two."""
    while part[a] != a:
        part[a] = part[part[a]]
        a = part[a]
    while part[b] != b:
        part[b] = part[part[b]]
        b = part[b]
    part[max(a, b)] = min(a, b)  # by name, not by size: the root is the smallest point whatever the order
    return a != b


@njit(cache=True, nogil=True)
def join_parts(points, indptr, indices, spacing, most, part):
    """Join points by links of up to `most` spacings of the denser end; `part` is the smallest point of each part."""
    for i in range(len(points)):
        part[i] = i
    for i in range(len(points)):
        for e in range(indptr[i], indptr[i + 1]):
            j = indices[e]
            if part[i] == part[j]:
                continue
            x, y, z = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
            reach = most * min(spacing[i], spacing[j])
            if x * x + y * y + z * z > reach * reach:
                continue
            join(part, i, j)
    for i in range(len(points)):
        part[i] = part[part[i]]  # one step is enough in this order: a smaller point leads to its root already
