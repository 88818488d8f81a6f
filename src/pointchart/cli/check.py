"""``pointchart check``: certify a mesh from a file."""

import sys
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from ..certify import certify
from ..errors import InputError
from ..io import Scan, read_scan
from ..report import certificate_lines, certificate_report, summary, write_json
from ..typing import UV
from . import options as given


def check(
    mesh: Annotated[Path, typer.Argument(metavar="MESH", help="Mesh to check: ply, obj, off, stl, glb, npz.")],
    points: Annotated[
        Path | None, typer.Option("--points", metavar="SCAN", help="The scan: vertex i has to be its point i.")
    ] = None,
    report: given.ReportOption = None,
    quiet: given.QuietOption = False,
) -> None:
    """Check that a mesh is a disc, on the points of a scan if one is given; exit 1 if it is not."""
    read = read_scan(mesh)
    if len(read.triangles) == 0:
        raise InputError(f"{mesh}: the file has {len(read.points)} points and no triangles; give a mesh")
    if points is not None:
        _compare(read, read_scan(points), mesh, points)
    proof = certify(read.points, read.triangles, uv=_uv(read))
    if report is not None:
        write_json(report, {"certificate": certificate_report(proof)})
    if not quiet:
        print("\n".join(certificate_lines(proof)), file=sys.stderr)
        print(f"{mesh}: {summary(proof)}", file=sys.stderr)
    if not proof.is_disc or (proof.is_one_to_one is False and _uv(read) is not None):
        raise typer.Exit(1)


def _uv(read: Scan) -> UV | None:
    if "u" not in read.attributes or "v" not in read.attributes:
        return None
    return np.column_stack([read.attributes["u"], read.attributes["v"]]).astype(np.float64)


def _compare(read: Scan, scan: Scan, mesh: Path, path: Path) -> None:
    rows = read.attributes.get("point_index", np.arange(len(scan.points)))
    if len(read.points) != len(rows) or len(np.unique(scan.points, axis=0)) != len(read.points):
        raise InputError(
            f"{mesh} has {len(read.points)} vertices, {path} {len(scan.points)} points; they do not belong together"
        )
    extent = np.ptp(scan.points, axis=0).max()
    moved = np.flatnonzero(np.abs(read.points - scan.points[rows]).max(axis=1) > 1e-6 * extent)
    if len(moved):
        raise InputError(
            f"{len(moved)} vertices of {mesh} are not where {path} has them (points {{moved}}): another scan",
            moved=moved,
        )
