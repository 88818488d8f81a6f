"""Flat, rolled, folded and bumpy sheets, with answers in closed form."""

from math import pi, radians, sqrt

import numpy as np

from pointchart.errors import InputError
from pointchart.shapes.planar import delaunay
from pointchart.shapes.sampling import polar, ring_turns, split_rim, sunflower
from pointchart.shapes.shape import Shape, grid_triangles


def grid(nx: int, ny: int) -> Shape:
    """Make a planar grid of unit spacing in z = 0.

    Parameters
    ----------
    nx, ny : int
        Points along x and y, at least 2 each.

    Returns
    -------
    Shape
        Point j nx + i lies at (i, j, 0); `uv` is (i, j).

    Raises
    ------
    InputError
        With fewer than two points a side.

    Examples
    --------
    >>> grid(3, 2).boundary.tolist()
    [0, 1, 2, 5, 4, 3]
    """
    if min(nx, ny) < 2:
        raise InputError(f"a grid of {nx} by {ny} points has no triangle; take at least 2 by 2")
    index = np.arange(nx * ny).reshape(ny, nx)
    uv = np.stack([index % nx, index // nx], axis=-1).reshape(-1, 2).astype(np.float64)
    return Shape(np.c_[uv, np.zeros(nx * ny)], grid_triangles(index), uv)


def disc(n: int, *, jitter: float = 0.25, seed: int = 0) -> Shape:
    """Scatter points evenly but without a pattern over the unit disc, with a ring of points on its rim.

    Parameters
    ----------
    n : int
        Points in all, at least 8.
    jitter : float
        Largest displacement of an inner point from its place in a sunflower, in spacings; 0 to 0.3 keeps points apart.
    seed : int
        Of the displacements.

    Returns
    -------
    Shape
        Planar; the last points are the rim, of norm 1.

    Examples
    --------
    >>> flat = disc(100)
    >>> flat.points.shape, float(abs(flat.points[:, 2]).max())
    ((100, 3), 0.0)
    """
    n_rim, spacing = split_rim(n, area=pi, perimeter=2 * pi)
    share, turn = sunflower(n - n_rim)
    rng = np.random.default_rng(seed)
    inner = polar((1 - spacing / sqrt(3)) * np.sqrt(share), turn)
    inner += polar(jitter * spacing * np.sqrt(rng.random(len(inner))), 2 * pi * rng.random(len(inner)))
    uv = np.r_[inner, polar(1.0, ring_turns(n_rim))]
    return Shape(np.c_[uv, np.zeros(n)], delaunay(uv), uv)


def bent_sheet(angle: float, *, nx: int = 41, ny: int = 31) -> Shape:
    """Roll a grid of unit spacing around a cylinder.

    Parameters
    ----------
    angle : float
        Of the roll in degrees, more than 0 and less than 360; beyond 180 the sheet is no height field.
    nx, ny : int
        Points around and along the axis.

    Returns
    -------
    Shape
        The axis is y; the radius is (nx - 1) / angle in radians; `uv` is the arc length, so it is an isometry.

    Raises
    ------
    InputError
        When the angle is out of range.

    Examples
    --------
    >>> import numpy as np
    >>> half = bent_sheet(180, nx=11, ny=5)
    >>> bool(np.allclose(np.hypot(half.points[:, 0], half.points[:, 2]), 10 / np.pi))
    True
    """
    if not 0 < angle < 360:
        raise InputError(f"a roll of {angle} degrees is flat or meets itself; take more than 0 and less than 360")
    flat = grid(nx, ny)
    radius = (nx - 1) / radians(angle)
    turn = (flat.uv[:, 0] - (nx - 1) / 2) / radius
    points = np.c_[radius * np.sin(turn), flat.uv[:, 1], radius * np.cos(turn)]
    return Shape(points, flat.triangles, flat.uv)


def fold(gap: float, *, nx: int = 61, ny: int = 31) -> Shape:
    """Fold a grid of unit spacing into a hairpin: two parallel sheets joined by a half cylinder.

    Parameters
    ----------
    gap : float
        Distance of the sheets, in spacings, more than 0.
    nx, ny : int
        Points across the fold and along it.

    Returns
    -------
    Shape
        The fold is along y, the sheets lie in z = gap/2 and z = -gap/2 where x < 0; `uv` is the arc length.

    Raises
    ------
    InputError
        When the gap is not positive, or nothing is left of the sheets.

    Examples
    --------
    >>> sorted({float(z) for z in fold(2).points[:, 2] if abs(z) > 0.999999})
    [-1.0, 1.0]
    """
    straight = (nx - 1 - pi * gap / 2) / 2
    if gap <= 0 or straight <= 0:
        raise InputError(f"a gap of {gap} spacings does not fit a sheet of {nx} points; take one of 0 to {nx // 2}")
    flat = grid(nx, ny)
    along = flat.uv[:, 0] - (nx - 1) / 2
    turn = np.clip(along / (gap / 2), -pi / 2, pi / 2)
    beyond = np.maximum(np.abs(along) - pi * gap / 4, 0)
    points = np.c_[gap / 2 * np.cos(turn) - beyond, flat.uv[:, 1], -gap / 2 * np.sin(turn)]
    return Shape(points, flat.triangles, flat.uv)


def relief(n: int, *, height: float = 0.3, n_bumps: int = 8, seed: int = 0) -> Shape:
    """Raise smooth bumps over the unit disc: a height field.

    Parameters
    ----------
    n : int
        Points in all, at least 8.
    height : float
        Largest height of a bump, in radii of the disc.
    n_bumps : int
        Gaussian bumps and dents, at random places.
    seed : int
        Of the places and the points.

    Returns
    -------
    Shape
        `uv` is (x, y).

    Examples
    --------
    >>> float(abs(relief(100, height=0).points[:, 2]).max())
    0.0
    """
    flat = disc(n, seed=seed)
    rng = np.random.default_rng(seed)
    center = polar(0.8 * np.sqrt(rng.random(n_bumps)), 2 * pi * rng.random(n_bumps))
    width, rise = rng.uniform(0.15, 0.35, n_bumps), height * rng.uniform(-1, 1, n_bumps)
    z = np.zeros(n)
    for c, w, h in zip(center, width, rise, strict=True):
        z += h * np.exp(-np.sum((flat.uv - c) ** 2, axis=1) / w**2)
    return Shape(np.c_[flat.uv, z], flat.triangles, flat.uv)
