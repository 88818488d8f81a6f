"""The whole way from points to a certified disc: the stages in order."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from .agreement.links import disputed_links, link_stars, tie_down, trusted
from .boundary import Candidate, chord_length_on_circle
from .boundary.bounded import Survey, survey_scan
from .chart.on_mesh import ChartRule, uv_free_boundary, uv_low_stretch, uv_of_points, uv_on_mesh
from .clock import StageClock
from .errors import PointchartError, SolveError, points_called
from .gaps.bridges import Bridge, find_bridges, open_gaps
from .gaps.rules import GapRule, Rims, bridge_gaps, check_torn, refuse_second_boundary
from .map.convex_combination import Parameterization, parameterize
from .map.weights import WeightScheme, mean_value
from .mesh.delaunay_swaps import Swapped, keep_edges, swap_off_sides, swap_to_delaunay
from .mesh.make import Meshed, SwapRule, mesh_by_agreement, mesh_by_links, mesh_once
from .points.cloud import Cloud
from .points.neighbors import Neighborhoods, nearest
from .points.stars import nearest_star
from .points.surroundings import NEAREST
from .proof.certificate import Certificate, certify
from .solve.systems import Solver, default_solver
from .typing import UV, Indices, Loop, Points, Triangles

TRIALS = 3  # loops tried, the best first, until a mesh stands

Connect = Callable[[Points], Neighborhoods]
LayoutRule = Callable[[Points, Loop], UV]


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
        Patches of long triangles, over gaps of the scan or where the mesh is in doubt; in the unit of the scan. Their
        triangles are numbered as before any gap was left open.
    failures : list of PointchartError
        Why better candidates for the boundary did not do, naming rows of the scan.
    meshed : Meshed
        The first map, the swaps and what was mended, in the numbering of the prepared cloud.
    chart : Parameterization
        The map that `uv` comes from, in the numbering of the prepared cloud.
    """

    candidates: list[Candidate]
    bridges: list[Bridge]
    failures: list[PointchartError]
    meshed: Meshed
    chart: Parameterization


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
        ``gaps(rims)``: `refuse_second_boundary`, `bridge_gaps` or `leave_gaps_open`. If not given, gaps are bridged,
        and one that may as well be the boundary is refused unless `loop` or `outer` say what the boundary is.
    connect : callable, optional
        ``connect(points) -> Neighborhoods``, as for the paper's methods, to be used with `weights`; it is called with
        the distinct points in spatial order, in the unit of the scan. If not given, Delaunay stars are linked by
        their agreement, and the links mend the mesh.
    weights : callable, optional
        ``weights(points, neighborhoods) -> (nnz,)`` for the neighbourhoods of `connect`, or of the Delaunay stars; mean
        value weights, if only `connect` is given.
    swap : callable
        ``swap(points, triangles) -> Swapped``, for the mesh after the Delaunay swaps: `swap_to_delaunay` leaves it so,
        `swap_to_least_turn` and others look for creases. `keep_edges` leaves the triangulation of the parameters.
    layout : callable
        ``layout(points, loop) -> (b, 2)``: where the boundary goes on the convex domain of `uv`; called with the scan
        and its boundary rows, anticlockwise. The mesh is always made from a map to the circle.
    chart : callable
        `uv_on_mesh`, one-to-one; `uv_low_stretch`, one-to-one with little stretch; `uv_free_boundary`, one-to-one with
        a free boundary and the least distortion; or `uv_of_points`, the paper's own parameters.
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
    rule = gaps or (refuse_second_boundary if loop is None and outer is None else bridge_gaps)
    trials = survey.trials[:TRIALS] if outer is None else [survey]
    stand = _first_that_stands(trials, rule, lambda trial: _mesh(trial, connect, weights, swap, chart, solver, clock))
    del survey, trials  # most of the memory, which the map needs
    rim = stand.rims.loop
    boundary_uv = layout(scan, cloud.rows[rim])
    with points_called(cloud.rows):
        with clock("swap"):
            meshed = _swapped_again(cloud.points, stand, swap)
        with clock("parameters"):
            meshed = replace(meshed, swapped=swap_off_sides(meshed.swapped, rim, boundary_uv))
            mapped = chart(cloud.scale * cloud.points, rim, boundary_uv, meshed, solver)
        with clock("certify"):
            patches = stand.rims.patches(stand.opened, meshed.swapped.triangles)
            triangles, holes = open_gaps(meshed.swapped.triangles, patches, len(cloud.points))
            spacing = stand.rims.spacing / cloud.scale
            proof = certify(cloud.points, triangles, uv=mapped.uv, loop=rim, spacing=spacing, holes=holes)
            _check_proof(proof, chart)
    return _in_rows(cloud, replace(stand, meshed=meshed), triangles, mapped, proof)


