"""Products and areas in the plane, by floating point."""

from numba import njit


@njit(cache=True, nogil=True, inline="always")
def cross(ax, ay, bx, by):
    """Return the cross product of two vectors, which is positive if the second lies left of the first."""
    return ax * by - ay * bx


@njit(cache=True, nogil=True, inline="always")
def doubled_area(uv, a, b, x, y):
    """Return twice the signed area of the triangle of points a and b and the place (x, y)."""
    return cross(uv[b, 0] - uv[a, 0], uv[b, 1] - uv[a, 1], x - uv[a, 0], y - uv[a, 1])
