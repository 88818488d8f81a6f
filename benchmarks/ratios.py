"""Ratios of what was measured by turns in one run: the speed of a machine changes, ratios hardly do."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

REPEATS = 5


def ratio(ours: ArrayLike, theirs: ArrayLike) -> str:
    """Return the ratio of medians, and the least and the greatest ratio of two measures of the same turn."""
    turns = np.array(ours) / np.array(theirs)
    return f"{np.median(ours) / np.median(theirs):.2f} ({turns.min():.2f} to {turns.max():.2f})"


def exponent(sizes: Sequence[int], seconds: Sequence[float]) -> str:
    """Return the slope of log time over log size, or nothing where there is one size only or no time."""
    if len(sizes) < 2 or min(seconds) <= 0.0:
        return ""
    return f"{np.polyfit(np.log(sizes), np.log(seconds), 1)[0]:.2f}"
