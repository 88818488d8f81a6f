"""Surfaces that are not discs, which a reconstruction has to refuse."""

from math import pi

import numpy as np
from scipy.spatial import ConvexHull

from pointchart.errors import InputError
from pointchart.shapes.sampling import polar, ring_turns, sunflower
from pointchart.shapes.shape import Shape, grid_triangles


def annulus(n_around: int = 96, n_rings: int = 12, *, inner_radius: float = 0.5) -> Shape:
    """Make a flat ring of outer radius 1: a disc with a hole, Euler characteristic 0, two boundary loops.

    Parameters
    ----------
    n_around, n_rings : int
        At least 3 and 2.
    inner_radius : float
        Between 0 and 1.

    Returns
    -------
    Shape
        Planar; `uv` is (x, y).

    Raises
    ------
    InputError
        When an option is out of range.

    Examples
    --------
    >>> [len(loop) for loop in annulus(20, 4).loops]
    [20, 20]
    """
    _check_grid("an annulus", n_around, n_rings)
    if not 0 < inner_radius < 1:
        raise InputError(f"an inner radius of {inner_radius} leaves no ring; take one between 0 and 1")
    radius, turn = np.meshgrid(np.linspace(inner_radius, 1, n_rings), ring_turns(n_around))
    uv = polar(radius.ravel(), turn.ravel())
    index = np.pad(np.arange(n_around * n_rings).reshape(n_around, n_rings), ((0, 1), (0, 0)), mode="wrap")
    return Shape(np.c_[uv, np.zeros(len(uv))], grid_triangles(index), uv)


def moebius(n_around: int = 96, n_across: int = 9, *, width: float = 0.6) -> Shape:
    """Make a Moebius strip around the unit circle: one side, one boundary loop, Euler characteristic 0.

    Parameters
    ----------
    n_around, n_across : int
        At least 3 and 2.
    width : float
        Between 0 and 2.

    Returns
    -------
    Shape
        The triangles disagree on the outside across one seam, as they must; `uv` is (turn, place across).

    Raises
    ------
    InputError
        When an option is out of range.

    Examples
    --------
    >>> [len(loop) for loop in moebius(20, 4).loops]
    [40]
    """
    _check_grid("a Moebius strip", n_around, n_across)
    if not 0 < width < 2:
        raise InputError(f"a width of {width} gives no strip around the unit circle; take one between 0 and 2")
    across, turn = np.meshgrid(np.linspace(-width / 2, width / 2, n_across), ring_turns(n_around))
    radius = 1 + across * np.cos(turn / 2)
    points = np.c_[polar(radius.ravel(), turn.ravel()), (across * np.sin(turn / 2)).ravel()]
    index = np.arange(n_around * n_across).reshape(n_around, n_across)
    return Shape(points, grid_triangles(np.r_[index, index[:1, ::-1]]), np.c_[turn.ravel(), across.ravel()])


def sphere(n: int) -> Shape:
    """Cover the unit sphere evenly: closed, Euler characteristic 2.

    Parameters
    ----------
    n : int
        Points in all, at least 8.

    Returns
    -------
    Shape
        `uv` is (longitude, z).

    Raises
    ------
    InputError
        With fewer than 8 points.

    Examples
    --------
    >>> ball = sphere(100)
    >>> len(ball.triangles), len(ball.boundary)
    (196, 0)
    """
    if n < 8:
        raise InputError(f"{n} points are too few for a sphere; take at least 8")
    share, turn = sunflower(n)
    z = 1 - 2 * share
    points = np.c_[polar(np.sqrt(1 - z**2), turn), z]
    triangles = ConvexHull(points).simplices.astype(np.int64)
    is_inward = np.linalg.det(points[triangles]) < 0
    triangles[is_inward] = triangles[is_inward, ::-1]
    return Shape(points, triangles, np.c_[turn % (2 * pi), z])


def torus(n_around: int = 96, n_across: int = 32, *, tube_radius: float = 0.35) -> Shape:
    """Make a torus around the unit circle: closed, one handle, Euler characteristic 0.

    Parameters
    ----------
    n_around, n_across : int
        At least 3 each.
    tube_radius : float
        Between 0 and 1.

    Returns
    -------
    Shape
        The axis is z; `uv` are the two turns.

    Raises
    ------
    InputError
        When an option is out of range.

    Examples
    --------
    >>> len(torus(20, 10).triangles)
    400
    """
    _check_grid("a torus", n_around, n_across, least=3)
    if not 0 < tube_radius < 1:
        raise InputError(f"a tube of radius {tube_radius} does not fit the unit circle; take one between 0 and 1")
    u, v = np.meshgrid(ring_turns(n_around), ring_turns(n_across))
    points = np.c_[polar((1 + tube_radius * np.cos(v)).ravel(), u.ravel()), tube_radius * np.sin(v).ravel()]
    index = np.pad(np.arange(n_around * n_across).reshape(n_across, n_around), (0, 1), mode="wrap")
    return Shape(points, grid_triangles(index), np.c_[u.ravel(), v.ravel()])


def _check_grid(name: str, n_around: int, n_across: int, *, least: int = 2) -> None:
    if n_around < 3 or n_across < least:
        raise InputError(
            f"{n_around} by {n_across} points, around and across, are too few for {name}; take at least 3 by {least}"
        )
