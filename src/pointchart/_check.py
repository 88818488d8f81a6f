"""The checks at the door: every public function calls these and trusts its data afterwards."""

from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from .errors import InputError, name_some
from .typing import UV, Floats, Indices, Loop, Points, Triangles

Kind = TypeVar("Kind")

SAMPLE = 64  # points looked at first: if they span a plane, so do all


def check_points(points: ArrayLike, least: int = 4) -> Points:
    """Return points as a contiguous (n, 3) float64 array, or say what is wrong with them.

    Raises
    ------
    InputError
        On a wrong shape, fewer than `least` points, NaN or infinity, or points that all lie on one line.
    """
    try:
        array = np.ascontiguousarray(points, dtype=np.float64)
    except (TypeError, ValueError) as reason:
        raise InputError(f"points are no array of numbers ({reason}); give x, y, z for each") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"points have shape {array.shape}; (n, 3) is needed: one row of x, y, z for each point")
    if len(array) < least:
        raise InputError(f"the scan has {len(array)} points; a surface patch needs at least {least}")
    with np.errstate(invalid="ignore", over="ignore"):
        total = array.sum()  # one pass for the usual case: a sum of finite numbers of sane size is finite
    if not np.isfinite(total):
        broken = np.flatnonzero(~np.isfinite(array).all(axis=1))
        if len(broken):
            raise InputError(
                f"{len(broken)} points are NaN or infinite, the first at index {broken[0]}; remove them from the scan"
            )
    if _is_on_line(array[:: max(1, len(array) // SAMPLE)]) and _is_on_line(array):
        if (array == array[0]).all():
            raise InputError(f"all {len(array)} points are the same; a surface patch needs points that differ")
        raise InputError(f"all {len(array)} points lie on one line, which bounds no surface; check the columns read")
    return array


def _is_on_line(points: Points) -> bool:
    centred = points - points[0]
    extent = np.abs(centred).max()
    if extent == 0.0:
        return True
    centred /= extent
    farthest = centred[np.argmax(np.einsum("ij,ij->i", centred, centred))]
    return bool(np.abs(np.cross(centred, farthest)).max() <= 1e-12)


def check_loop(loop: ArrayLike, n_points: int) -> Loop:
    """Return a boundary loop as (b,) int64 with a repeated closing entry dropped, or say what is wrong with it.

    Raises
    ------
    InputError
        On entries that are no whole numbers, out of range or repeated, or fewer than 3 of them.
    """
    given = np.asarray(loop)
    if given.ndim != 1 or not np.issubdtype(given.dtype, np.integer):
        raise InputError(
            f"the boundary has shape {given.shape} and type {given.dtype}; a list of point indices is needed"
        )
    array = np.ascontiguousarray(given, dtype=np.int64)
    if len(array) > 1 and array[0] == array[-1]:
        array = array[:-1]
    outside = np.flatnonzero((array < 0) | (array >= n_points))
    if len(outside):
        raise InputError(
            f"{len(outside)} boundary entries name no point, the first is {array[outside[0]]} at position "
            f"{outside[0]}; "
            f"indices run from 0 to {n_points - 1}"
        )
    if len(array) < 3:
        raise InputError(f"the boundary has {len(array)} points; a loop needs at least 3")
    names, counts = np.unique(array, return_counts=True)
    repeated = names[counts > 1]
    if len(repeated):
        raise InputError(
            "boundary points {repeated} are named more than once, but a loop passes each once; drop the repetitions",
            repeated=repeated,
        )
    return array


def check_place(place: ArrayLike, name: str = "place") -> Floats:
    """Return a place or a direction in space as (3,) float64, or say what is wrong with it.

    Raises
    ------
    InputError
        On a wrong shape, NaN or infinity.
    """
    array = np.asarray(place, dtype=np.float64)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise InputError(f"the {name} is {array.tolist()}; three finite numbers x, y, z are needed")
    return array


def check_uv(uv: ArrayLike, n_points: int) -> UV:
    """Return parameters as a contiguous (n, 2) float64 array.

    Raises
    ------
    InputError
        On a wrong shape, a wrong number, or NaN and infinity.
    """
    try:
        array = np.ascontiguousarray(uv, dtype=np.float64)
    except (TypeError, ValueError) as reason:
        raise InputError(f"parameters are no array of numbers ({reason}); give u, v for each point") from None
    if array.shape != (n_points, 2):
        raise InputError(f"parameters have shape {array.shape}; ({n_points}, 2) is needed: u, v for each point")
    if not np.isfinite(array).all():
        broken = np.flatnonzero(~np.isfinite(array).all(axis=1))
        raise InputError(f"the parameters of {len(broken)} points are NaN or infinite, the first of point {broken[0]}")
    return array


def check_weights(weights: ArrayLike, n_points: int) -> Floats:
    """Return weights as an (n,) float64 array.

    Raises
    ------
    InputError
        On a wrong number, or weights that are not positive and finite.
    """
    array = np.ascontiguousarray(weights, dtype=np.float64)
    if array.shape != (n_points,):
        raise InputError(f"weights have shape {array.shape}; ({n_points},) is needed: one for each point")
    wrong = np.flatnonzero(~((array > 0.0) & (array < np.inf)))
    if len(wrong):
        raise InputError(
            f"{len(wrong)} weights are not positive and finite, the first {array[wrong[0]]:g} at index {wrong[0]}"
        )
    return array


def check_triangles(triangles: ArrayLike, n_points: int) -> Triangles:
    """Return triangles as (m, 3) int32 if they are, else as int64, or say what is wrong with them.

    Raises
    ------
    InputError
        On a wrong shape or type, indices out of range, or a point named twice in one triangle.
    """
    given = np.asarray(triangles)
    if given.size == 0:
        return np.empty((0, 3), np.int64)
    if given.ndim != 2 or given.shape[1] != 3 or not np.issubdtype(given.dtype, np.integer):
        raise InputError(f"triangles have shape {given.shape} and type {given.dtype}; (m, 3) whole numbers are needed")
    faces = given if given.dtype == np.int32 else np.ascontiguousarray(given, dtype=np.int64)
    if faces.min() < 0 or faces.max() >= n_points:
        wrong = np.flatnonzero(((faces < 0) | (faces >= n_points)).any(axis=1))
        raise InputError(
            f"triangles {name_some(wrong)} name points that are not there; indices run from 0 to {n_points - 1}"
        )
    a, b, c = faces.T
    doubled = np.flatnonzero((a == b) | (b == c) | (c == a))
    if len(doubled):
        raise InputError(f"triangles {name_some(doubled)} name a point twice; remove them")
    return faces


def check_neighbors(indices: Indices, n_rows: int, n_points: int) -> None:
    """Check that neighbourhoods belong to the points.

    Raises
    ------
    InputError
        If there are more or fewer of them than points, or they name points that are not there.
    """
    if n_rows != n_points:
        raise InputError(f"the neighbourhoods are those of {n_rows} points, not of {n_points}")
    if len(indices) and (indices.min() < 0 or indices.max() >= n_points):
        raise InputError(
            f"the neighbourhoods name points from {indices.min()} to {indices.max()}; they run from 0 to {n_points - 1}"
        )


def check_kind(neighborhoods: object, kind: type[Kind], sentence: str) -> Kind:
    """Return neighbourhoods if they are of a kind, such as ordered ones, or say what needs them.

    Raises
    ------
    InputError
    """
    if not isinstance(neighborhoods, kind):
        raise InputError(sentence)
    return neighborhoods
