"""A hash of coordinates, by which ties are broken, and points shifted without rounding."""

import numpy as np
from numba import njit

ONE, MANTISSA, EXPONENT = np.uint64(1), np.uint64(52), np.uint64(0x7FF)  # of the bits of a double
ZERO = np.uint64(2**64 - 1)  # in place of the bits of 0: those of a scaled power of two may be 0
GOLDEN = np.uint64(0x9E3779B97F4A7C15)  # 2^64 over the golden ratio: the step of SplitMix64 from one number to the next
FIRST, SECOND = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)  # its multipliers
SHIFTS = np.uint64(30), np.uint64(27), np.uint64(31), np.uint64(11)


@njit(cache=True, nogil=True, inline="always")
def mixed(key, step):
    """Return the number of SplitMix64 that is `step` after the state `key` (Steele, Lea and Flood 2014)."""
    key = key + np.uint64(step) * GOLDEN
    key = (key ^ (key >> SHIFTS[0])) * FIRST
    key = (key ^ (key >> SHIFTS[1])) * SECOND
    return key ^ (key >> SHIFTS[2])


@njit(cache=True, nogil=True)
def hash_points(points, bits, first, last, keys):
    """Write the keys of points first..last, whose coordinates have these bits; zeros of either sign are alike."""
    for i in range(first, last):
        largest = np.uint64(0)
        for axis in range(3):
            largest = max(largest, bits[i, axis] >> MANTISSA & EXPONENT)
        key = np.uint64(0)
        for axis in range(3):
            number = ZERO if points[i, axis] == 0.0 else bits[i, axis] - (largest << MANTISSA)
            key = mixed(key + number, axis + 1)
        keys[i] = key


@njit(cache=True, nogil=True)
def move_points(points, spacing, keys, reach, first, last, moved):
    """Move points first..last by up to a share of the spacing, the ways that their keys say."""
    for i in range(first, last):
        for axis in range(3):
            # 53 bits make a number in [0, 2), less 1.
            way = (mixed(keys[i], axis + 1) >> SHIFTS[3]) * 2.0**-52 - 1.0
            moved[i, axis] = points[i, axis] + reach * spacing[i] * way


@njit(cache=True, nogil=True)
def shift_points(points, center, first, last, shifted, is_rounded):
    """Write points first..last less a center, and mark the axes on which that rounds a coordinate."""
    for i in range(first, last):
        for axis in range(3):
            given = points[i, axis]
            difference = given - center[axis]
            shifted[i, axis] = difference
            # The larger of two numbers, less their difference as rounded, is exact (Dekker 1971): one of these tells.
            if given - difference != center[axis] or difference + center[axis] != given:
                is_rounded[axis] = True
