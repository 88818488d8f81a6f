"""Flat, rolled, folded, bumpy and necked sheets."""

from math import pi, sqrt

import numpy as np

from pointchart.errors import InputError
from pointchart.shapes.bend import raise_bumps, roll
from pointchart.shapes.planar import delaunay, ragged_delaunay
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
    >>> len(bent_sheet(180, nx=11, ny=5).points)
    55
    """
    return roll(grid(nx, ny), angle)


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
    return raise_bumps(disc(n, seed=seed), height=height, n_bumps=n_bumps, seed=seed)


def dumbbell(n: int, *, neck: float = 8.0) -> Shape:
    """Join two round lobes by a narrow neck, in the unit disc.

    Parameters
    ----------
    n : int
        About the points in the lobes; at least 100.
    neck : float
        Width of the neck in spacings, at least 2.

    Returns
    -------
    Shape
        Planar; the lobes touch the unit circle at the left and at the right.

    Raises
    ------
    InputError
        With fewer points, or a neck narrower than 2 spacings or wider than 0.6.

    Examples
    --------
    >>> flat = dumbbell(1000)
    >>> bool(abs(flat.points[:, 0]).max() > 0.95), bool(abs(flat.points[abs(flat.points[:, 0]) < 0.1, 1]).max() < 0.2)
    (True, True)
    """
    # Each point of the hexagonal packing takes sqrt(3) / 2 squared spacings.
    spacing = sqrt(2 * pi * 0.4**2 / (n * sqrt(3) / 2))
    if n < 100:
        raise InputError(f"a dumbbell of {n} points is too coarse; take at least 100")
    if not neck >= 2.0 or neck * spacing > 0.6:
        raise InputError(
            f"a neck of {neck} spacings is {neck * spacing:.2f} wide; take at least 2 spacings, and at most 0.6, three "
            "quarters of a lobe"
        )
    share, turn = sunflower(round(pi / (sqrt(3) / 2 * spacing**2)))
    uv = polar(np.sqrt(share), turn)
    in_lobe = np.hypot(np.abs(uv[:, 0]) - 0.6, uv[:, 1]) <= 0.4
    in_neck = (np.abs(uv[:, 0]) <= 0.6) & (np.abs(uv[:, 1]) <= neck * spacing / 2)
    uv = uv[in_lobe | in_neck]
    return Shape(np.c_[uv, np.zeros(len(uv))], ragged_delaunay(uv), uv)
