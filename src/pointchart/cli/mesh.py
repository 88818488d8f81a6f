"""``pointchart mesh``: from a scan to a certified disc."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from ..io import MESH_SUFFIXES, write_mesh
from ..pipeline import Reconstruction, reconstruct
from ..report import certificate_lines, run_report, summary, write_json
from . import options as given
from .choices import CHARTS, SWAPS, Chart, Domain, Spacing, Swap, connect_rule, layout_rule, weights_rule
from .inputs import read_inputs
from .output import carried, given_options
from .progress import staged


def mesh(
    context: typer.Context,
    scan: given.ScanArgument,
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="MESH", help="Mesh to write: ply, obj, off, stl, glb, npz.")
    ],
    boundary: given.BoundaryOption = None,
    neighbors: given.NeighborsOption = None,
    k: given.KOption = None,
    radius: given.RadiusOption = None,
    weights: given.WeightsOption = None,
    domain: given.DomainOption = Domain.circle,
    corners: given.CornersOption = None,
    spacing: given.SpacingOption = Spacing.chord,
    swap: Annotated[Swap, typer.Option("--swap", help="Edge swaps in space after the triangulation.")] = Swap.delaunay,
    uv: Annotated[
        Chart, typer.Option("--uv", help="Parameters: mesh, one-to-one, or the paper's own, which may fold.")
    ] = Chart.mesh,
    report: given.ReportOption = None,
    quiet: given.QuietOption = False,
) -> None:
    """Mesh a scan of one surface patch: a triangle mesh on exactly its points, certified to be a disc, with uv."""
    connect, layout = connect_rule(neighbors, k, radius), layout_rule(domain, spacing, corners)
    read, loop = read_inputs(scan, boundary, out=out, suffixes=MESH_SUFFIXES, report=report)
    with staged(quiet) as clock:
        result = reconstruct(
            read.points,
            loop,
            connect=connect,
            weights=weights_rule(weights, neighbors),
            swap=SWAPS[swap],
            layout=layout,
            chart=CHARTS[uv],
            clock=clock,
        )
    if report is not None:
        run = run_report(read.points, result, clock, given_options(context), boundary_given=boundary is not None)
        write_json(report, run)
    points, attributes = read.points[result.rows], carried(read, result.rows)
    notes = write_mesh(out, points, result.triangles, uv=result.uv, attributes=attributes)
    if not quiet:
        _say(out, len(read.points), result, notes, boundary is None)


def _say(out: Path, n_read: int, result: Reconstruction, notes: list[str], found: bool) -> None:
    lines = certificate_lines(result.certificate)
    lines.append(f"boundary of {len(result.loop)} points, {'found' if found else 'as given'}")
    gaps = result.evidence.bridges
    if gaps:
        lines.append(f"{len(gaps)} gaps of the scan bridged, the largest {len(gaps[0].points)} points round")
    if n_read > len(result.rows):
        lines.append(
            f"{n_read - len(result.rows)} repeated points merged to the first; point_index gives each vertex's row"
        )
    lines += [*notes, f"{out}: {summary(result.certificate)}"]
    print("\n".join(lines), file=sys.stderr)
