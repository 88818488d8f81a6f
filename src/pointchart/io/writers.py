"""One door for every format that can be written; a file is replaced whole or not at all."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..typing import UV, Attributes, Loop, Points, Triangles
from .colors import with_byte_colors
from .mesh_formats import MESH_WRITERS, SINGLE, digits_lost
from .output import check_suffix, replacing
from .ply import write_ply
from .source import AnyPath
from .uv_formats import UV_WRITERS

# In lower case, as suffixes are compared.
MESH_SUFFIXES = tuple(MESH_WRITERS)
UV_SUFFIXES = tuple(UV_WRITERS)


def write_mesh(
    path: AnyPath, points: Points, triangles: Triangles, *, uv: UV | None = None, attributes: Attributes | None = None
) -> list[str]:
    """Write a triangle mesh whose vertex i is point i.

    PLY and NPZ hold everything exactly, OBJ the points and uv exactly, OFF the points exactly; STL and GLB hold single
    precision. `u` and `v` of the attributes give way to `uv`.

    Parameters
    ----------
    path
        A file with one of the suffixes in `MESH_SUFFIXES`; one that exists is replaced.
    points
        (n, 3), in any unit.
    triangles
        (m, 3) point indices.
    uv
        (n, 2) parameters.
    attributes
        Further values, each (n,), by name; colours become bytes `red`, `green`, `blue`, which programs show.

    Returns
    -------
    One sentence for each thing that the format cannot hold; mostly none.

    Raises
    ------
    FormatError
        The suffix is unknown or the file cannot be written.
    InputError
        An array has not one row for each point.
    """
    write = MESH_WRITERS[check_suffix(path, MESH_WRITERS)]
    kept = _checked(points, uv, attributes)
    with replacing(path) as temporary:
        return write(temporary, points, triangles, uv, kept)


def check_digits(path: AnyPath, points: Points) -> None:
    """Check before a long run that the file will tell all points apart, which single precision may not.

    Parameters
    ----------
    path
        The mesh that is to be written.
    points
        (n, 3).

    Raises
    ------
    FormatError
        The format makes points coincide that are distinct.

    Examples
    --------
    >>> check_digits("far.ply", np.array([[5e6, 0.0, 0.0], [5e6 + 0.1, 0.0, 0.0]]))
    """
    kind = SINGLE.get(Path(path).suffix.lower())
    if kind is not None:
        digits_lost(kind, points)


def write_curves(
    path: AnyPath, points: Points, loops: Sequence[Loop], *, attributes: Attributes | None = None
) -> list[str]:
    """Write points and the closed polylines that run through some of them, as PLY with an edge element.

    Parameters
    ----------
    path
        A PLY file; one that exists is replaced.
    points
        (n, 3), all of them: vertex i is point i.
    loops
        Point indices of each polyline, in order, not closed.
    attributes
        Further values, each (n,), by name.

    Returns
    -------
    One sentence for each thing that the format cannot hold; mostly none.

    Raises
    ------
    FormatError
        The file cannot be written.
    InputError
        An array has not one row for each point.
    """
    check_suffix(path, [".ply"])
    kept = _checked(points, None, attributes)
    edges = [np.column_stack([loop, np.roll(loop, -1)]) for loop in loops]
    with replacing(path) as temporary, temporary.open("wb") as file:
        return write_ply(file, points, kept, edges=np.concatenate([np.empty((0, 2), np.int64), *edges]))


def write_uv(path: AnyPath, uv: UV, *, points: Points | None = None, attributes: Attributes | None = None) -> list[str]:
    """Write parameters, row i for point i.

    CSV has the header `u,v`; TXT, XYZ and NPY are two columns; NPZ holds all that is given; PLY holds the points with
    properties u and v, or without points the parameters themselves as (u, v, 0).

    Parameters
    ----------
    path
        A file with one of the suffixes in `UV_SUFFIXES`; one that exists is replaced.
    uv
        (n, 2) parameters.
    points
        (n, 3), which PLY and NPZ hold as well.
    attributes
        Further values, each (n,), by name, which PLY and NPZ hold as well.

    Returns
    -------
    One sentence for each thing that the format cannot hold; mostly none.

    Raises
    ------
    FormatError
        The suffix is unknown or the file cannot be written.
    InputError
        An array has not one row for each point.
    """
    write = UV_WRITERS[check_suffix(path, UV_WRITERS)]
    kept = _checked(points, uv, attributes)
    with replacing(path) as temporary:
        return write(temporary, uv, points, kept)


def _checked(points: Points | None, uv: UV | None, attributes: Attributes | None) -> Attributes:
    """Check the shapes and return the attributes that do not give way to uv, colours as bytes."""
    n_points = len(next(a for a in (points, uv) if a is not None))
    if points is not None and points.shape != (n_points, 3):
        raise InputError(
            f"points have shape {points.shape} where ({n_points}, 3) is due; give x, y and z of each point"
        )
    if uv is not None and uv.shape != (n_points, 2):
        raise InputError(f"uv has shape {uv.shape} where {n_points} points need ({n_points}, 2); give each point a row")
    for name, column in (attributes or {}).items():
        if column.shape != (n_points,):
            raise InputError(f"attribute {name} has shape {column.shape} where {n_points} points need ({n_points},)")
    hidden = ("x", "y", "z") if uv is None else ("x", "y", "z", "u", "v")
    return with_byte_colors({name: column for name, column in (attributes or {}).items() if name not in hidden})
