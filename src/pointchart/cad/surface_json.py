"""Surfaces and their loops as JSON: each number comes back to the last bit."""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import FormatError, InputError
from ..io import check_output, replacing
from ..io.source import AnyPath, decode, read_bytes
from ..surface import BSplineSurface
from ..typing import UV, Floats
from .surface_checks import check_loops, check_surface
from .units import check_unit

FORMAT, VERSION = "pointchart surface", 1  # by which a file says what it is; the number changes when a member does
_MEMBERS = ("degree", "knots_u", "knots_v", "control", "loops", "unit")  # that have to be there besides those two


def write_surface_json(path: AnyPath, surface: BSplineSurface, loops: Sequence[UV], *, unit: str = "mm") -> None:
    """Write a surface and the loops that trim it, whole or not at all.

    The file is an object with the members `format`, `version`, `degree`, `knots_u`, `knots_v`, `control` (a, b, 3),
    `loops` and `unit`.

    Parameters
    ----------
    path
        A `.json` file; one that exists is replaced.
    surface
    loops
        Closed polygons in the domain, as `write_cad` takes them.
    unit
        Of the control points; one of `MILLIMETRES`.

    Raises
    ------
    FormatError
        The file cannot be written.
    InputError
        The loops, the surface or the unit are not as above.
    """
    check_output(path, suffixes=(".json",))
    outlines = check_loops(loops, check_surface(surface).domain)
    held = {
        "format": FORMAT,
        "version": VERSION,
        "unit": check_unit(unit),
        "degree": int(surface.degree),
        "knots_u": surface.knots_u.tolist(),
        "knots_v": surface.knots_v.tolist(),
        "control": surface.control.tolist(),
        "loops": [loop.tolist() for loop in outlines],
    }
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(held) + "\n", encoding="utf-8")


def read_surface_json(path: AnyPath) -> tuple[BSplineSurface, list[UV], str]:
    """Read what `write_surface_json` writes: the surface, its loops and the unit.

    Raises
    ------
    FormatError
        The file cannot be read or is not such a file; the member that is wrong is named.

    Examples
    --------
    >>> import tempfile
    >>> path = tempfile.mkdtemp() + "/saddle.json"
    >>> knots, corners = np.array([0.0, 0, 1, 1]), np.array([[[0.0, 0, 0], [0, 2, 0]], [[4, 0, 0], [4, 2, 8]]])
    >>> saddle, triangle = BSplineSurface(1, knots, knots, corners), np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> write_surface_json(path, saddle, [triangle], unit="cm")
    >>> found, loops, unit = read_surface_json(path)
    >>> float(found.control.max()), loops[0].shape, unit
    (8.0, (3, 2), 'cm')
    """
    held = _parse(path, decode(read_bytes(path)))
    if not isinstance(degree := held["degree"], int) or isinstance(degree, bool):
        raise FormatError(f"{path}: 'degree' is {degree!r}, not a whole number; export the file again")
    if not isinstance(held["loops"], list):
        raise FormatError(f"{path}: 'loops' is no list of polygons; export the file again")
    knots_u, knots_v, control = (_numbers(path, name, held[name]) for name in ("knots_u", "knots_v", "control"))
    loops = [_numbers(path, f"loop {i}", loop) for i, loop in enumerate(held["loops"])]
    try:
        surface = check_surface(BSplineSurface(degree, knots_u, knots_v, control))
        return surface, check_loops(loops, surface.domain), check_unit(held["unit"])
    except InputError as error:
        raise FormatError(f"{path}: {error}") from None


def _parse(path: AnyPath, text: str) -> dict[str, Any]:
    try:
        held = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise FormatError(f"{path}: this is no whole JSON file ({error}); copy or export it again") from None
    if not isinstance(held, dict) or held.get("format") != FORMAT:
        raise FormatError(f"{path}: there is no member 'format' that is '{FORMAT}'; give it a file of that format")
    if held.get("version") != VERSION:
        raise FormatError(f"{path}: the version is {held.get('version')!r}, but {VERSION} is read; export it again")
    missing = [name for name in _MEMBERS if name not in held]
    if missing:
        raise FormatError(f"{path}: there is no member '{missing[0]}' ({len(missing)} are missing); export it again")
    return held


def _numbers(path: AnyPath, name: str, values: Any) -> Floats:
    try:
        return np.array(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise FormatError(f"{path}: {name} is no array of numbers ({error}); export the file again") from None
