"""Which way three places of the plane turn, exactly for all finite coordinates."""

import math

import numpy as np
from numba import njit

# Shewchuk 1997: a computed determinant has the right sign if it exceeds (3 + 16 eps) eps times the sum of its terms;
# terms below the second number may have lost digits to underflow.
FILTER = (3.0 + 16.0 * 2.0**-53) * 2.0**-53
SMALLEST_SAFE = 1e-280

# A product of two numbers is a whole multiple of 2**-2252 and less than 2**2048, and six are added up.
DIGIT, MASK = 32, (1 << 32) - 1
POINT = 72 * DIGIT  # bits behind the point
N_DIGITS = (POINT + 2048) // DIGIT + 3
HALF = 27  # bits of the lower half of a number's 53


@njit(cache=True, nogil=True, inline="always")
def sure_turn(ax, ay, bx, by, cx, cy):
    """Return the orientation of a, b, c: 1 anticlockwise, -1 clockwise, 0 where floating point is unsure."""
    left, right = (ax - cx) * (by - cy), (ay - cy) * (bx - cx)
    slack = FILTER * (abs(left) + abs(right)) + SMALLEST_SAFE
    return (left - right > slack) - (right - left > slack)


@njit(cache=True, nogil=True, inline="always")
def turn(ax, ay, bx, by, cx, cy):
    """Return the exact orientation of a, b, c: 1 anticlockwise, -1 clockwise, 0 on a line or not finite."""
    way = sure_turn(ax, ay, bx, by, cx, cy)
    return way if way != 0 else long_turn(ax, ay, bx, by, cx, cy)


@njit(cache=True, nogil=True)
def long_turn(ax, ay, bx, by, cx, cy):
    """Return the same without a filter, from a number long enough for all products (Kulisch and Miranker 1986)."""
    for x in (ax, ay, bx, by, cx, cy):
        if not math.isfinite(x):
            return 0
    digits = np.zeros(N_DIGITS, np.int64)
    add_product(digits, ax, by)
    add_product(digits, -ay, bx)
    add_product(digits, bx, cy)
    add_product(digits, -by, cx)
    add_product(digits, cx, ay)
    add_product(digits, -cy, ax)
    return sign_of(digits)


@njit(cache=True, nogil=True)
def add_product(digits, a, b):
    """Add ab to a long number whose digits of 32 bits, the lowest first, have not been carried."""
    (one, p), (other, q) = math.frexp(a), math.frexp(b)
    m, n, place = np.int64(one * 2.0**53), np.int64(other * 2.0**53), p + q - 106 + POINT
    sign = -1 if (m < 0) != (n < 0) else 1
    m, n = abs(m), abs(n)
    low, high, lower, higher = m & ((1 << HALF) - 1), m >> HALF, n & ((1 << HALF) - 1), n >> HALF
    add_part(digits, sign, low * lower, place)
    add_part(digits, sign, low * higher, place + HALF)
    add_part(digits, sign, high * lower, place + HALF)
    add_part(digits, sign, high * higher, place + 2 * HALF)


@njit(cache=True, nogil=True, inline="always")
def add_part(digits, sign, part, place):
    """Add or subtract a whole number under 2**54 at a place, in bits."""
    k, shift = place // DIGIT, place % DIGIT
    low, high = (part & MASK) << shift, (part >> DIGIT) << shift
    digits[k] += sign * (low & MASK)
    digits[k + 1] += sign * ((low >> DIGIT) + (high & MASK))
    digits[k + 2] += sign * (high >> DIGIT)


@njit(cache=True, nogil=True)
def sign_of(digits):
    """Return the sign of a long number, and carry its digits."""
    is_zero = True
    for k in range(len(digits) - 1):
        digits[k + 1] += digits[k] >> DIGIT
        digits[k] &= MASK
        is_zero &= digits[k] == 0
    # Digits but for the highest are not negative now.
    if digits[-1] < 0:
        return -1
    return 0 if is_zero and digits[-1] == 0 else 1


@njit(cache=True, nogil=True)
def measure_signs(uv, triangles, first, last, signs):
    """Write the exact signs of the areas of triangles first..last."""
    for t in range(first, last):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        signs[t] = sure_turn(uv[a, 0], uv[a, 1], uv[b, 0], uv[b, 1], uv[c, 0], uv[c, 1])
    # In a loop of its own, the rare call does not slow down what is sure.
    for t in range(first, last):
        if signs[t] == 0:
            a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
            signs[t] = long_turn(uv[a, 0], uv[a, 1], uv[b, 0], uv[b, 1], uv[c, 0], uv[c, 1])
