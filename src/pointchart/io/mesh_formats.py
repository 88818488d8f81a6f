"""A mesh in each format that can be written, and what the format cannot hold of it."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np

from ..errors import FormatError
from ..typing import UV, Attributes, Points, Triangles
from .arrays import write_npz
from .distinct import distinct_rows
from .glb import write_glb
from .obj import write_obj
from .off import write_off
from .ply import write_ply
from .scan import uv_columns
from .stl import write_stl

MeshWriter: TypeAlias = Callable[[Path, Points, Triangles, UV | None, Attributes], list[str]]
SINGLE = {".stl": "STL", ".glb": "GLB"}  # formats of single precision


def _mesh_ply(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    with path.open("wb") as file:
        return write_ply(file, points, uv_columns(uv) | attributes, triangles=triangles)


def _mesh_obj(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    with path.open("w", encoding="utf-8", newline="\n") as file:
        write_obj(file, points, triangles, uv)
    return _left_out("OBJ", attributes)


def _mesh_off(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    with path.open("w", encoding="utf-8", newline="\n") as file:
        write_off(file, points, triangles)
    return _left_out("OFF", uv_columns(uv) | attributes)


def _mesh_stl(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    notes = digits_lost("STL", points)
    with path.open("wb") as file:
        write_stl(file, points, triangles)
    return notes + _left_out("STL", uv_columns(uv) | attributes)


def _mesh_glb(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    notes = digits_lost("GLB", points)
    with path.open("wb") as file:
        write_glb(file, points, triangles, uv)
    return notes + _left_out("GLB", attributes)


def _mesh_npz(path: Path, points: Points, triangles: Triangles, uv: UV | None, attributes: Attributes) -> list[str]:
    with path.open("wb") as file:
        write_npz(file, points=points, triangles=triangles, uv=uv, attributes=attributes)
    return []


def _left_out(kind: str, attributes: Attributes) -> list[str]:
    if not attributes:
        return []
    return [f"pointchart writes no {', '.join(attributes)} to {kind}; write .ply to keep them."]


def digits_lost(kind: str, points: Points) -> list[str]:
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
MESH_WRITERS: dict[str, MeshWriter] = {
    ".ply": _mesh_ply,
    ".obj": _mesh_obj,
    ".off": _mesh_off,
    ".stl": _mesh_stl,
    ".glb": _mesh_glb,
    ".npz": _mesh_npz,
}
