"""Lengths along a closed loop of points."""

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_loop, check_points
from ..errors import InputError
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


def uniform_steps(points: ArrayLike, loop: ArrayLike) -> Floats:
    """Give every step from one boundary point to the next the same length.

    Examples
    --------
    >>> uniform_steps([[0, 0, 0], [9, 0, 0], [0, 1, 0], [1, 1, 1]], [0, 1, 2])
    array([1., 1., 1.])
    """
    return _steps(points, loop, 0.0)


def chord_length_steps(points: ArrayLike, loop: ArrayLike) -> Floats:
    """Give every step from one boundary point to the next its length in space.

    Examples
    --------
    >>> chord_length_steps([[0, 0, 0], [4, 0, 0], [4, 3, 0], [1, 1, 1]], [0, 1, 2])
    array([4., 3., 5.])
    """
    return _steps(points, loop, 1.0)


def centripetal_steps(points: ArrayLike, loop: ArrayLike) -> Floats:
    """Give every step from one boundary point to the next the root of its length in space (Lee 1989).

    Examples
    --------
    >>> centripetal_steps([[0, 0, 0], [4, 0, 0], [4, 9, 0], [1, 1, 1]], [0, 1, 2]).round(3)
    array([2.   , 3.   , 3.138])
    """
    return _steps(points, loop, 0.5)


def _steps(points: ArrayLike, loop: ArrayLike, power: float) -> Floats:
    cloud = np.asarray(points, dtype=np.float64)
    rim = check_loop(loop, len(cloud))
    check_points(cloud[rim], least=3)  # of the others nothing is asked
    return np.asarray(step_lengths(cloud, rim) ** power)


def checked_steps(steps: ArrayLike) -> Floats:
    """Return step lengths as float64, or say what is wrong with them."""
    lengths = np.asarray(steps, dtype=np.float64)
    if lengths.ndim != 1 or len(lengths) < 3 or not np.all(lengths > 0.0):
        raise InputError(
            "steps along the boundary have to be positive, one for each of at least 3 points; "
            "points that repeat give steps of length 0"
        )
    return lengths
