"""Caps of the sphere and capped tubes: discs that no plane can show."""

from math import cos, pi, radians, sin, sqrt

import numpy as np

from pointchart.errors import InputError
from pointchart.shapes.planar import delaunay
from pointchart.shapes.sampling import polar, ring_turns, split_rim, sunflower
from pointchart.shapes.shape import Shape
from pointchart.typing import Triangles


def hemisphere(n: int, *, angle: float = 90.0) -> Shape:
    """Cover a cap of the unit sphere evenly, with a ring of points on its rim.

    Parameters
    ----------
    n : int
        Points in all, at least 8.
    angle : float
        Polar angle of the rim in degrees, 10 to 170; beyond 90 the cap is no height field.

    Returns
    -------
    Shape
        The pole is (0, 0, 1); `uv` is the stereographic projection from the opposite pole, so it is conformal.

    Raises
    ------
    InputError
        When the angle is out of range.

    Examples
    --------
    >>> cap = hemisphere(200)
    >>> bool((cap.points[:, 2] > -1e-12).all())
    True
    """
    if not 10 <= angle <= 170:
        raise InputError(f"a cap of polar angle {angle} degrees is too close to a point or a sphere; take 10 to 170")
    rim = radians(angle)
    n_rim, spacing = split_rim(n, area=2 * pi * (1 - cos(rim)), perimeter=2 * pi * sin(rim))
    return _cap(n - n_rim, n_rim, rim, spacing)


def tube(length_over_radius: float, *, n_around: int = 32) -> Shape:
    """Make a tube of radius 1 that a hemisphere closes at the top and that is open below.

    A protrusion like a finger: a harmonic map shrinks its end by exp(-length/radius).

    Parameters
    ----------
    length_over_radius : float
        Length of the cylinder, without the hemisphere; more than 0, and at most 300 for the sake of `uv`.
    n_around : int
        Points around, at least 8; rings are staggered, so the triangles are nearly equilateral.

    Returns
    -------
    Shape
        The axis is z, the rim lies at z = 0, and the top at about z = length + 1; `uv` is the conformal map, with the
        top near the origin and the radius exp(depth) along the cylinder.

    Raises
    ------
    InputError
        When the length or the number of points is out of range.

    Examples
    --------
    >>> finger = tube(5, n_around=20)
    >>> len(finger.boundary), float(finger.points[finger.boundary, 2].max())
    (20, 0.0)
    """
    if not 0 < length_over_radius <= 300:
        raise InputError(f"a tube of length {length_over_radius} radii is out of range; take more than 0, at most 300")
    if n_around < 8:
        raise InputError(f"{n_around} points around are too few to be a tube; take at least 8")
    spacing = 2 * pi / n_around
    cap = _cap(round(2 * pi / (sqrt(3) / 2 * spacing**2) - n_around / 2), n_around, pi / 2, spacing)
    n_rings = max(1, round(length_over_radius / (sqrt(3) / 2 * spacing)))
    depth = np.repeat(np.arange(1, n_rings + 1) * (length_over_radius / n_rings), n_around)
    ring, place = np.divmod(np.arange(n_rings * n_around), n_around)
    turn = 2 * pi * (place + (ring + 1) % 2 / 2) / n_around
    cylinder = np.c_[polar(np.ones(len(turn)), turn), length_over_radius - depth]
    return Shape(
        np.r_[cap.points + np.array([0, 0, length_over_radius]), cylinder],
        np.r_[cap.triangles, _staggered(n_rings, n_around) + len(cap.points) - n_around],
        np.r_[cap.uv, polar(np.exp(depth), turn)],
    )


def _cap(n_inner: int, n_rim: int, rim: float, spacing: float) -> Shape:
    # Two thirds of a row of triangles stay free between the area of the sunflower and the rim.
    share, turn = sunflower(n_inner)
    height = np.r_[1 - (1 - cos(rim - spacing / sqrt(3))) * share, np.full(n_rim, cos(rim))]
    turn = np.r_[turn, ring_turns(n_rim)]
    uv = polar(np.sqrt((1 - height) / (1 + height)), turn)
    return Shape(np.c_[polar(np.sqrt(1 - height**2), turn), height], delaunay(uv), uv)


def _staggered(n_rings: int, n_around: int) -> Triangles:
    """Join each ring to the next, the even ones being half a place behind."""
    ring, place = np.divmod(np.arange(n_rings * n_around), n_around)
    start, is_even = ring * n_around, ring % 2 == 0
    ahead = (place + 1) % n_around
    a, b = start + place, start + ahead
    c, d = start + n_around + place, start + n_around + ahead
    first = np.stack([a, np.where(is_even, c, d), b], axis=1)
    second = np.stack([np.where(is_even, b, a), c, d], axis=1)
    triangles: Triangles = np.r_[first, second].astype(np.int64)
    return triangles