def parameterize_scan(
    points: ArrayLike,
    loop: ArrayLike | None = None,
    *,
    outer: ArrayLike | None = None,
    connect: Connect | None = None,
    weights: WeightScheme | None = None,
    layout: LayoutRule = chord_length_on_circle,
    solver: Solver | None = None,
    clock: StageClock | None = None,
) -> tuple[Survey, Parameterization]:
    """Give a scan the parameters of the paper, without a mesh.

    Takes what `reconstruct` takes; `connect` gives the Delaunay stars of the 20 nearest points, if not given.

    Returns
    -------
    Survey
    Parameterization
        In the order of ``survey.cloud``; ``cloud.rows`` are the rows of the scan.

    Examples
    --------
    >>> from pointchart import shapes
    >>> survey, mapped = parameterize_scan(shapes.grid(12, 9).points)
    >>> bool(np.linalg.norm(mapped.uv, axis=1).max() < 1.0 + 1e-12)
    True
    """
    clock = clock or StageClock()
    survey = survey_scan(points, loop, outer=outer, clock=clock)
    cloud, rim = survey.cloud.points, survey.loop
    boundary_uv = layout(survey.scan, survey.cloud.rows[rim])
    with points_called(survey.cloud.rows):
        with clock("neighbours"):
            neighborhoods = (connect or _default_stars)(cloud * survey.cloud.scale)
        with clock("map"):
            weights = weights or mean_value
            mapped = parameterize(cloud, rim, boundary_uv, neighborhoods, weights=weights, solver=solver)
    return survey, mapped


def _default_stars(points: Points) -> Neighborhoods:
    return nearest_star(points, nearest(points, NEAREST))


@dataclass(frozen=True, slots=True, eq=False)
class _Stand:
    """A mesh that stands, with the loops that its boundary was chosen from."""

    candidates: list[Candidate]
    meshed: Meshed
    bridges: list[Bridge]
    rims: Rims
    opened: list[Bridge]
    failures: list[PointchartError]


def _first_that_stands(trials: list[Survey], rule: GapRule, mesh: Callable[[Survey], Meshed]) -> _Stand:
    """Mesh a scan with one loop after the other, until the mesh bridges nothing but gaps.

    A false loop has to be bridged over the true one, which shows as a bridge where there is no gap, or as a gap longer
    than the loop: such a loop is passed over where the rule refuses it, not where the user has gaps bridged or left
    open. If none stands, the first failure tells why.
    """
    failures: list[PointchartError] = []
    for trial in trials:
        try:
            with points_called(trial.cloud.rows):
                stand = _stand(trial, mesh(trial))
                if stand.rims.is_outgrown:
                    rule(stand.rims)
        except PointchartError as failure:
            failures.append(failure)
        else:
            with points_called(trial.cloud.rows):
                return replace(stand, opened=rule(stand.rims), failures=failures)
    raise failures[0]


def _stand(survey: Survey, meshed: Meshed) -> _Stand:
    """Check that a mesh bridges nothing but gaps of the scan."""
    points, spacing = survey.points, survey.cloud.scale * survey.vicinity.spacing
    bridges = find_bridges(points, meshed.swapped.triangles, spacing, lambda: survey.scores.is_boundary)
    gaps = [bridge for bridge in bridges if bridge.is_gap]
    rims = Rims(points, spacing, survey.loop, gaps, survey.candidates[1:])
    if bridges:
        check_torn(rims, bridges, disputed_links(survey.vicinity.star), is_given=survey.found is None)
    return _Stand(survey.candidates, meshed, bridges, rims, [], [])


