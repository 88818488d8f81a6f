"""``pointchart boundary``: find and order the boundary of a scan."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from ..io import check_output, read_scan, write_loop
from ..survey import survey_scan
from . import options as given
from .progress import staged


def boundary(
    scan: given.ScanArgument,
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="LOOP.txt", help="Loop to write: one 0-based point index a line.")
    ],
    quiet: given.QuietOption = False,
) -> None:
    """Find the boundary of a scan and write its points in order; the file can be edited and given back to mesh."""
    check_output(out, suffixes=(".txt",), inputs=[scan])
    read = read_scan(scan)
    with staged(quiet) as clock:
        survey = survey_scan(read.points, clock=clock)
    write_loop(out, survey.cloud.rows[survey.loop])
    if not quiet:
        chosen, *others = survey.found.candidates
        lines = [
            f"{out}: a loop of {len(chosen.loop)} points, {chosen.length * survey.cloud.scale:.4g} long, "
            f"{chosen.share:.0%} of it beside an angular gap"
        ]
        lines += [
            f"another loop of {len(other.loop)} points, {other.length * survey.cloud.scale:.4g} long, at point "
            f"{survey.cloud.rows[other.loop[0]]}: taken for a gap of the scan"
            for other in others
        ]
        print("\n".join(lines), file=sys.stderr)
