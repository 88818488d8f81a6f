"""What a surface and its loops have to be before they are written."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, name_some
from ..plane.polygons import signed_area
from ..surface import BSplineSurface
from ..surface.knots import check_clamped
from ..typing import UV, Floats, Mask


def check_surface(surface: BSplineSurface) -> BSplineSurface:
    """Return a surface whose knots are clamped, as files hold them."""
    check_clamped("knots_u", surface.knots_u, surface.degree)
    check_clamped("knots_v", surface.knots_v, surface.degree)
    return surface


def check_loops(loops: Sequence[ArrayLike], domain: Floats) -> list[UV]:
    """Return loops as (n, 2) float64 each: the outer one anticlockwise, holes in it clockwise, all in the domain.

    Whether sides cross is not looked at here.

    Raises
    ------
    InputError
        On no loop, a wrong shape, NaN or infinity, repeated points, a wrong sense, or places outside.

    Examples
    --------
    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> len(check_loops([square, 0.25 + 0.5 * square[::-1]], np.array([[0, 0], [1, 1]])))
    2
    >>> check_loops([square[::-1]], np.array([[0, 0], [1, 1]]))
    Traceback (most recent call last):
    pointchart.errors.InputError: loop 0 has the signed area -1, but the outer loop runs anticlockwise; reverse it
    """
    if not len(loops):
        raise InputError("there are 0 loops; give the outer one first")
    arrays = [_check_loop(i, loop, domain) for i, loop in enumerate(loops)]
    for i, hole in enumerate(arrays[1:], start=1):
        if not is_inside([other for j, other in enumerate(arrays) if j != i], hole[:1])[0]:
            raise InputError(f"loop {i} begins at {hole[0].tolist()}, which is no place inside; drop that hole")
    return arrays


def _check_loop(i: int, loop: ArrayLike, domain: Floats) -> UV:
    array = np.asarray(loop, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 2 or len(array) < 3 or not np.isfinite(array).all():
        raise InputError(f"loop {i} has shape {array.shape}; at least 3 finite parameter pairs, (n, 2), are needed")
    repeated = np.flatnonzero((array == np.roll(array, -1, axis=0)).all(axis=1))
    if len(repeated):
        raise InputError(f"loop {i} repeats its points {name_some(repeated)} at once; drop one of each two")
    outside = np.flatnonzero(((array < domain[0]) | (array > domain[1])).any(axis=1))
    if len(outside):
        raise InputError(
            f"loop {i} leaves the domain {domain.tolist()} at points {name_some(outside)}; clip it or fit further out"
        )
    area = signed_area(array)
    if (area > 0.0) != (i == 0):
        sense = "the outer loop runs anticlockwise" if i == 0 else "a hole runs clockwise"
        raise InputError(f"loop {i} has the signed area {area:g}, but {sense}; reverse it")
    return array


def is_inside(loops: Sequence[UV], uv: UV) -> Mask:
    """Tell which parameters a ray from them leaves through an odd number of sides: those in the outer loop and no hole.

    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> is_inside([3.0 * square, 1.0 + square[::-1]], np.array([[0.5, 0.5], [1.5, 1.5], [4.0, 1.5]])).tolist()
    [True, False, False]
    """
    odd = np.zeros(len(uv), np.bool_)
    for a, b in ((loop, np.roll(loop, -1, axis=0)) for loop in loops):
        spans = (a[:, 1] > uv[:, 1:]) != (b[:, 1] > uv[:, 1:])
        rise = np.where(a[:, 1] == b[:, 1], 1.0, b[:, 1] - a[:, 1])
        meets = a[:, 0] + (uv[:, 1:] - a[:, 1]) * (b[:, 0] - a[:, 0]) / rise
        odd ^= (spans & (meets > uv[:, :1])).sum(axis=1) % 2 == 1
    return odd
