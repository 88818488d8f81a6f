"""One door for every format that can be written; a file is replaced whole or not at all."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeAlias, TypeVar

import numpy as np

from ..errors import FormatError, InputError
from ..typing import UV, Attributes, Loop, Points, Triangles
from .arrays import write_npz
from .distinct import distinct_rows
from .glb import write_glb
from .obj import write_obj
from .off import write_off
from .output import replacing
from .ply import write_ply
from .source import AnyPath
from .stl import write_stl
from .table import write_rows

_MeshWriter: TypeAlias = Callable[[Path, Points, Triangles, UV | None, Attributes], list[str]]
_UVWriter: TypeAlias = Callable[[Path, UV, Points | None, Attributes], list[str]]
_Writer = TypeVar("_Writer")
SINGLE = {".stl": "STL", ".glb": "GLB"}  # formats of single precision


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
        Further values, each (n,), by name.

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
    write = _writer(path, _MESH_WRITERS)
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
        _digits_lost(kind, points)


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
    _writer(path, {".ply": write_ply})
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
    write = _writer(path, _UV_WRITERS)
    kept = _checked(points, uv, attributes)
    with replacing(path) as temporary:
        return write(temporary, uv, points, kept)


def _writer(path: AnyPath, writers: dict[str, _Writer]) -> _Writer:
    suffix = Path(path).suffix.lower()
    if suffix not in writers:
        known = ", ".join(writers)
        raise FormatError(f"{path}: the suffix '{suffix}' cannot be written here; choose one of {known}")
    return writers[suffix]


def _checked(points: Points | None, uv: UV | None, attributes: Attributes | None) -> Attributes:
    """Check the shapes and return the attributes that do not give way to uv."""
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
    return {name: column for name, column in (attributes or {}).items() if name not in hidden}


def _mesh_ply(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    with path.open("wb") as file:
        return write_ply(file, points, _columns(uv) | attributes, triangles=triangles)


def _mesh_obj(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    with path.open("w", encoding="utf-8", newline="\n") as file:
        write_obj(file, points, triangles, uv)
    return _left_out("OBJ", attributes)


def _mesh_off(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    with path.open("w", encoding="utf-8", newline="\n") as file:
        write_off(file, points, triangles)
    return _left_out("OFF", _columns(uv) | attributes)


def _mesh_stl(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    notes = _digits_lost("STL", points)
    with path.open("wb") as file:
        write_stl(file, points, triangles)
    return notes + _left_out("STL", _columns(uv) | attributes)


def _mesh_glb(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    notes = _digits_lost("GLB", points)
    with path.open("wb") as file:
        write_glb(file, points, triangles, uv)
    return notes + _left_out("GLB", attributes)


def _mesh_npz(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    with path.open("wb") as file:
        write_npz(file, points=points, triangles=triangles, uv=uv, attributes=attributes)
    return []


def _uv_text(path: Path, uv: UV, points: Points | None, attributes: Attributes) -> list[str]:
    is_csv = path.suffix.lower() == ".csv"
    with path.open("w", encoding="utf-8", newline="\n") as file:
        file.write("u,v\n" if is_csv else "")
        write_rows(file, "{!r},{!r}" if is_csv else "{!r} {!r}", uv)
    return []


def _uv_npy(path: Path, uv: UV, points: Points | None, attributes: Attributes) -> list[str]:
    with path.open("wb") as file:
        np.save(file, uv, allow_pickle=False)
    return []


def _uv_npz(path: Path, uv: UV, points: Points | None, attributes: Attributes) -> list[str]:
    with path.open("wb") as file:
        write_npz(file, points=points, triangles=None, uv=uv, attributes=attributes)
    return []


def _uv_ply(path: Path, uv: UV, points: Points | None, attributes: Attributes) -> list[str]:
    flat = np.column_stack([uv, np.zeros(len(uv))])
    with path.open("wb") as file:
        return write_ply(file, flat if points is None else points, _columns(uv) | attributes)


def _columns(uv: UV | None) -> Attributes:
    return {} if uv is None else {"u": uv[:, 0], "v": uv[:, 1]}


def _left_out(kind: str, attributes: Attributes) -> list[str]:
    if not attributes:
        return []
    return [f"pointchart writes no {', '.join(attributes)} to {kind}; write .ply to keep them."]


def _digits_lost(kind: str, points: Points) -> list[str]:
    """Say what single precision does to coordinates with a large offset, as those of a survey."""
    if not len(points):
        return []
    with np.errstate(over="ignore"):
        single = points.astype(np.float32)
    extent = float(np.ptp(points, axis=0).max())
    error = float(np.abs(single - points).max())
    n_merged = len(distinct_rows(points)[0]) - len(distinct_rows(single)[0])
    if n_merged:
        raise FormatError(
            f"{kind} holds single precision, which makes {n_merged} of these points coincide with others (they move by "
            f"up to {error:.2g}, their extent is {extent:.2g}); write .ply, or subtract the offset first"
        )
    if error <= 1e-6 * extent:
        return []
    return [
        f"{kind} holds single precision, which moves these points by up to {error:.2g} (their extent is {extent:.2g}); "
        "write .ply to keep every digit."
    ]


# In the order in which messages name them.
_MESH_WRITERS: dict[str, _MeshWriter] = {
    ".ply": _mesh_ply,
    ".obj": _mesh_obj,
    ".off": _mesh_off,
    ".stl": _mesh_stl,
    ".glb": _mesh_glb,
    ".npz": _mesh_npz,
}
# The same for parameters without a mesh.
_UV_WRITERS: dict[str, _UVWriter] = {
    ".csv": _uv_text,
    ".txt": _uv_text,
    ".xyz": _uv_text,
    ".npy": _uv_npy,
    ".npz": _uv_npz,
    ".ply": _uv_ply,
}
# In lower case, as suffixes are compared.
MESH_SUFFIXES = tuple(_MESH_WRITERS)
UV_SUFFIXES = tuple(_UV_WRITERS)
