"""``pointchart demo``: the whole job on a simulated scan."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from . import options as given
from .progress import staged


def demo(
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="DIR", help="Folder for the scan, the mesh and the picture.")
    ] = Path("demo"),
    quiet: given.QuietOption = False,
) -> None:
    """Simulate a laser scan of a sculpted face, mesh it, print the certificate, write mesh and picture."""
    import numpy as np

    from .. import shapes
    from ..errors import FormatError
    from ..io import check_output, write_mesh
    from ..picture import draw_run
    from ..pipeline import reconstruct
    from ..report import certificate_lines, summary

    if out.is_file():
        raise typer.BadParameter(f"{out} is a file; name a folder", param_hint="--out")
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as reason:
        raise FormatError(f"{out}: the folder cannot be made ({reason.strerror}); choose another") from None
    cloud, mesh, picture = (out / name for name in ("scan.ply", "mesh.ply", "picture.png"))
    for path in (cloud, mesh, picture):
        check_output(path, suffixes=(".ply", ".png"))
    scan = shapes.demo_scan().points
    with staged(quiet) as clock:
        result = reconstruct(scan, clock=clock)
    points = scan[result.rows]
    write_mesh(cloud, scan, np.empty((0, 3), np.int64))
    write_mesh(mesh, points, result.triangles, uv=result.uv)
    draw_run(picture, points, result.triangles, result.uv, result.loop, view=(28.0, -8.0))
    if not quiet:
        print("\n".join(certificate_lines(result.certificate)), file=sys.stderr)
        print(f"{mesh}: {summary(result.certificate)}, {sum(clock.seconds.values()):.1f} s", file=sys.stderr)
        print(f"{picture}: the scan, its parameters and its mesh", file=sys.stderr)
