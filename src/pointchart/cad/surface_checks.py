"""What a surface and its loops have to be before they are written."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, name_some
from ..plane.polygons import check_polygon, check_senses, is_inside
from ..surface import BSplineSurface
from ..surface.knots import check_clamped
from ..typing import UV, Floats


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
    check_senses(arrays)
    for i, hole in enumerate(arrays[1:], start=1):
        if not is_inside([other for j, other in enumerate(arrays) if j != i], hole[:1])[0]:
            raise InputError(f"loop {i} begins at {hole[0].tolist()}, which is no place inside; drop that hole")
    return arrays


def _check_loop(i: int, loop: ArrayLike, domain: Floats) -> UV:
    array = check_polygon(f"loop {i}", loop)
    repeated = np.flatnonzero((array == np.roll(array, -1, axis=0)).all(axis=1))
    if len(repeated):
        raise InputError(f"loop {i} repeats its points {name_some(repeated)} at once; drop one of each two")
    outside = np.flatnonzero(((array < domain[0]) | (array > domain[1])).any(axis=1))
    if len(outside):
        raise InputError(
            f"loop {i} leaves the domain {domain.tolist()} at points {name_some(outside)}; clip it or fit further out"
        )
    return array
