"""Which links between neighbours can be trusted."""

from numba import njit


@njit(cache=True, nogil=True, inline="always")
def are_adjacent(indptr, indices, is_open, center, a, b):
    """Tell whether a and b follow each other, either way round, in the star of `center`."""
    begin, end = indptr[center], indptr[center + 1]
    for e in range(begin, end):
        if indices[e] == a:
            following = e + 1 if e + 1 < end else begin
            preceding = e - 1 if e > begin else end - 1
            if indices[following] == b and not (is_open[center] and following == begin):
                return True
            return indices[preceding] == b and not (is_open[center] and e == begin)
    return False


@njit(cache=True, nogil=True)
def agreement(indptr, indices, is_open, first, last, agrees):
    """Mark the links of stars first..last that are an edge of a triangle which at least two stars hold."""
    for i in range(first, last):
        begin, end = indptr[i], indptr[i + 1]
        for e in range(begin, end):
            following = e + 1 if e + 1 < end else begin
            if following == e or (is_open[i] and following == begin):
                continue
            j, k = indices[e], indices[following]
            if are_adjacent(indptr, indices, is_open, j, k, i) or are_adjacent(indptr, indices, is_open, k, i, j):
                agrees[e] = agrees[following] = True
