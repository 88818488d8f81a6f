"""Vectors in the plane."""

import numpy as np

from ..typing import UV, Floats


def cross(a: UV, b: UV) -> Floats:
    r"""Return the cross products of pairs of vectors, which are positive where the second lies left of the first.

    .. math:: a_1 b_2 - a_2 b_1

    Examples
    --------
    >>> cross(np.array([[1.0, 0.0], [2.0, 2.0]]), np.array([[0.0, 3.0], [1.0, 1.0]])).tolist()
    [3.0, 0.0]
    """
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
