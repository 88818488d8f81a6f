"""A fit run: read, mesh, fit."""

from contextlib import ExitStack
from dataclasses import replace

import numpy as np

from ..._parallel import on_threads
from ...cad import CAD_SUFFIXES, SURFACE_SUFFIXES, write_surface
from ...cad.occ import check_extra
from ...clock import StageClock
from ...errors import SolveError, points_called
from ...heights.layers import check_one_layer
from ...io import classes_in
from ...look.page import PAGE_SUFFIXES, compose, writing_page
from ...look.page.html_page import HtmlPage
from ...look.paint import PICTURE_SUFFIXES
from ...report.as_json import writing_json
from ...report.checks import certificate_checks
from ...report.mesh_facts import MeshedScan, certificate_facts, mesh_facts
from ...report.mesh_notes import boundary_notes, intersection_notes
from ...report.record import Note, RunReport, WrittenFile
from ...report.surface_facts import surface_facts
from ...report.surface_notes import choice_notes, surface_notes
from ...surface.surfacing import SurfacedScan, check_met, fit_scan
from ...typing import Points
from ..choices import GAPS
from ..fit_run import FitRun
from ..inputs import Inputs, check_outputs, read_inputs
from .measured import measure_mesh
from .surface_files import HOLD_DEVIATIONS, write_beside
from .written import options_facts, page_words, stages_of, untold


def execute(run: FitRun, clock: StageClock) -> RunReport:
    """Execute a fit run."""
    with on_threads(run.running.threads):
        inputs, allowed, surfaced = _surfaced(run, clock)
        choices = choice_notes(surfaced) if run.files.explain else []
        unmet = None if run.surface.best_effort else _unmet(surfaced, allowed, run.surface.share())
        if unmet is not None:
            return RunReport(run.command, notes=tuple(choices), stages=stages_of(clock), failure=unmet)
        return _written(run, inputs, allowed, surfaced, clock, choices)


def _surfaced(run: FitRun, clock: StageClock) -> tuple[Inputs, float, SurfacedScan]:
    """Check what is asked for, then read, mesh and fit; return the tolerance in the unit of the scan, too."""
    allowed_of, place = run.surface.allowed(), run.given.place()
    share, fairness = run.surface.share(), run.surface.weight()
    named = run.plane.named_corners()
    _check_files(run)
    inputs = read_inputs(run.source, run.given.boundary, named)
    allowed = allowed_of(_diagonal(inputs.points))
    if (classes := classes_in(inputs.scan, inputs.rows)) is not None:
        check_one_layer(inputs.points, classes)
    with points_called(inputs.rows):
        surfaced = fit_scan(
            inputs.points,
            inputs.loop,
            tolerance=allowed,
            outliers=share,
            max_control=run.surface.max_control_points,
            degree=run.surface.degree,
            fairness=fairness,
            loss=run.surface.loss(),
            outer=place,
            gaps=None if run.holes is None else GAPS[run.holes],
            square=run.plane.square(inputs.corners),
            clock=clock,
        )
    return inputs, allowed, surfaced


def _check_files(run: FitRun) -> None:
    out, told = run.files.out, run.told
    outputs = (
        (out, SURFACE_SUFFIXES),
        (run.files.deviations, HOLD_DEVIATIONS),
        (run.files.picture, PICTURE_SUFFIXES),
        (run.files.reflections, PICTURE_SUFFIXES),
        (told.report, (".json",)),
        (told.html, PAGE_SUFFIXES),
    )
    check_outputs(outputs, [run.source.scan, run.given.boundary])
    if out.suffix.lower() in CAD_SUFFIXES:
        check_extra(out)


def _diagonal(points: Points) -> float:
    """Return the diagonal of the box around points; what is not finite in them is named later."""
    with np.errstate(invalid="ignore", over="ignore"):
        return float(np.hypot.reduce(np.ptp(points, axis=0)))


def _unmet(surfaced: SurfacedScan, allowed: float, share: float) -> SolveError | None:
    try:
        check_met(surfaced, allowed, share)
    except SolveError as unmet:
        return unmet
    return None


def _written(
    run: FitRun, inputs: Inputs, allowed: float, surfaced: SurfacedScan, clock: StageClock, choices: list[Note]
) -> RunReport:
    """Measure what was made, write it, and tell of it."""
    meshed = measure_mesh(
        inputs.scan.points, inputs.rows, surfaced.reconstruction, clock, is_boundary_given=run.given.is_given
    )
    measure = allowed, run.surface.share(), run.surface.unit
    facts = mesh_facts(meshed, options_facts(run)) | {"surface": surface_facts(surfaced, meshed.points, *measure)}
    notes = [
        *inputs.notes,
        *choices,
        *boundary_notes(surfaced.reconstruction, meshed.points, found=not run.given.is_given),
    ]
    notes += [*intersection_notes(meshed.intersections), *surface_notes(surfaced, *measure)]
    report = RunReport(run.command, notes=tuple(notes), stages=stages_of(clock), facts=facts)
    page = _page(run, meshed, surfaced, report, clock)
    with ExitStack() as stack, writing_json(run.told.report, report), writing_page(run.told.html, page):
        write_beside(run, inputs, surfaced, allowed, stack)
        write_surface(run.files.out, surfaced.fit.surface, surfaced.loops, unit=run.surface.unit)
    return replace(report, stages=stages_of(clock), files=tuple(_files(run, page)))


def _page(
    run: FitRun, meshed: MeshedScan, surfaced: SurfacedScan, report: RunReport, clock: StageClock
) -> HtmlPage | None:
    """Lay out the page, if one is asked for: over the parameters of the surface, which the fit has corrected."""
    if run.told.html is None:
        return None
    made, off = replace(surfaced.reconstruction, uv=surfaced.fit.uv), surfaced.deviation.signed
    # What was proved of the parameters of the mesh does not hold for those that the fit has corrected.
    proof = replace(made.certificate, coinciding_uv=None, flat_or_folded_uv=None, simple_uv_boundary=None)
    facts = report.facts | {"certificate": certificate_facts(proof)}
    report = replace(report, checks=tuple(certificate_checks(proof)), facts=facts)
    with clock("page"):
        return compose(meshed.points, made, report, deviation=off, **page_words(run, run.source.scan, run.files.out))


def _files(run: FitRun, page: HtmlPage | None) -> list[WrittenFile]:
    files, told = run.files, run.told
    beside = untold(
        deviations=files.deviations, picture=files.picture, reflections=files.reflections, report=told.report
    )
    pages = [WrittenFile(told.html, "html", page.size_line)] if page and told.html else []
    return [WrittenFile(files.out, "out"), *beside, *pages]
