"""A boundary run: read, find, write."""

from contextlib import ExitStack

import numpy as np

from ..._parallel import on_threads
from ...boundary import BoundaryScores, Candidate
from ...boundary.bounded import Survey, survey_scan
from ...clock import StageClock
from ...errors import points_called
from ...io import replacing, write_curves, write_loop
from ...look.paint import PICTURE_SUFFIXES
from ...look.run_pictures import draw_boundary
from ...points.places import place_of
from ...report.record import Note, RunReport
from ...typing import Attributes, Loop
from ..boundary_run import BoundaryRun
from ..choices import outer_place
from ..inputs import Inputs, check_outputs, read_inputs
from .written import stages_of, untold


def execute(run: BoundaryRun, clock: StageClock) -> RunReport:
    """Execute a boundary run."""
    with on_threads(run.running.threads):
        place = outer_place(run.outer)
        outputs = ((run.out, (".txt",)), (run.picture, PICTURE_SUFFIXES), (run.ply, (".ply",)))
        check_outputs(outputs, [run.source.scan])
        inputs = read_inputs(run.source)
        with points_called(inputs.rows):
            survey = survey_scan(inputs.points, outer=place, clock=clock)
        loops = [inputs.rows[survey.cloud.rows][candidate.loop] for candidate in survey.candidates]
        said = _write(run, inputs, survey, loops)
    notes = (*inputs.notes, *_notes(run, survey, loops), *map(Note, said))
    files = tuple(untold(out=run.out, picture=run.picture, ply=run.ply))
    return RunReport(run.command, notes=notes, stages=stages_of(clock), files=files)


def _write(run: BoundaryRun, inputs: Inputs, survey: Survey, loops: list[Loop]) -> list[str]:
    """Write the loop, the polylines and the picture, each in its place only when all are written; say what was lost."""
    scores, said = survey.score(), []
    with ExitStack() as stack:
        if run.ply is not None:
            file = stack.enter_context(replacing(run.ply))
            attributes = inputs.scan.attributes | _columns(inputs, survey, scores, loops)
            said = write_curves(file, inputs.scan.points, loops, attributes=attributes)
        if run.picture is not None:
            file = stack.enter_context(replacing(run.picture))
            draw_boundary(file, survey.points, scores.total, [candidate.loop for candidate in survey.candidates])
        write_loop(run.out, loops[0])
    return said


def _columns(inputs: Inputs, survey: Survey, scores: BoundaryScores, loops: list[Loop]) -> Attributes:
    """Give every row of a scan the number of its loop, 0 for none, and its scores, 0 for rows not looked at."""
    n_points = len(inputs.scan.points)
    number = np.zeros(n_points, np.int32)
    for k, loop in reversed(list(enumerate(loops, start=1))):
        number[loop] = k
    columns: Attributes = {"loop": number}
    for name in ("total", "gap", "half_disc", "width", "uncovered"):
        columns[f"score_{name}"] = np.zeros(n_points)
        columns[f"score_{name}"][inputs.rows] = getattr(scores, name)[survey.cloud.places]
    return columns


def _notes(run: BoundaryRun, survey: Survey, loops: list[Loop]) -> list[Note]:
    chosen, *others = survey.candidates
    where = "of it where the scores speak for a boundary"
    notes = [Note(f"{run.out}: a loop of {_size(chosen, survey)}, {chosen.share:.0%} {where}")]
    for other, loop in zip(others, loops[1:], strict=True):
        place = f"through point {loop[0]} at {place_of(survey.points, other.loop[0])}"
        text = f"another loop of {_size(other, survey)}, {other.share:.0%}, {place}"
        notes.append(Note(text, is_minor=True, size=other.length))
    return notes


def _size(candidate: Candidate, survey: Survey) -> str:
    return f"{len(candidate.loop)} points, {candidate.length * survey.cloud.scale:.4g} long"
