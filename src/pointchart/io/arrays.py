"""Numpy's own files: `.npy` with one row a point, and `.npz` as pointchart writes it.

Members of the archive: `points` (n, 3), `triangles` (m, 3), `uv` (n, 2), and `attributes/NAME` (n,) for each attribute.
"""

from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from ..typing import UV, Attributes, Indices, Points
from .scan import Scan, fan_triangles, scan_from_columns
from .source import AnyPath, check_readable
from .text import column_names

_PREFIX = "attributes/"  # so that an attribute may be called points, too
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
    return scan_from_columns(path, dict(zip(column_names(table.shape[1]), table.T, strict=True)))


def read_npz(path: AnyPath) -> Scan:
    """Read the archive that `write_npz` writes; `uv` becomes the attributes u and v."""
    check_readable(path)
    try:
        with Path(path).open("rb") as file, np.load(file, allow_pickle=False) as archive:
            held: dict[str, NDArray[Any]] = {name: archive[name] for name in archive.files}
    except Exception as error:
        raise _damaged(path, error) from None
    points, uv, triangles = held.get("points"), held.get("uv"), held.get("triangles")
    if points is None:
        raise FormatError(f"{path}: there is no array 'points' among {sorted(held)}; save the points under that name")
    _check_shape(path, "points", points, (len(points) if points.ndim else 0, 3))
    columns = dict(zip("xyz", points.T, strict=True))
    if uv is not None:
        _check_shape(path, "uv", uv, (len(points), 2))
        columns |= dict(zip("uv", uv.T, strict=True))
    for name in held:
        if name.startswith(_PREFIX):
            _check_shape(path, name, held[name], (len(points),))
            columns.setdefault(name.removeprefix(_PREFIX), held[name])
    if triangles is None or not triangles.size:
        return scan_from_columns(path, columns)
    _check_shape(path, "triangles", triangles, (len(triangles), 3), kinds="iu")
    faces = [(np.arange(len(triangles)), triangles.astype(np.int64))]
    return scan_from_columns(path, columns, fan_triangles(path, faces, len(points)))


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
