"""A param run: read, map, write."""

from dataclasses import replace

from ..._parallel import on_threads
from ...clock import StageClock
from ...errors import points_called
from ...io import UV_SUFFIXES, write_uv
from ...map.convex_combination import Parameterization
from ...map.scan_parameters import parameterize_scan
from ...mesh.planar_delaunay import coinciding
from ...report.as_json import writing_json
from ...report.mesh_facts import solve_facts
from ...report.record import Note, RunReport, WrittenFile
from ...typing import UV
from ..inputs import Inputs, check_outputs, read_inputs
from ..param_run import ParamRun
from .written import carried, options_facts, stages_of, untold


def execute(run: ParamRun, clock: StageClock) -> RunReport:
    """Execute a param run."""
    with on_threads(run.running.threads):
        inputs, uv, mapped = _mapped(run, clock)
        solution, n_doubled = mapped.solution, len(coinciding(mapped.uv))
        facts = {"options": options_facts(run), "solve": solve_facts(solution), "coinciding_uv": n_doubled}
        report = RunReport(run.command, stages=stages_of(clock), facts=facts)
        with writing_json(run.report, report):
            said = write_uv(run.out, uv, points=inputs.points, attributes=carried(inputs, inputs.rows))
    holds = (
        f"parameters of {len(uv)} points, {n_doubled} of which coincide; {solution.unknowns} unknowns, "
        f"{solution.method} solver, residual {solution.residual:.1e}"
    )
    files = (WrittenFile(run.out, "out", holds), *untold(report=run.report))
    return replace(report, notes=(*inputs.notes, *map(Note, said)), files=files)


def _mapped(run: ParamRun, clock: StageClock) -> tuple[Inputs, UV, Parameterization]:
    """Check what is asked for, then read and map; the parameters are those of the rows of the scan."""
    connect, place, named = run.method.connect(), run.given.place(), run.plane.named_corners()
    check_outputs(((run.out, UV_SUFFIXES), (run.report, (".json",))), [run.source.scan, run.given.boundary])
    inputs = read_inputs(run.source, run.given.boundary, named)
    with points_called(inputs.rows):
        survey, mapped = parameterize_scan(
            inputs.points,
            inputs.loop,
            outer=place,
            connect=connect,
            weights=run.method.scheme(),
            layout=run.plane.layout(inputs.corners),
            clock=clock,
        )
    return inputs, mapped.uv[survey.cloud.places], mapped
