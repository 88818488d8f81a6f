"""CAD files that hold one trimmed B-spline face, by Open CASCADE, an extra that is imported on first use."""

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..errors import FormatError, SolveError
from ..io import check_output, replacing
from ..io.source import AnyPath, check_readable
from ..surface import BSplineSurface
from ..typing import UV
from .compare import check_written, is_valid
from .formats import read_brep, read_iges, read_step, write_brep, write_iges, write_step
from .make_face import make_face
from .occ import check_extra, failing_as, silence
from .read_face import only_face, split
from .surface_checks import check_loops, check_surface
from .trims import Edge, straight_edges, trim_edges
from .units import MILLIMETRES, check_unit

# By both suffixes in use, in the order in which messages name them.
_WRITERS = {".step": write_step, ".stp": write_step, ".iges": write_iges, ".igs": write_iges, ".brep": write_brep}
_READERS = {".step": read_step, ".stp": read_step, ".iges": read_iges, ".igs": read_iges, ".brep": read_brep}
CAD_SUFFIXES = tuple(_WRITERS)
_UNWRITTEN = "Open CASCADE cannot write it; free the disk or choose another output"  # it gives no reason of its own


def write_cad(
    path: AnyPath, surface: BSplineSurface, loops: Sequence[UV], *, unit: str = "mm", name: str = "surface"
) -> None:
    """Write the part of a surface inside loops as one face, in the format of the suffix, whole or not at all.

    Between corners a smooth curve runs through the points of a loop; see `trim_edges`. The file is read back before it
    takes its place, and compared with what was to be written. STEP holds 13 digits, IGES 10 and BREP all.

    Parameters
    ----------
    path
        A file with one of the suffixes in `CAD_SUFFIXES`; one that exists is replaced.
    surface
    loops
        Closed polygons in the domain, each (n, 2), whose last point is not the first one again: the outer one
        anticlockwise, then holes in it clockwise. The corners of the domain alone stand for the whole surface.
    unit
        Of the control points; one of `MILLIMETRES`. BREP names no unit, so that it always holds millimetres.
    name
        Of the product, in STEP and IGES.

    Raises
    ------
    FormatError
        The file cannot be written, or not so exactly; or the extra `cad` is not installed.
    InputError
        The loops, the surface or the unit are not as above.
    SolveError
        Open CASCADE finds no valid face.
    """
    target = check_output(path, suffixes=CAD_SUFFIXES)
    check_extra(path)
    outlines = check_loops(loops, check_surface(surface).domain)
    scaled = replace(surface, control=surface.control * MILLIMETRES[check_unit(unit)])
    with silence():
        face, edges = _valid_face(path, scaled, outlines)
        with replacing(path) as temporary, failing_as(FormatError, f"{path}: {_UNWRITTEN}"):
            if not _WRITERS[target.suffix.lower()](_encodable(temporary, path), face, unit, name):
                raise FormatError(f"{path}: {_UNWRITTEN}")
            check_written(path, read_face(temporary, path)[0], scaled, edges)


def read_cad(path: AnyPath) -> tuple[BSplineSurface, list[UV], str]:
    """Read a file of one face on a B-spline surface without weights.

    Parameters
    ----------
    path
        A file with one of the suffixes in `CAD_SUFFIXES`.

    Returns
    -------
    surface
        In the unit of the file. If the degrees in u and v differ, the lower one is raised.
    loops
        As `write_cad` takes them, finely sampled where trim curves bend.
    unit
        One of `MILLIMETRES`; "mm", into which coordinates are then converted, if the file names none or another one.

    Raises
    ------
    FormatError
        The file cannot be read, holds no such face, or the extra `cad` is not installed.
    """
    check_readable(path)
    check_extra(path)
    with silence(), failing_as(FormatError, f"{path}: Open CASCADE cannot read it; copy or export it again"):
        face, unit = read_face(path, path)
        surface, loops = split(face)
    return replace(surface, control=surface.control / MILLIMETRES[unit]), loops, unit


def read_face(path: AnyPath, called: AnyPath) -> tuple[Any, str]:
    """Return the face in a file, in millimetres, and the unit of the file; errors name the path `called`."""
    suffix = Path(path).suffix.lower()
    if suffix not in _READERS:
        raise FormatError(f"{called}: the suffix '{suffix}' cannot be read here; choose one of {', '.join(_READERS)}")
    shape, unit = _READERS[suffix](_encodable(path, called))
    return only_face(called, shape), unit


def _valid_face(path: AnyPath, surface: BSplineSurface, loops: list[UV]) -> tuple[Any, list[list[Edge]]]:
    """Return a face and its edges: smooth ones, or straight ones if Open CASCADE finds splines that touch."""
    with failing_as(SolveError, f"{path}: Open CASCADE makes no face of the surface; fit it with fewer knots"):
        for trim in (trim_edges, straight_edges):
            edges = trim(surface, loops)
            face = make_face(surface, edges)
            if is_valid(face):
                return face, edges
    raise SolveError(f"{path}: the face with {len(loops)} loops is not valid; simplify the loops or refit")


def _encodable(path: AnyPath, called: AnyPath) -> str:
    name = os.fspath(path)
    try:
        name.encode()
    except UnicodeEncodeError as error:
        raise FormatError(
            f"{os.fspath(called)!r}: character {error.start} is no UTF-8, which Open CASCADE needs; rename the file"
        ) from None
    return name
