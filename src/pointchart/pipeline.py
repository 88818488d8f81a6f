"""The whole way from points to a certified disc: the stages in order."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from .boundary import Candidate, chord_length_on_circle
from .boundary.bounded import survey_scan
from .chart.on_mesh import uv_on_mesh
from .chart.rule import ChartRule, as_chart
from .chart.straight_sides import swap_off_sides
from .clock import StageClock
from .errors import PointchartError, points_called
from .gaps.bridges import Bridge, open_gaps
from .gaps.rules import GapRule, bridge_gaps, refuse_second_boundary
from .gaps.trials import Trial, first_sound, swap_on
from .map.convex_combination import Parameterization
from .map.scan_parameters import Connect, LayoutRule
from .map.weights import WeightScheme
from .mesh.delaunay_swaps import swap_to_delaunay
from .mesh.make import MeshCounts
from .mesh.swap_rule import SwapRule, as_swaps
from .mesh.ways import Way, make_mesh
from .plane.polygons import check_layout
from .points.cloud import Cloud
from .points.lines import lines_told
from .proof.certificate import Certificate, check_proof, prove
from .proof.folded import check_not_folded
from .solve.solver import Solver
from .solve.systems import Solution
from .typing import UV, Indices, Loop, Triangles

TRIALS = 3  # loops tried, the best first, until a mesh is sound: on no scan of the evaluation was a later one right


@dataclass(frozen=True, slots=True, eq=False)
class Reconstruction:
    """A certified disc on the points of a scan, with holes where gaps were to be left open.

    Attributes
    ----------
    rows : (n,) int64
        The row of the scan that each vertex was read from; ``arange(n)`` unless rows repeat a point.
    triangles : (m, 3) int64
        Vertex indices, anticlockwise seen from outside.
    uv : (n, 2) float64
        Parameters of each vertex, dimensionless.
    loop : (b,) int64
        The boundary, anticlockwise.
    certificate : Certificate
    evidence : Evidence
    """

    rows: Indices
    triangles: Triangles
    uv: UV
    loop: Loop
    certificate: Certificate
    evidence: "Evidence"


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """How a reconstruction came about.

    Attributes
    ----------
    candidates : list of Candidate
        Loops that the boundary was chosen from; empty if it was given.
    bridges : list of Bridge
        Patches of long triangles, over gaps of the scan or where the mesh is in doubt; in the unit of the scan.
    failures : list of PointchartError
        Why better candidates for the boundary did not do, naming rows of the scan.
    counts : MeshCounts
        What was swapped and mended on the way.
    first_solve : Solution or None
        The map that the mesh came from, None if it was assembled without one.
    solve : Solution
        The map that `uv` comes from. Of both, the values are those of the vertices.
    """

    candidates: list[Candidate]
    bridges: list[Bridge]
    failures: list[PointchartError]
    counts: MeshCounts
    first_solve: Solution | None
    solve: Solution


def reconstruct(
    points: ArrayLike,
    loop: ArrayLike | None = None,
    *,
    outer: ArrayLike | None = None,
    gaps: GapRule | None = None,
    connect: Connect | None = None,
    weights: WeightScheme | None = None,
    swap: SwapRule = swap_to_delaunay,
    layout: LayoutRule = chord_length_on_circle,
    chart: ChartRule = uv_on_mesh,
    solver: Solver | None = None,
    clock: StageClock | None = None,
) -> Reconstruction:
    """Triangulate a scan of one surface patch, prove the mesh a disc and give it parameters.

    Parameters
    ----------
    points : (N, 3) array
        The scan, in any unit and at any offset. Repeated points are merged.
    loop : (b,) int array, optional
        Boundary rows in order, in either direction; found, if not given.
    outer : (3,) array, optional
        A place: of the loops found, the one that passes nearest to it is the boundary.
    gaps : callable, optional
        ``gaps(found)``: `refuse_second_boundary`, `bridge_gaps` or `leave_gaps_open`. If not given, gaps are bridged,
        and one that may as well be the boundary is refused unless `loop` or `outer` say what the boundary is.
    connect : callable, optional
        ``connect(points) -> Neighborhoods``, as for the paper's methods, to be used with `weights`; it is called with
        the distinct points in spatial order, in the unit of the scan. If not given, Delaunay stars are linked by
        their agreement, and the links mend the mesh.
    weights : callable, optional
        ``weights(points, neighborhoods) -> (nnz,)`` for the neighbourhoods of `connect`, or of the Delaunay stars; mean
        value weights, if only `connect` is given.
    swap : Swaps or callable
        ``swap(points, triangles) -> Swapped``, for the mesh after the Delaunay swaps: `swap_to_delaunay` leaves it so,
        `swap_to_least_turn` and others look for creases. `keep_edges` leaves the triangulation of the parameters. What
        a rule begins from, its fields say; see `Swaps`.
    layout : callable
        ``layout(points, loop) -> (b, 2)``: where the boundary goes on the convex domain of `uv`; called with the scan
        and its boundary rows, anticlockwise. The mesh is always made from a map to the circle.
    chart : Chart or callable
        `uv_on_mesh`, one-to-one; `uv_low_stretch`, one-to-one with little stretch; `uv_free_boundary`, one-to-one with
        a free boundary and the least distortion; or `uv_of_points`, the paper's own parameters. A function of yours
        with their signature is held to being one-to-one, too; what a rule promises, its fields say; see `Chart`.
    solver : callable, optional
        See `solve_fixed`.
    clock : StageClock, optional
        Takes the time of the stages.

    Returns
    -------
    Reconstruction

    Raises
    ------
    InputError
        If the points are no single patch, or a boundary, neighbourhood or weight is at fault.
    SolveError
        If the result is not the certified disc asked for.

    References
    ----------
    Floater and Reimers 2001.

    Examples
    --------
    >>> from pointchart import shapes
    >>> cap = reconstruct(shapes.hemisphere(500).points)
    >>> cap.certificate.is_disc, cap.certificate.is_one_to_one
    (True, True)
    """
    clock = clock or StageClock()
    survey = survey_scan(points, loop, outer=outer, clock=clock)
    cloud, scan = survey.cloud, survey.scan
    swaps, charted = as_swaps(swap), as_chart(chart)
    way = Way(swaps, connect, weights, charted.needs_map, solver)
    rule = gaps or (refuse_second_boundary if loop is None and outer is None else bridge_gaps)
    surveys = survey.trials(TRIALS if outer is None else 1)
    with lines_told(cloud.points):
        trial = first_sound(surveys, rule, partial(make_mesh, way=way, clock=clock))
    del survey, surveys  # most of the memory, which the map needs
    rim = trial.around.loop
    boundary_uv = check_layout(layout(scan, cloud.rows[rim]), rim)
    with points_called(cloud.rows):
        with clock("swap"):
            trial = swap_on(trial, cloud.points, swaps)
        with clock("parameters"):
            meshed = replace(trial.meshed, swapped=swap_off_sides(trial.meshed.swapped, rim, boundary_uv))
            mapped = charted.map(cloud.scale * cloud.points, rim, boundary_uv, meshed, solver)
        with clock("certify"):
            patches = trial.around.patches(trial.opened, meshed.swapped.triangles)
            triangles, holes = open_gaps(meshed.swapped.triangles, patches, len(cloud.points))
            spacing = trial.around.spacing / cloud.scale
            proof = prove(cloud.points, triangles, mapped.uv, rim, spacing=spacing, holes=holes)
            check_proof(proof, is_one_to_one=charted.is_one_to_one)
            if loop is None and outer is None:
                check_not_folded(cloud.points, proof)
    trial = replace(trial, meshed=meshed)
    return _in_rows(cloud, trial, triangles, mapped, proof)


def _in_rows(
    cloud: Cloud, trial: Trial, triangles: Triangles, mapped: Parameterization, proof: Certificate
) -> Reconstruction:
    """Return everything in the numbering of the vertices: that of the scan, but for rows that repeat a point."""
    order = np.argsort(cloud.rows)
    vertex = np.empty_like(order)
    vertex[order] = np.arange(len(order))
    candidates = [replace(c, loop=vertex[c.loop], length=cloud.scale * c.length) for c in trial.candidates]
    bridges = [bridge.called(vertex) for bridge in trial.bridges]
    first, last = trial.meshed.first_map, mapped.solution
    evidence = Evidence(
        candidates,
        bridges,
        trial.failures,
        trial.meshed.counts,
        None if first is None else replace(first.solution, values=first.solution.values[order]),
        replace(last, values=last.values[order]),
    )
    loop = vertex[trial.around.loop]
    return Reconstruction(cloud.rows[order], vertex[triangles], mapped.uv[order], loop, proof, evidence)
