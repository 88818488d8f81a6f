"""The whole way from points to a certified disc: the stages in order."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ._check import check_loop
from .boundary import Candidate, chord_length_steps, find_boundary, on_circle, reversed_loop
from .bridges import Bridge, find_bridges
from .certify import Certificate, certify
from .clock import StageClock
from .errors import SolveError, points_called
from .links import link_stars
from .mesh import one_rings
from .neighbors import Neighborhoods, break_ties, delaunay_star, nearest
from .neighbors import spacing as local_spacing
from .orient import faces_inwards
from .parameterize import Parameterization, parameterize
from .prepare import Cloud, prepare
from .refine import Meshed, SwapRule, mesh_once, mesh_repeatedly
from .solve import Direct, Solver
from .swaps import swap_off_sides, swap_to_delaunay
from .typing import UV, Floats, Indices, Loop, Points, Triangles
from .weights import WeightScheme, mean_value

NEAREST = 20
SECOND_BOUNDARY = 0.25  # a gap with this share of the boundary's length and points may as well be the boundary

Connect = Callable[[Points], Neighborhoods]
StepRule = Callable[[Points, Loop], Floats]
LayoutRule = Callable[[Floats], UV]
ChartRule = Callable[[Points, UV, Loop, Meshed, Solver], Parameterization]


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
        Loops that the boundary was chosen from, in units of half the scan's extent; empty if it was given.
    bridges : list of Bridge
        Patches of the mesh that bridge gaps of the scan.
    meshed : Meshed
        The first map, the swaps and the rounds.
    chart : Parameterization
        The map that `uv` comes from.
    """

    candidates: list[Candidate]
    bridges: list[Bridge]
    meshed: Meshed
    chart: Parameterization


def uv_on_mesh(points: Points, boundary_uv: UV, loop: Loop, meshed: Meshed, solver: Solver) -> Parameterization:
    """Map the mesh by mean value weights: one-to-one, by Tutte's and Floater's theorem."""
    rings = one_rings(meshed.swapped.triangles, len(points))
    return parameterize(points, loop, boundary_uv, rings, weights=mean_value, solver=solver)


def uv_of_points(points: Points, boundary_uv: UV, loop: Loop, meshed: Meshed, solver: Solver) -> Parameterization:
    """Map the points by their neighbourhoods, as the paper does; triangles may fold."""
    return parameterize(points, loop, boundary_uv, meshed.neighborhoods, weights=meshed.weights, solver=solver)


