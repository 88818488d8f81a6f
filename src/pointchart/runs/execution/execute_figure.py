"""A figure run: read, draw."""

from typing import Any

from numpy.typing import NDArray

from ...cad import read_surface_json
from ...clock import StageClock
from ...errors import InputError
from ...io import Scan, read_scan
from ...look.figures import (
    Sheet,
    draw_cloud,
    draw_deviation_map,
    draw_mesh,
    draw_plane,
    draw_zebra,
)
from ...look.paint import PICTURE_SUFFIXES
from ...mesh.distortion import vertex_stretches
from ...report.record import RunReport, WrittenFile
from ..figure_run import OF_SURFACES, ON_MESHES, FigureRun
from ..inputs import check_outputs
from ..option_values import Figure
from .written import stages_of


def execute(run: FigureRun, clock: StageClock) -> RunReport:
    """Execute a figure run."""
    run.check()
    look: dict[str, Any] = {} if run.kind is Figure.plane else {"view": run.look.angles(), "up": run.look.up}
    check_outputs(((run.out, PICTURE_SUFFIXES),), [run.source, run.points])
    look["sheet"] = Sheet(run.sheet.width, run.sheet.dpi, run.sheet.transparent)
    if run.kind in OF_SURFACES:
        _draw_surface(run, look)
    else:
        _draw_scan(run, look if run.kind is Figure.cloud else look | {"edges": run.look.edges})
    return RunReport(run.command, stages=stages_of(clock), files=(WrittenFile(run.out, "out"),))


def _draw_surface(run: FigureRun, look: dict[str, Any]) -> None:
    surface, loops, unit = read_surface_json(run.source)
    if run.points is None:
        draw_zebra(run.out, surface, loops, **look)
    else:
        points, limit = read_scan(run.points).points, run.look.limit
        draw_deviation_map(run.out, surface, loops, points, limit=limit, unit=unit, **look)


def _draw_scan(run: FigureRun, look: dict[str, Any]) -> None:
    source, read = run.source, read_scan(run.source)
    if run.kind in ON_MESHES and len(read.triangles) == 0:
        raise InputError(
            f"{source}: the file has {len(read.points)} points and no triangles; mesh it, or draw its cloud"
        )
    if run.look.color is not None:
        look = look | {"values": _values(run, read, run.look.color), "label": run.look.color}
    if run.kind is Figure.cloud:
        draw_cloud(run.out, read.points, **look)
    elif run.kind is Figure.mesh:
        draw_mesh(run.out, read.points, read.triangles, **look)
    elif (uv := read.uv) is None:
        raise InputError(f"{source}: its {len(read.points)} points have no u and v; give a mesh that mesh wrote as PLY")
    else:
        draw_plane(run.out, uv, read.triangles, **look)


def _values(run: FigureRun, read: Scan, name: str) -> NDArray[Any]:
    """Return what a file has for each point by a name; stretch is measured where it is not in the file."""
    if name in read.attributes:
        return read.attributes[name]
    uv = read.uv
    if name == "stretch" and uv is not None and len(read.triangles):
        return vertex_stretches(read.points, read.triangles, uv)
    known = ", ".join(read.attributes) or "nothing"
    raise InputError(
        f"{run.source}: there is no '{name}' for its {len(read.points)} points, only {known}; name one of these"
    )
