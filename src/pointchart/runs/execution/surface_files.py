"""The files of a fit: the surface, its deviations and its pictures."""

from contextlib import ExitStack
from pathlib import Path

import numpy as np

from ...cad import CAD_SUFFIXES, write_cad, write_surface_json
from ...io import replacing, write_mesh, write_uv
from ...look.surface_pictures import draw_deviation, draw_reflections
from ...surface import tessellate
from ...surface.surfacing import SurfacedScan
from ..fit_run import FitRun
from ..inputs import Inputs
from ..option_values import Unit
from .written import carried

TESSELLATED = 100_000  # points of the mesh of a surface
HOLD_DEVIATIONS = (".csv", ".ply", ".npz")  # formats that hold any number a point


def write_surface(out: Path, surfaced: SurfacedScan, unit: Unit) -> None:
    """Write the surface, or triangles of it, as the suffix says."""
    surface, loops, suffix = surfaced.fit.surface, surfaced.loops, out.suffix.lower()
    if suffix in CAD_SUFFIXES:
        write_cad(out, surface, loops, unit=unit, name=out.stem)
    elif suffix == ".json":
        write_surface_json(out, surface, loops, unit=unit)
    else:
        points, triangles, uv = tessellate(surface, loops, TESSELLATED)
        write_mesh(out, points, triangles, uv=uv)


def write_beside(run: FitRun, inputs: Inputs, surfaced: SurfacedScan, allowed: float, stack: ExitStack) -> None:
    """Write the deviations and pictures asked for; each is in its place only when the stack has ended well."""
    files, unit, share = run.files, run.surface.unit, run.surface.share()
    shown = surfaced.fit.surface, surfaced.loops
    if files.deviations is not None:
        _write_deviations(stack.enter_context(replacing(files.deviations)), surfaced, inputs)
    if files.picture is not None:
        file = stack.enter_context(replacing(files.picture))
        points = inputs.scan.points[inputs.rows[surfaced.reconstruction.rows]]
        draw_deviation(file, *shown, points, surfaced.deviation, allowed, unit=unit, outliers=share)
    if files.reflections is not None:
        draw_reflections(stack.enter_context(replacing(files.reflections)), *shown, unit=unit)


def _write_deviations(path: Path, surfaced: SurfacedScan, inputs: Inputs) -> None:
    rows, uv, signed = inputs.rows[surfaced.reconstruction.rows], surfaced.fit.uv, surfaced.deviation.signed
    points = inputs.scan.points[rows]
    if path.suffix.lower() == ".csv":
        table = np.column_stack([points, uv, signed])
        np.savetxt(path, table, fmt="%.17g", delimiter=",", header="x,y,z,u,v,deviation", comments="")
    else:
        write_uv(path, uv, points=points, attributes=carried(inputs, rows) | {"deviation": signed})
