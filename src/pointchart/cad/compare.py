"""What was written, held against what was to be written."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import FormatError
from ..io.source import AnyPath
from ..plane.polygons import signed_area
from ..surface import BSplineSurface, evaluate
from ..typing import UV
from .make_face import size_of
from .occ import occ
from .read_face import SAMPLES, split
from .surface_checks import is_inside
from .trims import Edge

DEVIATION = 1e-6  # of the size, and of the area of the domain
_GRID = 32  # places in each direction: a choice, since what a format gets wrong, its digits, is wrong everywhere


def is_valid(face: Any) -> bool:
    """Tell whether Open CASCADE finds nothing wrong with a face."""
    return bool(occ("BRepCheck").BRepCheck_Analyzer(face).IsValid())


def check_written(path: AnyPath, face: Any, surface: BSplineSurface, loops: Sequence[Sequence[Edge]]) -> None:
    """Hold a face that was read back against its surface, in millimetres, and its trim curves.

    Raises
    ------
    FormatError
        It is not valid, or has other loops, or deviates by more than `DEVIATION`.
    """
    if not is_valid(face):
        raise FormatError(f"{path}: the face is not valid when it is read back; choose another format")
    found, found_loops = split(face)
    outlines = [_outline(edges) for edges in loops]
    if len(found_loops) != len(outlines):
        raise FormatError(f"{path}: {len(found_loops)} of {len(outlines)} loops come back; choose another format")
    area = float(np.prod(surface.domain[1] - surface.domain[0]))
    before, after = (np.sort([signed_area(loop) for loop in either]) for either in (outlines, found_loops))
    change = float(np.abs(after - before).max()) / area
    if change > DEVIATION:
        raise FormatError(f"{path}: a loop comes back with {change:.1e} of the domain more or less; use another format")
    uv = _grid(outlines)
    gap = float(np.linalg.norm(evaluate(found, uv) - evaluate(surface, uv), axis=1).max()) / size_of(surface)
    if not gap <= DEVIATION:
        raise FormatError(
            f"{path}: the surface comes back {gap:.1e} of its size away, as the format holds too few digits; "
            "use STEP, or move the scan to the origin"
        )


def _outline(edges: Sequence[Edge]) -> UV:
    """Return a polygon along the edges, with the points that `split` takes."""
    runs = []
    for edge in edges:
        at = np.unique(edge.curve.t)
        fine = at[:1] if edge.curve.k == 1 else np.linspace(at[:-1], at[1:], SAMPLES, endpoint=False, axis=1).ravel()
        runs.append(edge.curve(fine))
    return np.concatenate(runs)


def _grid(outlines: Sequence[UV]) -> UV:
    """Return places inside, on a grid over the box of the outer loop, and the vertices of the loops."""
    low, high = outlines[0].min(axis=0), outlines[0].max(axis=0)
    ticks = np.linspace(low, high, _GRID).T
    grid = np.stack(np.meshgrid(*ticks), axis=-1).reshape(-1, 2)
    return np.concatenate([grid[is_inside(outlines, grid)], *outlines])