def _mesh(
    survey: Survey,
    connect: Connect | None,
    weights: WeightScheme | None,
    swap: SwapRule,
    chart: ChartRule,
    solver: Solver | None,
    clock: StageClock,
) -> Meshed:
    points, rim, near = survey.cloud.points, survey.loop, survey.vicinity
    if connect is None and weights is None and swap is not keep_edges and chart is not uv_of_points:
        assembled = mesh_by_agreement(points, rim, survey.surface, near.star, near.around, clock=clock)
        if assembled is not None:
            return assembled
    circle, solver = chord_length_on_circle(points, rim), solver or default_solver(len(points))
    if connect is None and weights is None:
        with clock("neighbours"):
            links = tie_down(points, link_stars(near.star, also=nearest_star(points, near.around)), rim)
        if swap is not keep_edges:
            return mesh_by_links(points, rim, circle, links, near.around, solver=solver, clock=clock)
        neighborhoods, scheme = links.neighborhoods, trusted(links)
    else:
        with clock("neighbours"):
            neighborhoods, scheme = (connect or _default_stars)(points * survey.cloud.scale), weights or mean_value
    first = keep_edges if swap is keep_edges else swap_to_delaunay
    return mesh_once(points, rim, circle, neighborhoods, weights=scheme, swap=first, solver=solver, clock=clock)


def _swapped_again(points: Points, stand: _Stand, swap: SwapRule) -> Meshed:
    """Swap edges of a mesh that stands, but not at gaps that will be open; long edges are no bridges any more.

    A swap that knows nothing of the triangles in a gap could make an edge that they have already, so those at its rim
    stay as they are too.
    """
    first = stand.meshed.swapped
    if swap in (swap_to_delaunay, keep_edges):
        return stand.meshed
    is_at_gap = np.zeros(len(points), bool)
    for patch in stand.rims.patches(stand.opened, first.triangles):
        is_at_gap[first.triangles[patch]] = True
    is_kept = ~is_at_gap[first.triangles].any(axis=1)
    last = swap(points, first.triangles[is_kept])
    triangles = first.triangles.copy()
    triangles[is_kept] = last.triangles
    both = Swapped(triangles, first.n_swaps + last.n_swaps, first.is_settled and last.is_settled)
    return replace(stand.meshed, swapped=both)


def _check_proof(proof: Certificate, chart: ChartRule) -> None:
    if not proof.is_as_asked:
        raise SolveError(f"the mesh is no disc: {', '.join(proof.faults)}; give another boundary or neighbourhood")
    if chart in (uv_on_mesh, uv_low_stretch, uv_free_boundary) and not proof.is_one_to_one:
        raise SolveError(
            f"the parameters are not one-to-one: {proof.flat_or_folded_uv} triangles are flat and "
            f"{proof.coinciding_uv} points coincide: a part of the surface is too long for its neck in double "
            "precision, or too narrow for a straight side of the domain; cut that part off, or use the circle"
        )


def _in_rows(
    cloud: Cloud, stand: _Stand, triangles: Triangles, mapped: Parameterization, proof: Certificate
) -> Reconstruction:
    """Return everything in the numbering of the scan."""
    order = np.argsort(cloud.rows)
    vertex = np.empty_like(order)
    vertex[order] = np.arange(len(order))
    candidates = [replace(c, loop=vertex[c.loop], length=cloud.scale * c.length) for c in stand.candidates]
    bridges = [replace(bridge, points=vertex[bridge.points]) for bridge in stand.bridges]
    evidence = Evidence(candidates, bridges, stand.failures, stand.meshed, mapped)
    loop = vertex[stand.rims.loop]
    return Reconstruction(cloud.rows[order], vertex[triangles], mapped.uv[order], loop, proof, evidence)
