"""Losses: how much a point that is far off counts in a fit."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ..typing import Floats

HUBER, MAD = 1.345, 1.4826  # 95 % efficiency for normal noise; its standard deviation over the median of |x|

Loss: TypeAlias = Callable[[Floats], Floats]


def squares(residuals: Floats) -> Floats:
    """Weigh all points the same: least squares."""
    return np.ones_like(residuals)


def huber(residuals: Floats) -> Floats:
    """Weigh points beyond 1.345 standard deviations by the inverse of their distance; the deviation is a robust one.

    Residuals are distances, so not negative.

    References
    ----------
    Huber 1964, Robust estimation of a location parameter.

    Examples
    --------
    >>> huber(np.array([1.0, 1.0, 1.0, 1.9940970000000001, 19.940970000000001])).round(6)
    array([1. , 1. , 1. , 1. , 0.1])
    """
    reach = HUBER * MAD * float(np.median(residuals))
    return np.minimum(1.0, reach / np.maximum(residuals, reach)) if reach > 0.0 else np.ones_like(residuals)
