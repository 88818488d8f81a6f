"""A check run: read, certify."""

from pathlib import Path

import numpy as np

from ...clock import StageClock
from ...errors import InputError
from ...io import Scan, read_scan
from ...proof.certificate import Certificate, certify
from ...report.as_json import writing_json
from ...report.checks import certificate_checks, summary
from ...report.mesh_facts import certificate_facts
from ...report.record import Note, RunReport
from ...typing import Points
from ..check_run import CheckRun
from ..inputs import check_outputs
from .written import stages_of, untold

NEAR = 1e-6  # of the extent: what single precision leaves of a place


def execute(run: CheckRun, clock: StageClock) -> RunReport:
    """Execute a check run."""
    check_outputs(((run.report, (".json",)),), [run.mesh, run.points])
    read = read_scan(run.mesh)
    if len(read.triangles) == 0:
        said = f" ({'; '.join(read.notes)})" if read.notes else ""
        raise InputError(f"{run.mesh}: the file has {len(read.points)} points and no triangles{said}; give a mesh")
    n_left = 0 if run.points is None else _compare(read, read_scan(run.points), run.mesh, run.points)
    uv = read.uv
    with clock("certify"):
        proof = certify(read.points, read.triangles, uv=uv, holes=run.holes)
    failure = None
    if not proof.is_as_asked or (uv is not None and not proof.is_one_to_one):
        failure = InputError(f"{run.mesh} is {summary(proof)}; {_remedy(proof, read.points, run.holes)}")
    left = f"; {n_left} points of {run.points} are not in it" if n_left else ""
    report = RunReport(
        run.command,
        checks=tuple(certificate_checks(proof)),
        notes=() if failure else (Note(f"{run.mesh}: {summary(proof)}{left}"),),
        stages=stages_of(clock),
        files=tuple(untold(report=run.report)),
        facts={"certificate": certificate_facts(proof)},
        failure=failure,
    )
    with writing_json(run.report, report):
        pass
    return report


def _remedy(proof: Certificate, points: Points, holes: int) -> str:
    """Say what may help, by what the mesh is."""
    places = len(np.unique(points, axis=0))
    if places < len(points):
        return f"its {len(points)} vertices stand at {places} places: merge those that coincide"
    is_manifold = proof.overfull_edges == 0 and proof.pinched_points == 0
    if is_manifold and proof.boundary_loops == 0:
        return "it is closed, so it has no boundary to be the one of a disc"
    open_holes = 1 - proof.euler
    if is_manifold and proof.parts == 1 and 0 < open_holes == proof.boundary_loops - 1 != holes:
        return f"for a mesh whose gaps were left open, say --holes {open_holes}"
    if proof.parts > 1:
        return "check its parts one by one"
    return "mesh the scan again, or repair it"


def _compare(read: Scan, scan: Scan, mesh: Path, path: Path) -> int:
    """Check that the vertices of a mesh are points of a scan; return how many distinct ones are not among them."""
    rows = read.attributes.get("point_index", np.arange(len(scan.points)))
    n_distinct = len(np.unique(scan.points, axis=0))
    if len(read.points) != len(rows) or ("point_index" not in read.attributes and n_distinct != len(read.points)):
        raise InputError(
            f"{mesh} has {len(read.points)} vertices, {path} {len(scan.points)} points; they do not belong together"
        )
    if np.issubdtype(rows.dtype, np.floating) or rows.min() < 0 or rows.max() >= len(scan.points):
        raise InputError(f"{mesh} has a point_index that names no point of {path}; they do not belong together")
    extent = np.ptp(scan.points, axis=0).max()
    moved = np.flatnonzero(np.abs(read.points - scan.points[rows]).max(axis=1) > NEAR * extent)
    if len(moved):
        raise InputError(
            f"{len(moved)} vertices of {mesh} are not where {path} has them (points {{moved}}): it is the mesh of "
            "another scan, or in a format that keeps no order or too few digits, such as STL",
            moved=moved,
        )
    return n_distinct - len(np.unique(scan.points[rows], axis=0))
