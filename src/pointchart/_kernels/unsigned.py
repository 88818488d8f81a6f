"""Integers that kernels need not ask for their sign."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

# Of the same width, so that a view will do.
UNSIGNED: dict[Any, Any] = {np.dtype(np.int32): np.uint32, np.dtype(np.int64): np.uint64}


def unsigned(indices: NDArray[Any]) -> NDArray[Any]:
    """View integers, none of them negative, as unsigned; those that are so already stay.

    A signed index may count from the end of an array, so a kernel asks for the sign of each, which takes up to a third
    of the time of a loop over the entries of sparse rows.

    >>> unsigned(np.array([3, 4])).dtype
    dtype('uint64')
    """
    return indices.view(UNSIGNED.get(indices.dtype, indices.dtype))
