"""A demo run: simulate, mesh, write."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from ... import shapes
from ...clock import StageClock
from ...errors import FormatError, OptionError
from ...io import check_output, replacing, write_mesh
from ...look.page import compose, writing_page
from ...look.run_pictures import draw_run
from ...pipeline import reconstruct
from ...report.checks import certificate_checks, summary
from ...report.mesh_facts import mesh_facts
from ...report.record import RunReport, WrittenFile
from ..command_line import command_line
from ..demo_run import DemoRun
from .measured import measure_mesh
from .written import options_facts, stages_of

SIDE = (28.0, -8.0)  # degrees to walk around the face and to look down on it


def execute(run: DemoRun, clock: StageClock) -> RunReport:
    """Execute a demo run."""
    _make_folder(run.out)
    cloud, mesh, picture, html = (run.out / name for name in ("scan.ply", "mesh.ply", "picture.png", "page.html"))
    for path in (cloud, mesh, picture, html):
        check_output(path, suffixes=(".ply", ".png", ".html"))
    scan = shapes.demo_scan().points
    result = reconstruct(scan, clock=clock)
    meshed = measure_mesh(scan, np.arange(len(scan)), result, clock)
    points, facts = meshed.points, mesh_facts(meshed, options_facts(run))
    checks = tuple(certificate_checks(result.certificate))
    report = RunReport(run.command, checks=checks, stages=stages_of(clock), facts=facts)
    with clock("page"):
        page = compose(points, result, report, title="a simulated laser scan", command=command_line(run))
    with replacing(cloud) as scan_file, replacing(picture) as picture_file, writing_page(html, page):
        # Each file is in its place only when all of them are written.
        write_mesh(scan_file, scan, np.empty((0, 3), np.int64))
        draw_run(picture_file, points, result.triangles, result.uv, result.loop, view=SIDE)
        write_mesh(mesh, points, result.triangles, uv=result.uv)
    proved = f"{summary(result.certificate)}, {sum(clock.seconds.values()):.1f} s"
    files = (
        WrittenFile(cloud, "scan", "the scan", is_told=False),
        WrittenFile(mesh, "mesh", proved),
        WrittenFile(picture, "picture", "the scan, its parameters and its mesh"),
        WrittenFile(html, "html", f"the same to turn and point at; {page.size_line}"),
    )
    return replace(report, stages=stages_of(clock), files=files)


def _make_folder(out: Path) -> None:
    if out.is_file():
        raise OptionError(f"{out} is a file; name a folder", flag="--out")
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as reason:
        raise FormatError(f"{out}: the folder cannot be made ({reason.strerror}); choose another") from None
