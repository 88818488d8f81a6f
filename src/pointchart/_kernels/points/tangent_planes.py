"""Least-squares planes of local point sets, in closed form."""

import math

from numba import njit


@njit(cache=True, nogil=True, inline="always")
def smallest_eigenvector(xx, xy, xz, yy, yz, zz):
    """Return the unit eigenvector of the smallest eigenvalue of a symmetric 3 x 3 matrix.

    The eigenvalue is the trigonometric root of the characteristic cubic; the vector is the longest cross product of
    two rows of the shifted matrix. A multiple of the identity has no such direction and gives the z axis.
    """
    mean = (xx + yy + zz) / 3.0
    a, b, c = xx - mean, yy - mean, zz - mean
    spread = math.sqrt((a * a + b * b + c * c + 2.0 * (xy * xy + xz * xz + yz * yz)) / 6.0)
    if spread <= 0.0:
        return 0.0, 0.0, 1.0
    half_det = (a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)) / (2.0 * spread**3)
    angle = math.acos(min(1.0, max(-1.0, half_det))) / 3.0
    smallest = mean + 2.0 * spread * math.cos(angle + 2.0943951023931953)  # 2 pi / 3 on: the least of the three roots
    a, b, c = xx - smallest, yy - smallest, zz - smallest
    # The vector is orthogonal to all rows; of two that are nearly parallel, the product is mostly rounding.
    best, nx, ny, nz = -1.0, 0.0, 0.0, 1.0
    for k in range(3):
        if k == 0:
            x, y, z = xy * yz - xz * b, xz * xy - a * yz, a * b - xy * xy
        elif k == 1:
            x, y, z = xy * c - xz * yz, xz * xz - a * c, a * yz - xy * xz
        else:
            x, y, z = b * c - yz * yz, yz * xz - xy * c, xy * yz - b * xz
        square = x * x + y * y + z * z
        if square > best:
            best, nx, ny, nz = square, x, y, z
    if best <= 0.0:
        return 0.0, 0.0, 1.0
    length = math.sqrt(best)
    return nx / length, ny / length, nz / length


@njit(cache=True, nogil=True, inline="always")
def tangent_frame(nx, ny, nz):
    """Return two unit vectors that complete a unit normal to a right-handed frame (Duff et al. 2017)."""
    sign = math.copysign(1.0, nz)  # keeps the sum below from 0, also for a normal that points straight down
    a = -1.0 / (sign + nz)
    b = nx * ny * a
    return 1.0 + sign * nx * nx * a, sign * b, -sign * nx, b, sign + ny * ny * a, -ny


@njit(cache=True, nogil=True)
def fit_planes(points, indptr, indices, fading, first, last, normals, offsets):
    """Write the least-squares planes of points first..last and their neighbours.

    A neighbour at distance d has the weight (1 - fading d^2 / R^2)^2, where R is that of the farthest: without fading
    all count alike. The plane of point i has the normal `normals[i]` and passes `offsets[i]` above the point.
    """
    for i in range(first, last):
        farthest = 0.0
        for j in indices[indptr[i] : indptr[i + 1]]:
            x, y, z = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
            farthest = max(farthest, x * x + y * y + z * z)
        rate = fading / farthest if farthest > 0.0 else 0.0
        # The point itself is the origin and has weight 1, so it adds to n alone.
        n, mx, my, mz, xx, xy, xz, yy, yz, zz = 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for j in indices[indptr[i] : indptr[i + 1]]:
            x, y, z = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
            w = (1.0 - rate * (x * x + y * y + z * z)) ** 2
            n, mx, my, mz = n + w, mx + w * x, my + w * y, mz + w * z
            xx, xy, xz = xx + w * x * x, xy + w * x * y, xz + w * x * z
            yy, yz, zz = yy + w * y * y, yz + w * y * z, zz + w * z * z
        xx, xy, xz = xx - mx * mx / n, xy - mx * my / n, xz - mx * mz / n
        yy, yz, zz = yy - my * my / n, yz - my * mz / n, zz - mz * mz / n
        scale = xx + yy + zz
        if scale > 0.0:  # to trace 1, lest third powers underflow
            xx, xy, xz, yy, yz, zz = xx / scale, xy / scale, xz / scale, yy / scale, yz / scale, zz / scale
        nx, ny, nz = smallest_eigenvector(xx, xy, xz, yy, yz, zz)
        normals[i, 0], normals[i, 1], normals[i, 2] = nx, ny, nz
        offsets[i] = (mx * nx + my * ny + mz * nz) / n
