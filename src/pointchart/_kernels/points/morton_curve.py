"""Keys along the Morton curve."""

from numba import njit


@njit(cache=True, nogil=True)
def morton_keys(points, low, scale, bits, first, last, keys):
    """Write the keys of points first..last: the bits of their cells, of each axis in turn."""
    dimensions = points.shape[1]
    for i in range(first, last):
        key = 0
        for axis in range(dimensions):
            cell = int((points[i, axis] - low[axis]) * scale)
            for bit in range(bits):
                key |= ((cell >> bit) & 1) << (dimensions * bit + axis)
        keys[i] = key
