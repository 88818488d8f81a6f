"""``pointchart param``: the paper's parameters of a scan."""

import sys
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from ..io import UV_SUFFIXES, check_output, read_loop, read_scan, write_uv
from ..pipeline import parameterize_scan
from ..report import solve_report, write_json
from ..triangulate import coinciding
from . import options as given
from .choices import Domain, Spacing, connect_rule, layout_rule, weights_rule
from .output import carried, given_options
from .progress import staged


def param(
    context: typer.Context,
    scan: given.ScanArgument,
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="UV", help="Parameters to write: csv, txt, xyz, npy, npz, ply.")
    ],
    boundary: given.BoundaryOption = None,
    neighbors: given.NeighborsOption = None,
    k: given.KOption = None,
    radius: given.RadiusOption = None,
    weights: given.WeightsOption = None,
    domain: given.DomainOption = Domain.circle,
    corners: given.CornersOption = None,
    spacing: given.SpacingOption = Spacing.chord,
    report: given.ReportOption = None,
    quiet: given.QuietOption = False,
) -> None:
    """Give every point of a scan planar parameters by the paper's method, without a mesh; row i is point i."""
    inputs = [scan] if boundary is None else [scan, boundary]
    check_output(out, suffixes=UV_SUFFIXES, inputs=inputs)
    if report is not None:
        check_output(report, suffixes=(".json",), inputs=[*inputs, out])
    connect, layout = connect_rule(neighbors, k, radius), layout_rule(domain, spacing, corners)
    read = read_scan(scan)
    loop = None if boundary is None else read_loop(boundary)
    with staged(quiet) as clock:
        survey, mapped = parameterize_scan(
            read.points,
            loop,
            connect=connect,
            weights=weights_rule(weights, neighbors),
            layout=layout,
            clock=clock,
        )
    uv = mapped.uv[survey.cloud.places]
    notes = write_uv(out, uv, points=read.points, attributes=carried(read, np.arange(len(uv))))
    doubled = len(coinciding(mapped.uv))
    if report is not None:
        stages = [{"name": name, "seconds": round(seconds, 4)} for name, seconds in clock.seconds.items()]
        solved = solve_report(mapped.solution)
        write_json(
            report, {"options": given_options(context), "stages": stages, "solve": solved, "coinciding_uv": doubled}
        )
    if not quiet:
        print("\n".join(notes), end="\n" if notes else "", file=sys.stderr)
        solution = mapped.solution
        print(
            f"{out}: parameters of {len(uv)} points, {doubled} of which coincide; {solution.unknowns} unknowns, "
            f"{solution.method} solver, residual {solution.residual:.1e}",
            file=sys.stderr,
        )
