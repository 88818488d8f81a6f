"""``pointchart boundary``: find and order the boundary of a scan."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options as given
from .progress import staged

if TYPE_CHECKING:
    from ..boundary import BoundaryScores, Candidate
    from ..boundary.bounded import Survey
    from ..typing import Attributes, Indices, Loop


def boundary(
    context: typer.Context,
    scan: given.ScanArgument,
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="LOOP.txt", help="Loop to write: one 0-based point index a line.")
    ],
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw the cloud, its scores and the loops: png, svg, pdf."),
    ] = None,
    ply: Annotated[
        Path | None,
        typer.Option("--ply", metavar="PLY", help="Write the loops as polylines and the scores as vertex properties."),
    ] = None,
    outer: given.OuterOption = None,
    component: given.ComponentOption = None,
    threads: given.ThreadsOption = None,
    quiet: given.QuietOption = False,
) -> None:
    """Find the boundary of a scan and write its points in order; the file can be edited and given back to mesh."""
    from .._parallel import on_threads
    from ..boundary.bounded import survey_scan
    from ..errors import points_called
    from ..io import check_output, replacing, write_curves, write_loop
    from ..look.paint import PICTURE_SUFFIXES
    from ..look.run_pictures import draw_boundary
    from .choices import outer_place
    from .inputs import read_inputs

    context.with_resource(on_threads(threads))
    place = outer_place(outer)
    taken = [scan, out]
    for path, suffixes in ((picture, PICTURE_SUFFIXES), (ply, (".ply",))):
        if path is not None:
            check_output(path, suffixes=suffixes, inputs=taken)
            taken.append(path)
    inputs = read_inputs(scan, None, None, out=out, suffixes=(".txt",), component=component)
    with staged(quiet) as clock, points_called(inputs.rows):
        survey = survey_scan(inputs.points, outer=place, clock=clock)
    rows, scores = inputs.rows[survey.cloud.rows], survey.score()
    loops = [rows[candidate.loop] for candidate in survey.candidates]
    notes = []
    with ExitStack() as stack:
        # Each file is in its place only when all of them are written.
        if ply is not None:
            file = stack.enter_context(replacing(ply))
            attributes = _columns(loops, scores, inputs.rows, survey.cloud.places, len(inputs.scan.points))
            notes = write_curves(file, inputs.scan.points, loops, attributes=inputs.scan.attributes | attributes)
        if picture is not None:
            file = stack.enter_context(replacing(picture))
            draw_boundary(file, survey.points, scores.total, [candidate.loop for candidate in survey.candidates])
        write_loop(out, loops[0])
    if not quiet:
        print("\n".join([*_lines(out, survey, loops), *notes]), file=sys.stderr)


def _columns(loops: list[Loop], scores: BoundaryScores, rows: Indices, places: Indices, n_points: int) -> Attributes:
    """Give every row of a scan the number of its loop, 0 for none, and its scores, 0 for rows not looked at."""
    import numpy as np

    number = np.zeros(n_points, np.int32)
    for k, loop in reversed(list(enumerate(loops, start=1))):
        number[loop] = k
    columns: Attributes = {"loop": number}
    for name in ("total", "gap", "half_disc", "width", "uncovered"):
        columns[f"score_{name}"] = np.zeros(n_points)
        columns[f"score_{name}"][rows] = getattr(scores, name)[places]
    return columns


def _lines(out: Path, survey: Survey, loops: list[Loop]) -> list[str]:
    from ..gaps.rules import place_of

    chosen, *others = survey.candidates
    lines = [
        f"{out}: a loop of {_size(chosen, survey)}, {chosen.share:.0%} of it where the scores speak for a boundary"
    ]
    for other, loop in zip(others, loops[1:], strict=True):
        place = place_of(survey.points, other.loop[0])
        lines.append(f"another loop of {_size(other, survey)}, {other.share:.0%}, through point {loop[0]} at {place}")
    return lines


def _size(candidate: Candidate, survey: Survey) -> str:
    return f"{len(candidate.loop)} points, {candidate.length * survey.cloud.scale:.4g} long"
