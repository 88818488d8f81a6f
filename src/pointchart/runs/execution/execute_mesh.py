"""A mesh run: read, mesh, write."""

from dataclasses import replace

from ..._parallel import on_threads
from ...clock import StageClock
from ...errors import points_called
from ...heights.height_field import Keep, reconstruct_heights
from ...heights.layers import check_one_layer
from ...io import MESH_SUFFIXES, check_digits, classes_in, write_mesh
from ...look.page import PAGE_SUFFIXES, compose, writing_page
from ...look.page.html_page import HtmlPage
from ...mesh.distortion import vertex_stretches
from ...mesh.spanning import SPANNING, spanning_triangles
from ...pipeline import Reconstruction, reconstruct
from ...report.as_json import writing_json
from ...report.checks import certificate_checks, summary
from ...report.mesh_facts import MeshedScan, mesh_facts
from ...report.mesh_notes import boundary_notes, intersection_notes, slot_notes
from ...report.record import Note, RunReport, WrittenFile
from ...typing import Attributes, Indices
from ..choices import CHARTS, GAPS, SWAPS, plane_normal
from ..inputs import Inputs, check_outputs, read_inputs
from ..mesh_run import MeshRun
from ..option_values import Holes, KeptPoint
from .measured import measure_mesh
from .written import carried, options_facts, page_words, stages_of, untold

HOLD_STRETCH = (".ply", ".npz")  # formats that hold any number a vertex: only for them is it measured


def execute(run: MeshRun, clock: StageClock) -> RunReport:
    """Execute a mesh run."""
    with on_threads(run.running.threads):
        inputs, result = _meshed(run, clock)
        meshed = measure_mesh(inputs.scan.points, inputs.rows, result, clock, is_boundary_given=run.given.is_given)
        report, page = _reported(run, inputs, meshed, clock), None
        if run.told.html is not None:
            with clock("page"):
                page = compose(meshed.points, result, report, **page_words(run, run.source.scan, run.out))
        attributes = _attributes(run, inputs, meshed)
        with writing_json(run.told.report, report), writing_page(run.told.html, page):
            said = write_mesh(run.out, meshed.points, result.triangles, uv=result.uv, attributes=attributes)
    notes, files = (*report.notes, *map(Note, said)), tuple(_files(run, result, page))
    return replace(report, notes=notes, stages=stages_of(clock), files=files)


def _meshed(run: MeshRun, clock: StageClock) -> tuple[Inputs, Reconstruction]:
    """Check what is asked for, then read and mesh."""
    connect, place = run.method.connect(), run.given.place()
    named, holes = run.plane.named_corners(), run.mesh.holes
    outputs = ((run.out, MESH_SUFFIXES), (run.told.report, (".json",)), (run.told.html, PAGE_SUFFIXES))
    check_outputs(outputs, [run.source.scan, run.given.boundary])
    plane = plane_normal(run)
    inputs = read_inputs(run.source, run.given.boundary, named)
    check_digits(run.out, inputs.points)
    if plane is not None:
        with points_called(inputs.rows):
            keep = None if run.mesh.keep is None else Keep(run.mesh.keep)
            gaps_open = holes is Holes.open
            normal = plane(inputs.points)
            return inputs, reconstruct_heights(inputs.points, normal, keep=keep, gaps_open=gaps_open, clock=clock)
    if (classes := classes_in(inputs.scan, inputs.rows)) is not None:
        check_one_layer(inputs.points, classes)
    with points_called(inputs.rows):
        return inputs, reconstruct(
            inputs.points,
            inputs.loop,
            outer=place,
            gaps=None if holes is None else GAPS[holes],
            connect=connect,
            weights=run.method.scheme(),
            swap=SWAPS[run.mesh.swap],
            layout=run.plane.layout(inputs.corners),
            chart=CHARTS[run.mesh.uv],
            clock=clock,
        )


def _reported(run: MeshRun, inputs: Inputs, meshed: MeshedScan, clock: StageClock) -> RunReport:
    """Tell of a mesh that is yet to be written."""
    return RunReport(
        run.command,
        checks=tuple(certificate_checks(meshed.result.certificate)),
        notes=tuple(_notes(meshed, inputs, run)),
        stages=stages_of(clock),
        facts=mesh_facts(meshed, options_facts(run)),
    )


def _attributes(run: MeshRun, inputs: Inputs, meshed: MeshedScan) -> Attributes:
    result, attributes = meshed.result, carried(inputs, inputs.rows[meshed.result.rows])
    if run.out.suffix.lower() in HOLD_STRETCH:
        attributes |= {"stretch": vertex_stretches(meshed.points, result.triangles, result.uv)}
    return attributes


def _notes(meshed: MeshedScan, inputs: Inputs, run: MeshRun) -> list[Note]:
    notes = boundary_notes(meshed.result, meshed.points, found=not meshed.is_boundary_given)
    return [
        *inputs.notes,
        *notes,
        *intersection_notes(meshed.intersections),
        *_slots(meshed, run),
        *_rows_left(inputs, meshed.result.rows, run.mesh.keep),
    ]


def _slots(meshed: MeshedScan, run: MeshRun) -> list[Note]:
    """Say that narrow slots may be closed; a height field spans what it spans."""
    longest = meshed.result.certificate.longest_edge_over_spacing
    if run.mesh.plane is not None or longest <= SPANNING:
        return []
    return slot_notes(*spanning_triangles(meshed.points, meshed.result.triangles))


def _rows_left(inputs: Inputs, rows: Indices, kept: KeptPoint | None) -> list[Note]:
    repeated, outside = len(inputs.rows) - len(rows), inputs.n_in_other_parts
    lines = [f"{outside} points in other parts left out"] if outside else []
    merged = (
        "repeated points merged to the first" if kept is None else f"points left out that are not the {kept} at a place"
    )
    lines += [f"{repeated} {merged}"] if repeated else []
    named = ["point_index gives each vertex's row"] if len(rows) < len(inputs.scan.points) else []
    return [Note("; ".join([", ".join(lines), *named] if lines else named))] if named else []


def _files(run: MeshRun, result: Reconstruction, page: HtmlPage | None) -> list[WrittenFile]:
    files = [WrittenFile(run.out, "out", summary(result.certificate)), *untold(report=run.told.report)]
    return files + ([WrittenFile(run.told.html, "html", page.size_line)] if page and run.told.html else [])
