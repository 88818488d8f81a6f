"""Planar shapes bent into space."""

from math import pi, radians

import numpy as np

from pointchart.errors import InputError
from pointchart.shapes.sampling import polar
from pointchart.shapes.shape import Shape


def roll(shape: Shape, angle: float) -> Shape:
    """Roll a planar shape around a cylinder, without stretching it.

    Parameters
    ----------
    shape : Shape
        In the plane z = 0; it is rolled along x.
    angle : float
        Of the roll in degrees, more than 0 and less than 360; beyond 180 the sheet is no height field.

    Returns
    -------
    Shape
        The axis is y, the outside of the roll was above; the same triangles and parameters.

    Raises
    ------
    InputError
        When the angle is out of range.

    Examples
    --------
    >>> import numpy as np
    >>> from pointchart.shapes import grid
    >>> half = roll(grid(11, 5), 180)
    >>> bool(np.allclose(np.hypot(half.points[:, 0], half.points[:, 2]), 10 / np.pi))
    True
    """
    if not 0 < angle < 360:
        raise InputError(f"a roll of {angle} degrees is flat or meets itself; take more than 0 and less than 360")
    along = shape.points[:, 0]
    radius = np.ptp(along) / radians(angle)
    turn = (along - (along.min() + along.max()) / 2) / radius
    points = np.c_[radius * np.sin(turn), shape.points[:, 1], radius * np.cos(turn)]
    return Shape(points, shape.triangles, shape.uv)


def raise_bumps(shape: Shape, *, height: float = 0.3, n_bumps: int = 8, seed: int = 0) -> Shape:
    """Raise smooth bumps and dents over a shape in the unit disc of the plane.

    Parameters
    ----------
    shape : Shape
        In the plane z = 0.
    height : float
        Largest height of a bump, in radii of the disc.
    n_bumps : int
        Gaussian bumps and dents, at random places.
    seed : int
        Of the places.

    Returns
    -------
    Shape
        A height field; the same triangles and parameters.

    Examples
    --------
    >>> from pointchart.shapes import disc
    >>> float(abs(raise_bumps(disc(100), height=0).points[:, 2]).max())
    0.0
    """
    rng = np.random.default_rng(seed)
    center = polar(0.8 * np.sqrt(rng.random(n_bumps)), 2 * pi * rng.random(n_bumps))
    width, rise = rng.uniform(0.15, 0.35, n_bumps), height * rng.uniform(-1, 1, n_bumps)
    plane, z = shape.points[:, :2], np.zeros(len(shape.points))
    for c, w, h in zip(center, width, rise, strict=True):
        z += h * np.exp(-np.sum((plane - c) ** 2, axis=1) / w**2)
    return Shape(np.c_[plane, z], shape.triangles, shape.uv)
