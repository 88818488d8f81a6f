"""Floater's shape-preserving weights of one star."""

from numba import njit

from ..plane.areas import cross


@njit(cache=True, nogil=True)
def shape_preserving(local, indptr, is_open, first, last, weight):
    """Add up, for each closed star, the barycentric coordinates of the centre in one triangle for each neighbour.

    The triangle of neighbour j has its other corners at the ends of the edge that the ray from j through the centre
    meets. Open stars are left as they are.
    """
    for i in range(first, last):
        begin, end = indptr[i], indptr[i + 1]
        if is_open[i]:
            continue
        for j in range(begin, end):
            xj, yj = local[j, 0], local[j, 1]
            for k in range(begin, end):
                m = k + 1 if k + 1 < end else begin
                at_k = cross(-xj, -yj, local[k, 0], local[k, 1])
                at_m = cross(-xj, -yj, local[m, 0], local[m, 1])
                if at_k <= 0.0 and at_m > 0.0:
                    opposite = cross(local[k, 0], local[k, 1], local[m, 0], local[m, 1])
                    total = opposite + at_m - at_k
                    weight[j] += opposite / total
                    weight[k] += at_m / total
                    weight[m] += -at_k / total
                    break
