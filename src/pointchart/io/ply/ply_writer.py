"""A mesh or curves to PLY: binary, little endian, double precision."""

from collections.abc import Iterator
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ...typing import Attributes, Indices, Points, Triangles
from .ply_header import TYPES

_TYPE_NAMES = {code: name for name, code in TYPES.items()}  # those of the format itself, which every program reads
_BLOCK = 1 << 17  # rows at a time, so that a copy of them takes megabytes, however many there are


def write_ply(
    file: BinaryIO,
    points: Points,
    attributes: Attributes,
    *,
    triangles: Triangles | None = None,
    edges: Indices | None = None,
) -> list[str]:
    """Write x, y, z, then the attributes in the types that PLY has; return a sentence on each that is rounded."""
    notes: list[str] = []
    columns = dict(zip("xyz", np.asarray(points, np.float64).T, strict=True))
    for name, column in attributes.items():
        columns[_property_name(name, columns)] = _in_ply_type(name, column, notes)
    dtype = np.dtype([(name, column.dtype.newbyteorder("<")) for name, column in columns.items()])
    header = [
        "ply",
        "format binary_little_endian 1.0",
        "comment written by pointchart",
        f"element vertex {len(points)}",
    ]
    header += [f"property {_TYPE_NAMES[column.dtype.str[1:]]} {name}" for name, column in columns.items()]
    if triangles is not None:
        header += [f"element face {len(triangles)}", "property list uchar int vertex_indices"]
    if edges is not None:
        header += [f"element edge {len(edges)}", "property int vertex1", "property int vertex2"]
    file.write("\n".join([*header, "end_header", ""]).encode())
    for start, stop in _blocks(len(points)):
        rows = np.empty(stop - start, dtype)
        for name, column in columns.items():
            rows[name] = column[start:stop]
        file.write(rows.tobytes())
    for start, stop in _blocks(0 if triangles is None else len(triangles)):
        faces = np.empty(stop - start, [("count", "u1"), ("corners", "<i4", 3)])
        faces["count"] = 3
        faces["corners"] = triangles[start:stop] if triangles is not None else 0
        file.write(faces.tobytes())
    if edges is not None:
        file.write(edges.astype("<i4").tobytes())
    return notes


def _property_name(name: str, taken: dict[str, NDArray[Any]]) -> str:
    """Return the name in one word that no earlier property has."""
    word = base = "_".join(name.split()) or "unnamed"
    number = 2
    while word in taken:
        word, number = f"{base}_{number}", number + 1
    return word


def _in_ply_type(name: str, column: NDArray[Any], notes: list[str]) -> NDArray[Any]:
    """Cast to one of the eight types of PLY, without loss where there is one."""
    if column.dtype.str[1:] in _TYPE_NAMES:
        return column
    if column.dtype.kind == "b":
        return column.astype("u1")
    if column.dtype.kind in "iu" and len(column) and column.min() >= -(2**31) and column.max() < 2**31:
        return column.astype("i4")
    n_large = 0 if column.dtype.kind == "f" else int(np.count_nonzero((column > 2**53) | (column < -(2**53))))
    if n_large:
        notes.append(f"PLY has no type for {name} ({column.dtype}), so {n_large} of its values are rounded to double.")
    return column.astype("f8")


def _blocks(n: int) -> Iterator[tuple[int, int]]:
    return ((start, min(start + _BLOCK, n)) for start in range(0, n, _BLOCK))
