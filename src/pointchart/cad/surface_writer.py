"""Write a fitted surface in the format that the suffix of the file names."""

from collections.abc import Sequence
from pathlib import Path

from ..io import MESH_SUFFIXES, write_mesh
from ..io.source import AnyPath
from ..surface import BSplineSurface, tessellate
from ..typing import UV
from .cad_files import CAD_SUFFIXES, write_cad
from .surface_json import write_surface_json

SURFACE_SUFFIXES = (*CAD_SUFFIXES, ".json", *MESH_SUFFIXES)  # the surface itself first, then triangles of it
TESSELLATED = 100_000  # points of a mesh of a surface: as fine as most scans


def write_surface(path: AnyPath, surface: BSplineSurface, loops: Sequence[UV], *, unit: str = "mm") -> None:
    """Write a trimmed surface, or triangles of it, as the suffix says.

    Parameters
    ----------
    path
        With one of `SURFACE_SUFFIXES`.
    surface : BSplineSurface
    loops : sequence of (n, 2) arrays
        As `write_cad` takes them.
    unit : str
        That of the surface; files of triangles tell none.

    Examples
    --------
    >>> import numpy as np
    >>> from tempfile import TemporaryDirectory
    >>> from pointchart.cad import read_surface_json
    >>> knots, corners = np.array([0.0, 0, 1, 1]), np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> with TemporaryDirectory() as folder:
    ...     write_surface(f"{folder}/square.json", BSplineSurface(1, knots, knots, corners), [square], unit="cm")
    ...     surface, loops, unit = read_surface_json(f"{folder}/square.json")
    >>> surface.degree, len(loops), unit
    (1, 1, 'cm')
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix in CAD_SUFFIXES:
        write_cad(path, surface, loops, unit=unit, name=path.stem)
    elif suffix == ".json":
        write_surface_json(path, surface, loops, unit=unit)
    else:
        points, triangles, uv = tessellate(surface, loops, TESSELLATED)
        write_mesh(path, points, triangles, uv=uv)
