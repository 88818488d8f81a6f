"""Numpy's own files: `.npy` with one row a point, and `.npz` as pointchart or others write it.

Members of our archive: `points` (n, 3), `triangles` (m, 3), `uv` (n, 2), and `attributes/NAME` (n,) for each attribute.
"""

from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from ..typing import UV, Attributes, Indices, Points
from .column_names import named_columns
from .scan import Scan, fan_triangles, scan_from_columns
from .source import AnyPath, check_readable

_PREFIX = "attributes/"  # so that an attribute may be called points, too
# What people call points, triangles, and columns that go together: Open3D, trimesh, PyTorch3D, PyTorch Geometric.
_POINTS = ("points", "vertices", "xyz", "pos", "positions", "verts", "coords", "point_cloud")
_TRIANGLES = ("triangles", "faces")
_COLORS, _NORMALS = ("red", "green", "blue", "alpha"), ("nx", "ny", "nz")
_COLUMNS = {"uv": ("u", "v"), "colors": _COLORS, "color": _COLORS, "rgb": _COLORS, "rgba": _COLORS}
_COLUMNS |= {"normals": _NORMALS, "normal": _NORMALS}
_NUMBERS = "fiub"  # kinds of numpy's types: no complex numbers, dates, texts or objects


def read_npy(path: AnyPath) -> Scan:
    """Read an (n, 3 or more) array of numbers, or a structured array with fields x, y and z."""
    check_readable(path)
    try:
        # mapped, so that a header with a false shape cannot make us allocate more than the file holds
        table = np.lib.format.open_memmap(Path(path), mode="r")
    except Exception as error:
        raise _damaged(path, error) from None
    if table.dtype.names is not None and table.ndim == 1:
        return scan_from_columns(path, _numeric_fields(table))
    if table.ndim != 2 or table.shape[1] < 3 or table.dtype.kind not in _NUMBERS:
        raise FormatError(f"{path}: the array is {table.dtype} of shape {table.shape}; save numbers, (n, 3) or wider")
    return scan_from_columns(path, dict(zip(named_columns((0, 1, 2), [""] * table.shape[1]), table.T, strict=True)))


def read_npz(path: AnyPath) -> Scan:
    """Read an archive of arrays: what `write_npz` writes, or points under another name with what belongs to them.

    `uv`, colours and normals become attributes of one column each, as do other arrays with a row for each point.
    """
    check_readable(path)
    try:
        with Path(path).open("rb") as file, np.load(file, allow_pickle=False) as archive:
            held: dict[str, NDArray[Any]] = {name: archive[name] for name in archive.files}
    except Exception as error:
        raise _damaged(path, error) from None
    name = _points_name(path, held)
    points = held.pop(name)
    _check_shape(path, name, points, (len(points) if points.ndim else 0, 3))
    triangles = next((held.pop(name) for name in _TRIANGLES if name in held), None)
    columns, notes = dict(zip("xyz", points.T, strict=True)), []
    for name, array in held.items():
        if name == "uv" or name.startswith(_PREFIX):
            _check_shape(path, name, array, (len(points), 2) if name == "uv" else (len(points),))
        if (parts := _per_point(name, array, len(points))) is None:
            notes.append(f"the array '{name}' ({array.dtype} of shape {array.shape}) is left out")
        for part, column in (parts or {}).items():
            columns.setdefault(part, column)
    if triangles is None or not triangles.size:
        return scan_from_columns(path, columns, notes=notes)
    _check_shape(path, "triangles", triangles, (len(triangles), 3), kinds="iu")
    faces = [(np.arange(len(triangles)), triangles.astype(np.int64))]
    return scan_from_columns(path, columns, fan_triangles(path, faces, len(points)), notes=notes)


def _points_name(path: AnyPath, held: dict[str, NDArray[Any]]) -> str:
    """Return the name of the array of points: one that such arrays have, or the only one with three columns."""
    named = [name for name in _POINTS if name in held]
    like_points = [name for name, array in held.items() if array.ndim == 2 and array.shape[1] == 3]
    if named or len(like_points) == 1:
        return (named or like_points)[0]
    raise FormatError(f"{path}: there is no array 'points' among {sorted(held)}; save the points under that name")


def _per_point(name: str, array: NDArray[Any], n_points: int) -> Attributes | None:
    """Split an array with a row for each point into named columns; None if it is none."""
    if array.dtype.kind not in _NUMBERS or array.ndim not in (1, 2) or len(array) != n_points:
        return None
    if array.ndim == 1:
        return {name.removeprefix(_PREFIX): array}
    known = _COLUMNS.get(name.lower(), ())
    if len(known) < array.shape[1]:
        known = tuple(f"{name}_{k + 1}" for k in range(array.shape[1]))
    return dict(zip(known, array.T, strict=False))


def write_npz(
    file: BinaryIO, *, points: Points | None, triangles: Indices | None, uv: UV | None, attributes: Attributes
) -> None:
    """Write the arrays that are given."""
    arrays = {"points": points, "triangles": triangles, "uv": uv}
    named = {name: array for name, array in arrays.items() if array is not None}
    named |= {_PREFIX + name: array for name, array in attributes.items()}
    np.savez(file, allow_pickle=False, **named)


def _numeric_fields(table: NDArray[Any]) -> dict[str, NDArray[Any]]:
    fields = {name: table[name] for name in table.dtype.names or ()}
    return {name: field for name, field in fields.items() if field.ndim == 1 and field.dtype.kind in _NUMBERS}


def _check_shape(path: AnyPath, name: str, array: NDArray[Any], shape: tuple[int, ...], kinds: str = _NUMBERS) -> None:
    if array.shape != shape or array.dtype.kind not in kinds:
        raise FormatError(f"{path}: '{name}' is {array.dtype} of shape {array.shape}, not numbers of shape {shape}")


def _damaged(path: AnyPath, error: BaseException) -> FormatError:
    return FormatError(f"{path}: this is no whole numpy file ({error}); save it again with numpy.save or numpy.savez")
