"""Lengths along a closed loop of points."""

import numpy as np

from ..typing import Floats, Loop, Points


def step_lengths(points: Points, loop: Loop) -> Floats:
    """Return the length of every step from one point of a closed loop to the next, (b,), in the unit of the points.

    Examples
    --------
    >>> step_lengths(np.array([[0.0, 0, 0], [3, 0, 0], [3, 4, 0]]), np.array([0, 1, 2]))
    array([3., 4., 5.])
    """
    return np.asarray(np.linalg.norm(points[np.roll(loop, -1)] - points[loop], axis=1))


def perimeter(points: Points, loop: Loop) -> float:
    """Return the length of a closed loop, in the unit of the points.

    Examples
    --------
    >>> perimeter(np.array([[0.0, 0, 0], [3, 0, 0], [3, 4, 0]]), np.array([0, 1, 2]))
    12.0
    """
    return float(step_lengths(points, loop).sum())
