"""Binary glTF in and out, through trimesh, which is imported on first use: it takes most of a second."""

import io
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from ..typing import UV, Indices, Points, Triangles
from .scan import Scan, fan_triangles, scan_from_columns
from .source import AnyPath, read_bytes

_COLOURS = ("red", "green", "blue", "alpha")  # in the order of glTF; other formats call them so


def read_glb(path: AnyPath) -> Scan:
    """Read all meshes and clouds of the scene, placed as its nodes say, one after the other."""
    import trimesh

    data = read_bytes(path)
    try:
        scene = trimesh.load_scene(io.BytesIO(data), file_type="glb", process=False)
        # the nodes come in the order of a walk through the scene, the meshes in that of the file
        rank = {name: i for i, name in enumerate(scene.geometry)}
        placed = sorted((scene.graph[node] for node in scene.graph.nodes_geometry), key=lambda part: rank[part[1]])
        scans = [_part(scene.geometry[name], transform) for transform, name in placed]
    except Exception as error:
        raise FormatError(f"{path}: this is no whole binary glTF file ({error}); export it again") from None
    if not scans:
        raise FormatError(f"{path}: the scene holds 0 meshes and 0 clouds; export it again with its points")
    starts = np.cumsum([0, *(len(columns["x"]) for columns, _ in scans)])
    # an attribute that only some of the parts have has no value for the others
    common = [name for name in scans[0][0] if all(name in columns for columns, _ in scans)]
    columns = {name: np.concatenate([columns[name] for columns, _ in scans]) for name in common}
    triangles = np.concatenate([faces + start for (_, faces), start in zip(scans, starts, strict=False)])
    return scan_from_columns(path, columns, fan_triangles(path, [(np.arange(len(triangles)), triangles)], starts[-1]))


def write_glb(file: BinaryIO, points: Points, triangles: Triangles, uv: UV | None) -> None:
    """Write single precision positions, and uv as TEXCOORD_0."""
    import trimesh

    visual = None if uv is None else trimesh.visual.TextureVisuals(uv=uv)
    mesh = trimesh.Trimesh(points, triangles, process=False, validate=False, visual=visual)
    content: bytes = trimesh.exchange.gltf.export_glb(mesh)
    file.write(content)


def _part(geometry: Any, transform: NDArray[np.float64]) -> tuple[dict[str, NDArray[Any]], Indices]:
    points = np.asarray(geometry.vertices, np.float64) @ transform[:3, :3].T + transform[:3, 3]
    columns: dict[str, NDArray[Any]] = dict(zip("xyz", points.T, strict=True))
    visual = getattr(geometry, "visual", None)
    uv = getattr(visual, "uv", None)
    if uv is not None and len(uv) == len(points):
        columns |= dict(zip("uv", np.asarray(uv).T, strict=True))
    colours = visual.vertex_colors if visual is not None and visual.kind == "vertex" else None
    if colours is not None and len(colours) == len(points):
        columns |= dict(zip(_COLOURS, np.asarray(colours).T, strict=False))
    faces = np.asarray(getattr(geometry, "faces", np.empty((0, 3))), np.int64)
    return columns, faces
