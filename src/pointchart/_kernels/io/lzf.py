"""LZF, the compression of PCD files: runs of bytes as they are, and copies of what stands up to 8 kB before.

The format is that of M. Lehmann's LibLZF, which PCL uses.
"""

from numba import njit


@njit(cache=True, nogil=True)
def unpack(packed, plain):
    """Unpack bytes into `plain`; return whether they fill it to the last byte and refer to nothing outside."""
    at, end = 0, 0
    while at < len(packed):
        control = int(packed[at])
        at += 1
        if control < 32:
            length = control + 1
            if at + length > len(packed) or end + length > len(plain):
                return False
            for i in range(length):
                plain[end + i] = packed[at + i]
            at += length
        else:
            length = control >> 5
            if length == 7:
                if at >= len(packed):
                    return False
                length += int(packed[at])
                at += 1
            if at >= len(packed):
                return False
            start = end - ((control & 31) << 8) - int(packed[at]) - 1
            at += 1
            length += 2
            if start < 0 or end + length > len(plain):
                return False
            for i in range(length):  # one by one: a copy may overlap itself
                plain[end + i] = plain[start + i]
        end += length
    return end == len(plain)
