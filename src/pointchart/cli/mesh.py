"""``pointchart mesh``: from a scan to a certified disc."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options as given
from .progress import staged
from .words import Chart, Domain, Spacing, Swap

if TYPE_CHECKING:
    from ..typing import Indices
    from .inputs import Inputs

HOLD_STRETCH = (".ply", ".npz")


def mesh(
    context: typer.Context,
    scan: given.ScanArgument,
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="MESH", help="Mesh to write: ply, obj, off, stl, glb, npz.")
    ],
    boundary: given.BoundaryOption = None,
    outer: given.OuterOption = None,
    holes: given.HolesOption = None,
    component: given.ComponentOption = None,
    neighbors: given.NeighborsOption = None,
    k: given.KOption = None,
    radius: given.RadiusOption = None,
    weights: given.WeightsOption = None,
    domain: given.DomainOption = Domain.circle,
    corners: given.CornersOption = None,
    spacing: given.SpacingOption = Spacing.chord,
    swap: Annotated[
        Swap, typer.Option("--swap", help="Edge swaps in space: Delaunay, or on from there to edges along creases.")
    ] = Swap.delaunay,
    uv: Annotated[
        Chart,
        typer.Option(
            "--uv",
            help="Parameters: one-to-one on the mesh, with low stretch, with a free boundary, or the paper's own.",
        ),
    ] = Chart.mesh,
    threads: given.ThreadsOption = None,
    report: given.ReportOption = None,
    html: given.HtmlOption = None,
    quiet: given.QuietOption = False,
) -> None:
    """Mesh a scan of one surface patch: a triangle mesh on exactly its points, certified to be a disc, with uv."""
    from .._parallel import on_threads
    from ..errors import points_called
    from ..io import MESH_SUFFIXES, check_digits, write_mesh
    from ..look.page import lay_out, writing_page
    from ..mesh.distortion import vertex_stretches
    from ..pipeline import reconstruct
    from ..report import boundary_lines, certificate_lines, intersection_lines, run_report, summary, writing_json
    from .choices import CHARTS, GAPS, SWAPS, connect_rule, corner_names, layout_rule, outer_place, weights_rule
    from .inputs import read_inputs
    from .output import carried, given_options, page_words

    context.with_resource(on_threads(threads))
    connect, place = connect_rule(neighbors, k, radius), outer_place(outer, boundary)
    named = corner_names(domain, corners)
    inputs = read_inputs(
        scan, boundary, named, out=out, suffixes=MESH_SUFFIXES, report=report, html=html, component=component
    )
    check_digits(out, inputs.points)
    with staged(quiet) as clock, points_called(inputs.rows):
        result = reconstruct(
            inputs.points,
            inputs.loop,
            outer=place,
            gaps=None if holes is None else GAPS[holes],
            connect=connect,
            weights=weights_rule(weights, neighbors),
            swap=SWAPS[swap],
            layout=layout_rule(domain, spacing, inputs.corners),
            chart=CHARTS[uv],
            clock=clock,
        )
        rows = inputs.rows[result.rows]
        points, is_given = inputs.scan.points[rows], boundary is not None
        options = given_options(context)
        run = run_report(inputs.scan.points, inputs.rows, result, clock, options, boundary_given=is_given)
        page = None
        if html is not None:
            with clock("page"):
                page = lay_out(points, result, run, **page_words(scan, out))
    attributes = carried(inputs, rows)
    if out.suffix.lower() in HOLD_STRETCH:
        attributes |= {"stretch": vertex_stretches(points, result.triangles, result.uv)}
    with writing_json(report, run), writing_page(html, page):
        notes = write_mesh(out, points, result.triangles, uv=result.uv, attributes=attributes)
    if not quiet:
        lines = certificate_lines(result.certificate) + boundary_lines(result, points, found=boundary is None)
        lines += intersection_lines(run) + _rows_left(inputs, rows) + notes
        lines += [f"{out}: {summary(result.certificate)}"] + ([f"{html}: {page.size_line}"] if page else [])
        print("\n".join(lines), file=sys.stderr)


def _rows_left(inputs: Inputs, rows: Indices) -> list[str]:
    repeated, outside = len(inputs.rows) - len(rows), len(inputs.scan.points) - len(inputs.rows)
    lines = [f"{outside} points in other parts left out"] if outside else []
    lines += [f"{repeated} repeated points merged to the first"] if repeated else []
    return [f"{', '.join(lines)}; point_index gives each vertex's row"] if lines else []
