"""From where a scan is looked at, by one rule in figures, on pages and in the browser; triangles tell it more."""

from typing import TypedDict

import numpy as np

from ..errors import InputError
from ..mesh.connectivity import half_edges
from ..mesh.quality import area_vectors
from ..typing import Floats, Points, Triangles

AXES = {"x": 0, "y": 1, "z": 2}  # of the file, that may be upwards; in the order in which they are offered
ASIDE, ABOVE = -10.0, 25.0  # degrees out of the view along the mean normal, so that relief shows
FACING = 0.8  # cosine to the line of sight from which on an axis cannot be upwards in the figure
CLOSING = 0.35  # share of the area of a mesh that its boundary spans, below which it stands like a bust or a foot
OPEN = 0.01  # the same below which what its boundary spans says nothing, as of a tube
ONE_SIDED = 0.05  # share of the area of a mesh that has to face one way to tell its outside
BULGING = 0.15  # correlation of height and squared distance from the middle that tells the outside of a cloud


class Standpoint(TypedDict, total=False):
    """From where a figure is looked at, as for `camera`."""

    view: tuple[float, float] | None
    up: str | None


def camera(
    points: Points,
    triangles: Triangles | None = None,
    *,
    view: tuple[float, float] | None = None,
    up: str | None = None,
) -> Floats:
    """Choose the directions that are to the right, upwards and towards us in a figure.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array, optional
        They tell the outside; otherwise it is where the cloud bulges to, and the front of flat ones.
    view : (float, float), optional
        By how many degrees we walk around the scan, anticlockwise seen from above, and look down on it. (0, 0) looks
        along y where z is upwards, against z where y is. By default we look at the outside of the mean plane, and at
        the broad side of a mesh that closes but for a smaller opening; turned and tilted a little.
    up : str, optional
        The axis of the file that is upwards, "x", "y" or "z"; by default that of `upward`.

    Returns
    -------
    (3, 3) float64 array, its rows are unit vectors.

    Raises
    ------
    InputError
        If there is no such axis, or the angles are not finite.

    Examples
    --------
    >>> flat = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    >>> camera(flat, view=(0, 90), up="z").round(9) + 0.0
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    if view is not None and not np.isfinite(view).all():
        raise InputError(f"the view is {view[0]:g}, {view[1]:g}; two finite angles in degrees are needed")
    name = upward(points, triangles) if up is None else up
    upright = upright_axes(name)
    if view is not None:
        return np.asarray(rotation(-view[0], view[1]) @ upright)
    if _opening(points, triangles) is not None:
        return np.asarray(oblique() @ _broad_side(points, upright))
    normal = _outside(points, triangles)
    # An axis that is asked for cannot be upwards where we look along it.
    above = np.eye(3)[AXES[name if abs(normal[AXES[name]]) <= FACING else upward(points, triangles)]]
    across = np.cross(above, normal) / np.linalg.norm(np.cross(above, normal))
    return np.asarray(oblique() @ np.stack([across, np.cross(normal, across), normal]))


def upward(points: Points, triangles: Triangles | None = None) -> str:
    """Choose the axis of the file that is upwards.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array, optional

    Returns
    -------
    "x", "y" or "z": of a mesh that closes but for a smaller opening the axis that the opening is seen along, of others
    z, or y where the mean plane faces along z.

    Examples
    --------
    >>> upward(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]))
    'y'
    """
    opening = _opening(points, triangles)
    if opening is not None:
        return list(AXES)[int(np.argmax(np.abs(opening)))]
    return _upward_facing(_outside(points, triangles))


def upright_axes(up: str) -> Floats:
    """Return the directions to the right, upwards and towards us if an axis of the file is upwards.

    Parameters
    ----------
    up : str

    Returns
    -------
    (3, 3) float64 array.

    Raises
    ------
    InputError
        If there is no such axis.

    Examples
    --------
    >>> upright_axes("z").tolist()
    [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]
    """
    if up not in AXES:
        raise InputError(f"the axis upwards is '{up}'; it has to be one of {', '.join(AXES)}")
    above = np.eye(3)[AXES[up]]
    right = np.eye(3)[1 if above[0] else 0]
    return np.stack([right, above, np.cross(right, above)])


def rotation(about_vertical: float, about_horizontal: float) -> Floats:
    """Return the matrix that turns a picture about its vertical axis, then about its horizontal one, in degrees."""
    a, b = np.deg2rad(about_vertical), np.deg2rad(about_horizontal)
    turn = np.array([[np.cos(a), 0.0, np.sin(a)], [0.0, 1.0, 0.0], [-np.sin(a), 0.0, np.cos(a)]])
    tilt = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(b), -np.sin(b)], [0.0, np.sin(b), np.cos(b)]])
    return np.asarray(tilt @ turn)


def oblique() -> Floats:
    """Return the matrix that turns the view along the mean normal a little aside and above."""
    return rotation(ASIDE, ABOVE)


def _opening(points: Points, triangles: Triangles | None) -> Floats | None:
    """Return the direction in which a mesh is open, if it closes but for that."""
    if triangles is None:
        return None
    vectors = area_vectors(points, triangles)
    total, area = vectors.sum(axis=0), float(np.linalg.norm(vectors, axis=1).sum())
    size = float(np.linalg.norm(total))
    # Triangles that are turned over cancel others out.
    if OPEN * area < size < CLOSING * area and half_edges(triangles, len(points)).n_overfull == 0:
        return np.asarray(total / size)
    return None


def _broad_side(points: Points, axes: Floats) -> Floats:
    """Turn axes about the one upwards until we look at the broad side, from the front as far as there is one."""
    right, above, towards = axes
    level = (points - points.mean(axis=0)) @ np.stack([towards, right]).T
    ahead, aside = np.linalg.eigh(level.T @ level)[1][:, 0]
    facing = (ahead * towards + aside * right) * (1.0 if ahead >= 0.0 else -1.0)
    return np.stack([np.cross(above, facing), above, facing])


def _outside(points: Points, triangles: Triangles | None) -> Floats:
    """Return the normal of the mean plane, on the outside."""
    centred = points - points.mean(axis=0)
    centred /= np.abs(centred).max() or 1.0
    normal = np.linalg.eigh(centred.T @ centred)[1][:, 0]
    if triangles is not None:
        vectors = area_vectors(points, triangles)
        facing = float(vectors.sum(axis=0) @ normal)
        if abs(facing) > ONE_SIDED * np.linalg.norm(vectors, axis=1).sum():
            return normal if facing > 0.0 else -normal
    height = centred @ normal
    off = (centred**2).sum(axis=1) - height**2
    spread = float(height.std() * off.std())
    bulge = -float(np.mean(height * (off - off.mean())))
    towards = upright_axes(_upward_facing(normal)) @ normal
    side = bulge if abs(bulge) > BULGING * spread else towards[np.argmax(np.abs(towards))]
    return normal if side > 0.0 else -normal


def _upward_facing(normal: Floats) -> str:
    return "y" if abs(normal[2]) > FACING else "z"
