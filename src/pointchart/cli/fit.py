"""``pointchart fit``: from a scan to a smooth surface that CAD reads."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options as given
from .progress import staged
from .words import Domain, Holes, Spacing, SurfaceDomain, Unit

if TYPE_CHECKING:
    from ..surface.surfacing import SurfacedScan
    from ..typing import Points
    from .inputs import Inputs

TESSELLATED = 100_000  # points of the mesh of a surface
HOLD_DEVIATIONS = (".csv", ".ply", ".npz")


def fit(
    context: typer.Context,
    scan: given.ScanArgument,
    out: Annotated[
        Path,
        typer.Option(
            "--out",
            "-o",
            metavar="SURFACE",
            help="Surface to write: step, iges, brep (extra cad), json; or its triangles: ply, obj, stl, glb, ...",
        ),
    ],
    tolerance: Annotated[
        str,
        typer.Option(
            "--tolerance", help="Largest deviation, in the unit of the scan, such as 0.05, or in % of its diagonal."
        ),
    ] = "0.1%",
    outliers: Annotated[
        str, typer.Option("--outliers", help="Share of the points that may deviate by more, such as 0.005 or 0.5%.")
    ] = "0.5%",
    max_control_points: Annotated[
        int | None,
        typer.Option(
            "--max-control-points", min=1, help="At most so many, and as many as points; by default half as many."
        ),
    ] = None,
    degree: Annotated[int, typer.Option("--degree", min=2, max=5, help="Of the surface, in both directions.")] = 3,
    fairness: Annotated[
        str,
        typer.Option(
            "--fairness", help="Weight of the thin plate energy, such as 1e-5; auto: chosen by points left out."
        ),
    ] = "auto",
    robust: Annotated[bool, typer.Option("--robust", help="Give points far off less weight (Huber).")] = False,
    unit: Annotated[Unit, typer.Option("--unit", help="Unit of the scan, for STEP, IGES and JSON.")] = Unit.mm,
    domain: Annotated[
        SurfaceDomain,
        typer.Option(
            "--domain", help="Of the parameters: with a free boundary, trimmed; or square, a four-sided patch."
        ),
    ] = SurfaceDomain.free,
    corners: given.CornersOption = None,
    best_effort: Annotated[
        bool,
        typer.Option("--best-effort", help="Where the tolerance is not met, write the best surface, and exit with 0."),
    ] = False,
    boundary: given.BoundaryOption = None,
    outer: given.OuterOption = None,
    holes: Annotated[
        Holes | None,
        typer.Option(
            "--holes",
            help="Bridge all gaps of the scan, or cut them out; by default cut out unless one may be the boundary.",
        ),
    ] = None,
    component: given.ComponentOption = None,
    deviations: Annotated[
        Path | None,
        typer.Option(
            "--deviations",
            metavar="FILE",
            help="Write x, y, z, u, v and signed deviation of each point: csv, ply, npz.",
        ),
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw the deviation map and its histogram: png, svg, pdf."),
    ] = None,
    reflections: Annotated[
        Path | None,
        typer.Option("--reflections", metavar="FILE", help="Draw reflection lines and curvature: png, svg, pdf."),
    ] = None,
    explain: Annotated[bool, typer.Option("--explain", help="Say which choices were made and why.")] = False,
    threads: given.ThreadsOption = None,
    report: given.ReportOption = None,
    html: given.HtmlOption = None,
    quiet: given.QuietOption = False,
) -> None:
    """Fit a trimmed B-spline surface to a scan of one surface patch, to a tolerance, for CAD."""
    from .._parallel import on_threads
    from ..cad import CAD_SUFFIXES
    from ..cad.occ import check_extra
    from ..errors import points_called
    from ..io import MESH_SUFFIXES, check_output, replacing
    from ..look.page import PAGE_SUFFIXES, lay_out, writing_page
    from ..look.paint import PICTURE_SUFFIXES
    from ..look.surface_pictures import draw_deviation, draw_reflections
    from ..report import boundary_lines, intersection_lines, run_report, writing_json
    from ..surface import huber, squares
    from ..surface.surfacing import fit_scan
    from ..surface_report import explain_lines, surface_lines, surface_report
    from .choices import GAPS, amount, corner_names, fairness_weight, layout_rule, outer_place
    from .inputs import read_inputs
    from .output import given_options, page_words

    context.with_resource(on_threads(threads))
    allowed_of, place = amount("--tolerance", tolerance, positive=True), outer_place(outer, boundary)
    share, fair = amount("--outliers", outliers, below=1.0)(1.0), fairness_weight(fairness)
    named = corner_names(domain, corners)
    beside = [
        (deviations, HOLD_DEVIATIONS),
        (picture, PICTURE_SUFFIXES),
        (reflections, PICTURE_SUFFIXES),
        (report, (".json",)),
        (html, PAGE_SUFFIXES),
    ]
    taken = [scan, out, *([boundary] if boundary else [])]
    for path, suffixes in beside:
        if path is not None:
            taken.append(check_output(path, suffixes=suffixes, inputs=taken))
    if out.suffix.lower() in CAD_SUFFIXES:
        check_extra(out)
    inputs = read_inputs(
        scan, boundary, named, out=out, suffixes=(*CAD_SUFFIXES, ".json", *MESH_SUFFIXES), component=component
    )
    allowed = allowed_of(_diagonal(inputs.points))
    with staged(quiet) as clock, points_called(inputs.rows):
        surfaced = fit_scan(
            inputs.points,
            inputs.loop,
            tolerance=allowed,
            outliers=share,
            max_control=max_control_points,
            degree=degree,
            fairness=fair,
            loss=huber if robust else squares,
            outer=place,
            gaps=None if holes is None else GAPS[holes],
            square=layout_rule(Domain.square, Spacing.chord, inputs.corners)
            if domain is SurfaceDomain.square
            else None,
            clock=clock,
        )
    if explain and not quiet:
        print("\n".join(explain_lines(surfaced)), file=sys.stderr)
    if not best_effort:
        _check_met(surfaced, allowed, share)
    rows = inputs.rows[surfaced.reconstruction.rows]
    points = inputs.scan.points[rows]
    is_given = boundary is not None
    run = run_report(
        inputs.scan.points, inputs.rows, surfaced.reconstruction, clock, given_options(context), boundary_given=is_given
    )
    run["surface"] = surface_report(surfaced, points, allowed, share, unit)
    page = None  # over the parameters of the surface, which the fit has corrected
    if html is not None:
        made, off = replace(surfaced.reconstruction, uv=surfaced.fit.uv), surfaced.deviation.signed
        page = lay_out(points, made, run, deviation=off, **page_words(scan, out))
    shown = surfaced.fit.surface, surfaced.loops
    with ExitStack() as stack, writing_json(report, run), writing_page(html, page):
        # Each file is in its place only when all of them are written.
        if deviations is not None:
            _write_deviations(stack.enter_context(replacing(deviations)), surfaced, inputs)
        if picture is not None:
            file = stack.enter_context(replacing(picture))
            draw_deviation(file, *shown, points, surfaced.deviation, allowed, unit=unit, outliers=share)
        if reflections is not None:
            draw_reflections(stack.enter_context(replacing(reflections)), *shown, unit=unit)
        _write_surface(out, surfaced, unit)
    if not quiet:
        lines = boundary_lines(surfaced.reconstruction, points, found=not is_given) + intersection_lines(run)
        lines += [*surface_lines(surfaced, allowed, share, unit), str(out)]
        print("\n".join(lines + ([f"{html}: {page.size_line}"] if page else [])), file=sys.stderr)


def _diagonal(points: Points) -> float:
    """Return the diagonal of the box around points; what is not finite in them is named later."""
    import numpy as np

    with np.errstate(invalid="ignore", over="ignore"):
        return float(np.hypot.reduce(np.ptp(points, axis=0)))


def _check_met(surfaced: SurfacedScan, tolerance: float, outliers: float) -> None:
    """Check that the tolerance is met, naming the options that help where it is not."""
    from ..errors import SolveError
    from ..surface.surfacing import check_met

    try:
        check_met(surfaced, tolerance, outliers)
    except SolveError as unmet:
        more = "" if surfaced.fit.is_noise else "--max-control-points, "
        raise SolveError(f"{unmet} ({more}--tolerance, --best-effort)") from None


def _write_deviations(path: Path, surfaced: SurfacedScan, inputs: Inputs) -> None:
    import numpy as np

    from ..io import write_uv
    from .output import carried

    rows, uv, signed = inputs.rows[surfaced.reconstruction.rows], surfaced.fit.uv, surfaced.deviation.signed
    points = inputs.scan.points[rows]
    if path.suffix.lower() == ".csv":
        table = np.column_stack([points, uv, signed])
        np.savetxt(path, table, fmt="%.17g", delimiter=",", header="x,y,z,u,v,deviation", comments="")
    else:
        write_uv(path, uv, points=points, attributes=carried(inputs, rows) | {"deviation": signed})


def _write_surface(out: Path, surfaced: SurfacedScan, unit: Unit) -> None:
    from ..cad import CAD_SUFFIXES, write_cad, write_surface_json
    from ..io import write_mesh
    from ..surface import tessellate

    surface, loops, suffix = surfaced.fit.surface, surfaced.loops, out.suffix.lower()
    if suffix in CAD_SUFFIXES:
        write_cad(out, surface, loops, unit=unit, name=out.stem)
    elif suffix == ".json":
        write_surface_json(out, surface, loops, unit=unit)
    else:
        points, triangles, uv = tessellate(surface, loops, TESSELLATED)
        write_mesh(out, points, triangles, uv=uv)
