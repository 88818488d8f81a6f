"""The whole way from points to a certified disc: the stages in order."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ._check import check_loop, check_points
from .boundary import (
    Candidate,
    FoundBoundary,
    anticlockwise,
    check_order,
    chord_length_on_circle,
    find_boundary,
)
from .bridges import Bridge, find_bridges
from .certify import Certificate, certify
from .chart import ChartRule, uv_on_mesh
from .clock import StageClock
from .errors import SolveError, points_called
from .links import link_stars
from .neighbors import Neighborhoods, nearest
from .parameterize import Parameterization, parameterize
from .prepare import Cloud, prepare
from .refine import Meshed, SwapRule, mesh_once, mesh_repeatedly
from .solve import Solver, default_solver
from .stars import nearest_star
from .swaps import swap_off_sides, swap_to_delaunay
from .typing import UV, Indices, Loop, Points, Triangles
from .vicinity import NEAREST, Vicinity, explore
from .weights import WeightScheme, mean_value

SECOND_BOUNDARY = 0.25  # a gap with this share of the boundary's length and points may as well be the boundary

Connect = Callable[[Points], Neighborhoods]
LayoutRule = Callable[[Points, Loop], UV]


@dataclass(frozen=True, slots=True, eq=False)
class Reconstruction:
    """A certified disc on the points of a scan.

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
        Patches of the mesh that bridge gaps of the scan.
    meshed : Meshed
        The first map, the swaps and the rounds, in the numbering of the prepared cloud.
    chart : Parameterization
        The map that `uv` comes from, in the numbering of the prepared cloud.
    """

    candidates: list[Candidate]
    bridges: list[Bridge]
    meshed: Meshed
    chart: Parameterization


@dataclass(frozen=True, slots=True, eq=False)
class Survey:
    """What is known of a scan before it is mapped.

    Attributes
    ----------
    scan : (N, 3) float64
        The points as given.
    cloud : Cloud
    vicinity : Vicinity
        Of the cloud's points.
    loop : (b,) int64
        Boundary points of the cloud, anticlockwise.
    found : FoundBoundary or None
        How the boundary was found; None if it was given.
    """

    scan: Points
    cloud: Cloud
    vicinity: Vicinity
    loop: Loop
    found: FoundBoundary | None


def reconstruct(
    points: ArrayLike,
    loop: ArrayLike | None = None,
    *,
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
    connect : callable, optional
        ``connect(points) -> Neighborhoods``, as for the paper's methods, to be used with `weights`; it is called with
        the distinct points in spatial order, in the unit of the scan. If not given, Delaunay stars are linked by
        their agreement, and links that the mesh contradicts lose their trust.
    weights : callable
        ``weights(points, neighborhoods) -> (nnz,)`` for the neighbourhoods of `connect`, or of the Delaunay stars; mean
        value weights, if only `connect` is given.
    swap : callable
        ``swap(points, triangles) -> Swapped``: `swap_to_delaunay` or `keep_edges`.
    layout : callable
        ``layout(points, loop) -> (b, 2)``: where the boundary goes on the convex domain of `uv`; called with the scan
        and its boundary rows, anticlockwise. The mesh is always made from a map to the circle.
    chart : callable
        `uv_on_mesh`, one-to-one, or `uv_of_points`, the paper's own parameters.
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
    survey = survey_scan(points, loop, clock=clock)
    solver = solver or default_solver(len(survey.cloud.points))
    cloud, rim = survey.cloud, survey.loop
    boundary_uv = layout(survey.scan, cloud.rows[rim])
    with points_called(cloud.rows):
        meshed = _mesh(survey, connect, weights, swap, solver, clock)
        bridges = find_bridges(cloud.points, meshed.swapped.triangles, survey.vicinity.spacing)
        _check_bridges(survey, bridges)
        with clock("parameters"):
            meshed = replace(meshed, swapped=swap_off_sides(meshed.swapped, rim, boundary_uv))
            mapped = chart(cloud.points, rim, boundary_uv, meshed, solver)
        with clock("certify"):
            proof = certify(
                cloud.points, meshed.swapped.triangles, uv=mapped.uv, loop=rim, spacing=survey.vicinity.spacing
            )
            _check_proof(proof, chart)
    return _in_rows(
        cloud, rim, mapped, proof, Evidence(survey.found.candidates if survey.found else [], bridges, meshed, mapped)
    )


def survey_scan(points: ArrayLike, loop: ArrayLike | None = None, *, clock: StageClock | None = None) -> Survey:
    """Prepare a scan, find its Delaunay stars and its boundary: what every reconstruction begins with.

    Parameters
    ----------
    points : (N, 3) array
        The scan, in any unit and at any offset. Repeated points are merged.
    loop : (b,) int array, optional
        Boundary rows in order, in either direction; found, if not given.
    clock : StageClock, optional

    Returns
    -------
    Survey

    Raises
    ------
    InputError
        If the points are no single patch, or the boundary is at fault.

    Examples
    --------
    >>> from pointchart import shapes
    >>> sheet = shapes.grid(12, 9)
    >>> survey = survey_scan(sheet.points)
    >>> sorted(survey.cloud.rows[survey.loop]) == sorted(sheet.boundary)
    True
    """
    clock = clock or StageClock()
    with clock("prepare"):
        scan = check_points(points)
        cloud = prepare(scan)
        given = None if loop is None else check_loop(loop, len(scan))
    with points_called(cloud.rows):
        with clock("neighbours"):
            vicinity = explore(cloud.points)
        with clock("boundary"):
            if given is None:
                found = find_boundary(cloud.points, vicinity=vicinity)
                rim = found.loop
            else:
                found, rim = None, check_loop(cloud.places[given], len(cloud.points))
                check_order(cloud.points, rim)
                rim = anticlockwise(cloud.points, rim)
    return Survey(scan, cloud, vicinity, rim, found)


def parameterize_scan(
    points: ArrayLike,
    loop: ArrayLike | None = None,
    *,
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
    survey = survey_scan(points, loop, clock=clock)
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


def _mesh(
    survey: Survey,
    connect: Connect | None,
    weights: WeightScheme | None,
    swap: SwapRule,
    solver: Solver,
    clock: StageClock,
) -> Meshed:
    points, rim = survey.cloud.points, survey.loop
    circle = chord_length_on_circle(points, rim)
    if connect is None and weights is None:
        with clock("neighbours"):
            links = link_stars(survey.vicinity.star)
        return mesh_repeatedly(points, rim, circle, links, swap=swap, solver=solver, clock=clock)
    with clock("neighbours"):
        neighborhoods = (connect or _default_stars)(points * survey.cloud.scale)
    weights = weights or mean_value
    return mesh_once(points, rim, circle, neighborhoods, weights=weights, swap=swap, solver=solver, clock=clock)


def _check_bridges(survey: Survey, bridges: list[Bridge]) -> None:
    """Refuse a surface that is no disc: it shows as a bridge with a good part of the boundary's length and points.

    Over a hole, the points along the bridge have an angular gap. A boundary that was found may then be the wrong one;
    one that was given is taken at its word. A bridge elsewhere means a surface that cannot be flattened, such as a
    handle.
    """
    points, loop = survey.cloud.points, survey.loop
    length = np.linalg.norm(points[np.roll(loop, -1)] - points[loop], axis=1).sum()
    large = [
        bridge
        for bridge in bridges
        if bridge.rim_length >= SECOND_BOUNDARY * length and len(bridge.points) >= SECOND_BOUNDARY * len(loop)
    ]
    if not large:
        return
    is_boundary = survey.found.scores.is_boundary if survey.found else np.ones(len(points), bool)
    for bridge in large:
        if is_boundary[bridge.points].mean() < 0.5:
            raise SolveError(
                f"the surface is no disc: a patch of {len(bridge.points)} points at point {{there}} is joined by edges "
                "of over four spacings although the scan has no gap there, as on a handle, a twist, or a part so long "
                "that its map collapses; cut it there",
                there=bridge.points[0],
            )
        if survey.found:
            raise SolveError(
                f"the surface has a second boundary, so it is no disc: besides the loop of {len(loop)} points that "
                f"passes point {{here}} there is a gap of {len(bridge.points)} points, "
                f"{bridge.rim_length / length:.2f} times as long, at point {{there}}; give the boundary, "
                "or close the gap",
                here=loop[0],
                there=bridge.points[0],
            )


def _check_proof(proof: Certificate, chart: ChartRule) -> None:
    if not proof.is_disc:
        raise SolveError(f"the mesh is no disc: {', '.join(proof.faults)}; give another boundary or neighbourhood")
    if chart is uv_on_mesh and not proof.is_one_to_one:
        raise SolveError(
            f"the parameters are not one-to-one: {proof.flat_or_folded_uv} triangles are flat and "
            f"{proof.coinciding_uv} points coincide: a part of the surface is too long for its neck in double "
            "precision, or too narrow for a straight side of the domain; cut that part off, or use the circle"
        )


def _in_rows(
    cloud: Cloud, rim: Loop, mapped: Parameterization, proof: Certificate, evidence: Evidence
) -> Reconstruction:
    """Return everything in the numbering of the scan."""
    order = np.argsort(cloud.rows)
    vertex = np.empty_like(order)
    vertex[order] = np.arange(len(order))
    bridges = [
        replace(bridge, points=vertex[bridge.points], rim_length=cloud.scale * bridge.rim_length)
        for bridge in evidence.bridges
    ]
    candidates = [replace(c, loop=vertex[c.loop], length=cloud.scale * c.length) for c in evidence.candidates]
    evidence = replace(evidence, bridges=bridges, candidates=candidates)
    triangles = vertex[evidence.meshed.swapped.triangles]
    return Reconstruction(cloud.rows[order], triangles, mapped.uv[order], vertex[rim], proof, evidence)
