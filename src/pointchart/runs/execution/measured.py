"""The measures of a mesh that a report tells, as stages of its run."""

from ...clock import StageClock
from ...mesh.mesh_quality import measure_quality
from ...pipeline import Reconstruction
from ...proof.intersection_places import find_places
from ...report.mesh_facts import MeshedScan
from ...typing import Indices, Points


def measure_mesh(
    scan: Points, rows: Indices, result: Reconstruction, clock: StageClock, *, is_boundary_given: bool = False
) -> MeshedScan:
    """Measure the quality of a mesh, and find where it passes through itself.

    Parameters
    ----------
    scan : (n, 3) array
        All points that were read.
    rows : (k,) int array
        Those that were worked on; rows of the result are places in it.
    result : Reconstruction
    clock : StageClock
    is_boundary_given : bool

    Returns
    -------
    MeshedScan
    """
    points = scan[rows[result.rows]]
    with clock("quality"):
        quality = measure_quality(points, result.triangles, result.uv)
    with clock("self-intersections"):
        intersections = find_places(points, result.triangles)
    return MeshedScan(scan, rows, result, quality, intersections, is_boundary_given)
