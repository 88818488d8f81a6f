"""Parallel lines of light that a surface reflects: smooth where its curvature is continuous."""

import numpy as np
from numpy.typing import ArrayLike

from ..typing import Floats

STRIPES = np.array([0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 30.0])  # degrees, each a part of a full turn
SEEN = 18.0  # lines that a picture shows, about: some one or two dozen are told apart and miss no bend
OUTERMOST = 2.0  # per cent of the angles at either end, those of rims, which do not choose how far lines are apart


def reflection_angles(facing: Floats, eye: ArrayLike, lines: ArrayLike) -> Floats:
    r"""Return the angle, about the direction of lines of light, at which places of a surface reflect the view.

    The lines are parallel and far away, as is the eye; what it sees in a place of normal n comes from the direction

    .. math:: r = 2 (n \cdot e) n - e

    where e points towards the eye. The angle is 0 there and grows anticlockwise about the lines; places of one angle
    reflect the same line.

    Parameters
    ----------
    facing : (n, 3) array
        Unit normals.
    eye : (3,) array
        Direction towards the eye.
    lines : (3,) array
        Direction of the lines of light, another than that of the eye.

    Returns
    -------
    (n,) float64 array, from -pi to pi; nan where there is no normal.

    Examples
    --------
    >>> half_way = np.array([[0.0, -np.sqrt(0.5), np.sqrt(0.5)]])
    >>> np.rad2deg(reflection_angles(half_way, [0, 0, 1], [1, 0, 0])).round(9)
    array([90.])
    """
    towards, along = np.asarray(eye, np.float64), np.asarray(lines, np.float64)
    reflected = 2.0 * (facing @ towards)[:, None] * facing - towards
    across = np.cross(along, towards)
    return np.asarray(np.arctan2(reflected @ across, reflected @ np.cross(across, along)))


def least_turning(facing: Floats, eye: Floats) -> Floats:
    """Return the direction across the view in which normals vary least: lines of light along it are met most often."""
    sideways = np.nan_to_num(facing - np.outer(facing @ eye, eye))
    return np.asarray(np.linalg.eigh(np.cov(sideways, rowvar=False) + np.outer(eye, eye) * 4.0)[1][:, 0])


def line_spacing(angles: Floats) -> float:
    """Choose how far lines are apart, in degrees, so that one or two dozen are seen; of a plane it is the least.

    Parameters
    ----------
    angles : (n,) array
        As of `reflection_angles`; not-a-number does not count.

    Examples
    --------
    >>> line_spacing(np.deg2rad(np.linspace(-90.0, 90.0, 100))), line_spacing(np.zeros(9))
    (10.0, 0.1)
    """
    known = angles[np.isfinite(angles)]
    low, high = np.rad2deg(np.percentile(known, [OUTERMOST, 100.0 - OUTERMOST])) if len(known) else (0.0, 0.0)
    return float(STRIPES[np.argmin(np.abs(np.log(STRIPES) - np.log(max((high - low) / SEEN, 1e-3))))])
