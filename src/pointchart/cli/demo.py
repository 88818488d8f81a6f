"""``pointchart demo``: the whole job on a simulated scan."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from . import options as given
from .progress import staged


def demo(
    context: typer.Context,
    out: Annotated[
        Path,
        typer.Option("--out", "-o", metavar="DIR", help="Folder for the scan, the mesh, the picture and the page."),
    ] = Path("demo"),
    quiet: given.QuietOption = False,
) -> None:
    """Simulate a laser scan of a sculpted face, mesh it, print the certificate, write mesh, picture and page."""
    import numpy as np

    from .. import shapes
    from ..errors import FormatError
    from ..io import check_output, replacing, write_mesh
    from ..look.page import lay_out, writing_page
    from ..look.run_pictures import draw_run
    from ..pipeline import reconstruct
    from ..report import certificate_lines, run_report, summary
    from .output import command_line, given_options

    if out.is_file():
        raise typer.BadParameter(f"{out} is a file; name a folder", param_hint="--out")
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as reason:
        raise FormatError(f"{out}: the folder cannot be made ({reason.strerror}); choose another") from None
    cloud, mesh, picture, html = (out / name for name in ("scan.ply", "mesh.ply", "picture.png", "page.html"))
    for path in (cloud, mesh, picture, html):
        check_output(path, suffixes=(".ply", ".png", ".html"))
    scan = shapes.demo_scan().points
    with staged(quiet) as clock:
        result = reconstruct(scan, clock=clock)
    points = scan[result.rows]
    options, rows = given_options(context), np.arange(len(scan))
    run = run_report(scan, rows, result, clock, options, boundary_given=False)
    page = lay_out(points, result, run, title="a simulated laser scan", command=command_line())
    with replacing(cloud) as scan_file, replacing(picture) as picture_file, writing_page(html, page):
        # Each file is in its place only when all of them are written.
        write_mesh(scan_file, scan, np.empty((0, 3), np.int64))
        draw_run(picture_file, points, result.triangles, result.uv, result.loop, view=(28.0, -8.0))
        write_mesh(mesh, points, result.triangles, uv=result.uv)
    if not quiet:
        print("\n".join(certificate_lines(result.certificate)), file=sys.stderr)
        print(f"{mesh}: {summary(result.certificate)}, {sum(clock.seconds.values()):.1f} s", file=sys.stderr)
        print(f"{picture}: the scan, its parameters and its mesh", file=sys.stderr)
        print(f"{html}: the same to turn and point at; {page.size_line}", file=sys.stderr)
