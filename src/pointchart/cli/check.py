"""``pointchart check``: certify a mesh from a file."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options as given

if TYPE_CHECKING:
    from ..io import Scan


def check(
    mesh: Annotated[
        Path, typer.Argument(metavar="MESH", readable=False, help="Mesh to check: ply, obj, off, stl, glb, npz.")
    ],
    points: Annotated[
        Path | None,
        typer.Option("--points", metavar="SCAN", readable=False, help="The scan: vertex i has to be its point i."),
    ] = None,
    holes: Annotated[
        int, typer.Option("--holes", min=0, help="How many holes the disc should have: gaps that were left open.")
    ] = 0,
    report: given.ReportOption = None,
    quiet: given.QuietOption = False,
) -> None:
    """Check that a mesh is a disc, on the points of a scan if one is given; exit 1 if it is not."""
    from ..errors import InputError
    from ..io import check_output, read_scan
    from ..proof.certificate import certify
    from ..report import certificate_lines, certificate_report, summary, write_json
    from .inputs import uv_of

    if report is not None:
        check_output(report, suffixes=(".json",), inputs=[mesh] if points is None else [mesh, points])
    read = read_scan(mesh)
    if len(read.triangles) == 0:
        raise InputError(f"{mesh}: the file has {len(read.points)} points and no triangles; give a mesh")
    n_left = 0
    if points is not None:
        n_left = _compare(read, read_scan(points), mesh, points)
    uv = uv_of(read)
    proof = certify(read.points, read.triangles, uv=uv, holes=holes)
    if report is not None:
        write_json(report, {"certificate": certificate_report(proof)})
    if not quiet:
        print("\n".join(certificate_lines(proof)), file=sys.stderr)
    if not proof.is_as_asked or (uv is not None and not proof.is_one_to_one):
        remedy = "mesh the scan again, or repair it"
        if proof.euler == 2 - proof.boundary_loops != 1 - holes:
            remedy = f"for a mesh whose gaps were left open, say --holes {1 - proof.euler}"
        raise InputError(f"{mesh} is {summary(proof)}; {remedy}")
    if not quiet:
        left = f"; {n_left} points of {points} are not in it" if n_left else ""
        print(f"{mesh}: {summary(proof)}{left}", file=sys.stderr)


def _compare(read: Scan, scan: Scan, mesh: Path, path: Path) -> int:
    """Check that the vertices of a mesh are points of a scan; return how many distinct ones are not among them."""
    import numpy as np

    from ..errors import InputError

    rows = read.attributes.get("point_index", np.arange(len(scan.points)))
    n_distinct = len(np.unique(scan.points, axis=0))
    if len(read.points) != len(rows) or ("point_index" not in read.attributes and n_distinct != len(read.points)):
        raise InputError(
            f"{mesh} has {len(read.points)} vertices, {path} {len(scan.points)} points; they do not belong together"
        )
    if np.issubdtype(rows.dtype, np.floating) or rows.min() < 0 or rows.max() >= len(scan.points):
        raise InputError(f"{mesh} has a point_index that names no point of {path}; they do not belong together")
    extent = np.ptp(scan.points, axis=0).max()
    moved = np.flatnonzero(np.abs(read.points - scan.points[rows]).max(axis=1) > 1e-6 * extent)
    if len(moved):
        raise InputError(
            f"{len(moved)} vertices of {mesh} are not where {path} has them (points {{moved}}): it is the mesh of "
            "another scan, or in a format that keeps no order or too few digits, such as STL",
            moved=moved,
        )
    return n_distinct - len(np.unique(scan.points[rows], axis=0))