def reconstruct(
    points: ArrayLike,
    loop: ArrayLike | None = None,
    *,
    connect: Connect | None = None,
    weights: WeightScheme = mean_value,
    swap: SwapRule = swap_to_delaunay,
    steps: StepRule = chord_length_steps,
    layout: LayoutRule = on_circle,
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
        ``connect(points) -> Neighborhoods``, as for the paper's methods, to be used with `weights`. If not given,
        Delaunay stars are linked by their agreement, and links that the mesh contradicts lose their trust.
    weights : callable
        ``weights(points, neighborhoods) -> (nnz,)``; used with `connect` only.
    swap : callable
        ``swap(points, triangles) -> Swapped``: `swap_to_delaunay` or `keep_edges`.
    steps : callable
        ``steps(points, loop) -> (b,)``: spacing along the boundary.
    layout : callable
        ``layout(steps) -> (b, 2)``: the convex domain of `uv`. The first map is always made on the circle.
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
    clock, solver = clock or StageClock(), solver or Direct()
    with clock("prepare"):
        cloud = prepare(points)
    with points_called(cloud.rows):
        with clock("neighbours"):
            around = nearest(cloud.points, NEAREST)
            spacing = local_spacing(cloud.points, around=around)
            star = delaunay_star(break_ties(cloud.points, spacing), around)
        with clock("boundary"):
            rim, candidates = _boundary(cloud, loop, star, spacing)
        meshed = _mesh(cloud.points, rim, star, connect, weights, steps, swap, solver, clock)
        rim, meshed = _outwards(cloud, rim, meshed)
        bridges = find_bridges(cloud.points, meshed.swapped.triangles, spacing)
        if loop is None:
            _check_bridges(candidates[0], bridges)
        with clock("parameters"):
            boundary_uv = layout(steps(cloud.points, rim))
            meshed = replace(meshed, swapped=swap_off_sides(meshed.swapped, rim, boundary_uv))
            mapped = chart(cloud.points, boundary_uv, rim, meshed, solver)
        with clock("certify"):
            proof = certify(cloud.points, meshed.swapped.triangles, uv=mapped.uv, loop=rim, spacing=spacing)
            _check_proof(proof, chart)
    return _in_rows(cloud, rim, mapped, proof, Evidence(candidates, bridges, meshed, mapped))


def _boundary(
    cloud: Cloud, loop: ArrayLike | None, star: Neighborhoods, spacing: Floats
) -> tuple[Loop, list[Candidate]]:
    if loop is None:
        found = find_boundary(cloud.points, star, spacing)
        return found.loop, found.candidates
    return check_loop(cloud.places[check_loop(loop, len(cloud.places))], len(cloud.points)), []


def _mesh(
    points: Points,
    rim: Loop,
    star: Neighborhoods,
    connect: Connect | None,
    weights: WeightScheme,
    steps: StepRule,
    swap: SwapRule,
    solver: Solver,
    clock: StageClock,
) -> Meshed:
    circle = on_circle(steps(points, rim))
    if connect is None:
        with clock("neighbours"):
            links = link_stars(star)
        return mesh_repeatedly(points, rim, circle, links, swap=swap, solver=solver, clock=clock)
    with clock("neighbours"):
        neighborhoods = connect(points)
    return mesh_once(points, rim, circle, neighborhoods, weights=weights, swap=swap, solver=solver, clock=clock)


def _outwards(cloud: Cloud, rim: Loop, meshed: Meshed) -> tuple[Loop, Meshed]:
    """Turn the mesh and its boundary round if they face inwards."""
    triangles = meshed.swapped.triangles
    if not faces_inwards(cloud.points, triangles, rim):
        return rim, meshed
    turned = replace(meshed.swapped, triangles=np.ascontiguousarray(triangles[:, ::-1]))
    return reversed_loop(rim), replace(meshed, swapped=turned)


def _check_bridges(chosen: Candidate, bridges: list[Bridge]) -> None:
    """Refuse a found boundary when the mesh bridges a gap that may as well be the boundary."""
    for bridge in bridges:
        length, count = bridge.rim_length / chosen.length, len(bridge.points) / len(chosen.loop)
        if length >= SECOND_BOUNDARY and count >= SECOND_BOUNDARY:
            raise SolveError(
                f"the surface has a second boundary, so it is no disc: besides the loop of {len(chosen.loop)} points that "
                f"passes point {{here}} there is a gap of {len(bridge.points)} points, {length:.2f} times as long, at point "
                "{there}; give the boundary with --boundary, or close the gap",
                here=chosen.loop[0],
                there=bridge.points[0],
            )


def _check_proof(proof: Certificate, chart: ChartRule) -> None:
    if not proof.is_disc:
        raise SolveError(f"the mesh is no disc: {', '.join(proof.faults)}; give another boundary or neighbourhood")
    if chart is uv_on_mesh and not proof.is_one_to_one:
        raise SolveError(
            f"the parameters are not one-to-one: {proof.flat_or_folded_uv} triangles are flat and {proof.coinciding_uv} "
            "points coincide, since a part of the surface is too long for its neck in double precision; cut that part off"
        )


def _in_rows(cloud: Cloud, rim: Loop, mapped: Parameterization, proof: Certificate, evidence: Evidence) -> Reconstruction:
    """Number points as the scan does."""
    order = np.argsort(cloud.rows)
    vertex = np.empty_like(order)
    vertex[order] = np.arange(len(order))
    triangles = vertex[evidence.meshed.swapped.triangles]
    return Reconstruction(cloud.rows[order], triangles, mapped.uv[order], vertex[rim], proof, evidence)
