"""Parameters without a mesh in each format that can be written."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np

from ..typing import UV, Attributes, Points
from .arrays import write_npz
from .ply import write_ply
from .scan import uv_columns
from .table import write_rows

UVWriter: TypeAlias = Callable[[Path, UV, Points | None, Attributes], list[str]]


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
        return write_ply(file, flat if points is None else points, uv_columns(uv) | attributes)


# In the order in which messages name them.
UV_WRITERS: dict[str, UVWriter] = {
    ".csv": _uv_text,
    ".txt": _uv_text,
    ".xyz": _uv_text,
    ".npy": _uv_npy,
    ".npz": _uv_npz,
    ".ply": _uv_ply,
}
