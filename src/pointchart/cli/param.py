"""``pointchart param``: the paper's parameters of a scan."""

import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from . import options as given
from .progress import staged
from ..runs.option_values import Domain, Spacing


def param(
    context: typer.Context,
    scan: given.ScanArgument,
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="UV", help="Parameters to write: csv, txt, xyz, npy, npz, ply.")
    ],
    boundary: given.BoundaryOption = None,
    outer: given.OuterOption = None,
    neighbors: given.NeighborsOption = None,
    k: given.KOption = None,
    radius: given.RadiusOption = None,
    weights: given.WeightsOption = None,
    domain: given.DomainOption = Domain.circle,
    corners: given.CornersOption = None,
    spacing: given.SpacingOption = Spacing.chord,
    threads: given.ThreadsOption = None,
    report: given.ReportOption = None,
    quiet: given.QuietOption = False,
) -> None:
    """Give every point of a scan planar parameters by the paper's method, without a mesh; row i is point i."""
    from .._parallel import on_threads
    from ..io import UV_SUFFIXES, write_uv
    from ..mesh.planar_delaunay import coinciding
    from ..pipeline import parameterize_scan
    from ..report import solve_report, stages_report, writing_json
    from .choices import connect_rule, corner_names, layout_rule, outer_place, weights_rule
    from .inputs import read_inputs
    from .output import carried, given_options

    context.with_resource(on_threads(threads))
    connect, place = connect_rule(neighbors, k, radius), outer_place(outer, boundary)
    named = corner_names(domain, corners)
    inputs = read_inputs(scan, boundary, named, out=out, suffixes=UV_SUFFIXES, report=report)
    with staged(quiet) as clock:
        survey, mapped = parameterize_scan(
            inputs.points,
            inputs.loop,
            outer=place,
            connect=connect,
            weights=weights_rule(weights, neighbors),
            layout=layout_rule(domain, spacing, inputs.corners),
            clock=clock,
        )
    uv = mapped.uv[survey.cloud.places]
    doubled = len(coinciding(mapped.uv))
    run: dict[str, Any] = {"options": given_options(context), "stages": stages_report(clock)}
    run |= {"solve": solve_report(mapped.solution), "coinciding_uv": doubled}
    with writing_json(report, run):
        notes = write_uv(out, uv, points=inputs.points, attributes=carried(inputs, inputs.rows))
    if not quiet:
        print("\n".join(notes), end="\n" if notes else "", file=sys.stderr)
        solution = mapped.solution
        print(
            f"{out}: parameters of {len(uv)} points, {doubled} of which coincide; {solution.unknowns} unknowns, "
            f"{solution.method} solver, residual {solution.residual:.1e}",
            file=sys.stderr,
        )
