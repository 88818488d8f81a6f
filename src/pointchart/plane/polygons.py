"""Polygons in the plane, given by their corners in order; the last one is not the first one again."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from .._kernels.plane.segments import measure_inside
from .._parallel import over_ranges
from ..errors import InputError
from ..typing import UV, Floats, Loop, Mask
from .vectors import cross


def signed_area(polygon: UV) -> float:
    """Return the area of a polygon, positive if it runs anticlockwise.

    Examples
    --------
    >>> signed_area(np.array([[1.0, 1.0], [3.0, 1.0], [1.0, 2.0]]))
    1.0
    """
    a = polygon - polygon[0]
    return float(cross(a, np.roll(a, -1, axis=0)).sum() / 2.0)


def sides_at(corners: Floats) -> tuple[Floats, Floats]:
    """Return the side that ends and the side that begins at each corner of a polygon, in the plane or in space.

    Examples
    --------
    >>> behind, ahead = sides_at(np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]]))
    >>> behind.tolist(), ahead.tolist()
    ([[0.0, -1.0], [2.0, 0.0], [-2.0, 1.0]], [[2.0, 0.0], [-2.0, 1.0], [0.0, -1.0]])
    """
    ahead = np.roll(corners, -1, axis=0) - corners
    return np.roll(ahead, 1, axis=0), ahead


def is_inside(loops: Sequence[UV], places: UV) -> Mask:
    """Tell which places are inside an odd number of loops: those in an outer one and in no hole.

    It is exact. A place on a side that has the inside on its right counts as inside, one that has it on its left does
    not, so that polygons side by side share no place; places that are nan are outside.

    Examples
    --------
    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> is_inside([3.0 * square, 1.0 + square[::-1]], np.array([[0.5, 0.5], [1.5, 1.5], [4.0, 1.5]])).tolist()
    [True, False, False]
    """
    starts = np.concatenate(loops, dtype=np.float64)
    ends = np.concatenate([np.roll(loop, -1, axis=0) for loop in loops], dtype=np.float64)
    found, asked = np.empty(len(places), np.bool_), np.ascontiguousarray(places, dtype=np.float64)
    over_ranges(lambda first, last: measure_inside(starts, ends, asked, first, last, found), len(found))
    return found


def check_polygon(name: str, corners: ArrayLike) -> UV:
    """Return the corners of a polygon as (b, 2) float64.

    Raises
    ------
    InputError
        On a wrong shape, NaN or infinity, naming the polygon.

    Examples
    --------
    >>> check_polygon("loop 2", [[0, 0], [1, 0]])
    Traceback (most recent call last):
    pointchart.errors.InputError: loop 2 has shape (2, 2); at least 3 finite corners, (b, 2), are needed
    """
    polygon = np.asarray(corners, dtype=np.float64)
    if polygon.ndim != 2 or polygon.shape[1] != 2 or len(polygon) < 3 or not np.isfinite(polygon).all():
        raise InputError(f"{name} has shape {polygon.shape}; at least 3 finite corners, (b, 2), are needed")
    return polygon


def check_senses(loops: Sequence[UV]) -> Floats:
    """Return the signed areas of loops of which the first runs anticlockwise, the others, round holes, clockwise.

    Raises
    ------
    InputError
        If one runs the other way.

    Examples
    --------
    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> check_senses([square, 0.25 + 0.5 * square[::-1]])
    array([ 1.  , -0.25])
    >>> check_senses([square[::-1]])
    Traceback (most recent call last):
    pointchart.errors.InputError: loop 0 has the signed area -1, but the outer loop runs anticlockwise; reverse it
    """
    areas = np.array([signed_area(loop) for loop in loops])
    for i, area in enumerate(areas):
        if (area > 0.0) != (i == 0):
            sense = "the outer loop runs anticlockwise" if i == 0 else "a hole runs clockwise"
            raise InputError(f"loop {i} has the signed area {area:g}, but {sense}; reverse it")
    return areas


def check_convex(polygon: ArrayLike, *, is_strict: bool = False) -> UV:
    """Return the corners of a convex polygon as (b, 2) float64, or say why they are none.

    A strict one is anticlockwise and has no straight angles; any other may run either way.

    Raises
    ------
    InputError
        If corners repeat, the polygon turns right by more than rounding, or not once around in all.

    Examples
    --------
    >>> check_convex([[0, 0], [1, 0], [2, 0], [0, 1]]).tolist()
    [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]]
    """
    corners = check_polygon("the domain", polygon)
    behind, ahead = sides_at(corners)
    turns, dot = cross(behind, ahead), np.einsum("ij,ij->i", behind, ahead)
    turns = turns if is_strict or turns.sum() > 0.0 else -turns
    lengths = np.linalg.norm(ahead, axis=1)
    # A difference of coordinates is wrong by an ulp of their size, which turns short steps.
    slack = 0.0 if is_strict else 1e-15 * np.abs(corners).max() * (lengths + np.roll(lengths, 1))
    turns_once = abs(np.arctan2(turns, dot).sum() - 2.0 * np.pi) < 0.1
    if (lengths == 0.0).any() or (turns < -slack).any() or (is_strict and (turns <= 0.0).any()) or not turns_once:
        raise InputError(
            "the domain is no convex polygon: give its corners in order, once around, without repetitions"
            + (", anticlockwise, without straight angles" if is_strict else "")
        )
    return corners


def check_layout(boundary_uv: ArrayLike, loop: Loop) -> UV:
    """Return where a boundary goes, (b, 2) float64, if that is round a convex domain, or say why not.

    Raises
    ------
    InputError
        See `check_convex`; or if there is not one place for each boundary point.
    """
    layout = check_convex(boundary_uv)
    if layout.shape != (len(loop), 2):
        raise InputError(f"boundary_uv has shape {layout.shape}; the loop of {len(loop)} points needs ({len(loop)}, 2)")
    return layout
