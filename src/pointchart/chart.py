"""The parameters of a finished mesh: one-to-one on the mesh, or the paper's own."""

from collections.abc import Callable
from typing import TypeAlias, cast

from ._exact import orientation_signs
from .errors import SolveError
from .mesh import one_rings
from .parameterize import Parameterization, parameterize, solve_map
from .quality import vertex_stretches
from .refine import Meshed
from .solve import Solver
from .typing import UV, Loop, Points, Weights
from .weights import WeightScheme, mean_value, normalize, uniform

SOLVES = 5

ChartRule: TypeAlias = Callable[[Points, Loop, UV, Meshed, Solver], Parameterization]


def uv_on_mesh(points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver) -> Parameterization:
    """Map the mesh by mean value weights: one-to-one, by Tutte's and Floater's theorem.

    Where a triangle is flat in double precision all the same, weights are divided by the stretch at the neighbour,
    which opens what has shrunk, and the map is solved again; failing that, the same is done from uniform weights,
    Tutte's own. Weights stay positive, so the theorem holds throughout.

    Parameters
    ----------
    points : (n, 3) array
    loop : (b,) int array
        Boundary, anticlockwise.
    boundary_uv : (b, 2) array
        Where it goes on the convex domain, anticlockwise.
    meshed : Meshed
    solver : callable
        See `solve_fixed`.

    Returns
    -------
    Parameterization
        One-to-one, or the last one tried: the certificate tells.

    References
    ----------
    Tutte 1963, How to draw a graph. Floater 2003, One-to-one piecewise linear mappings over triangulations.
    Yoshizawa, Belyaev and Seidel 2004, A fast and simple stretch-minimizing mesh parameterization.
    """
    triangles = meshed.swapped.triangles
    rings = one_rings(triangles, len(points))
    mapped: Parameterization | None = None
    failure: SolveError | None = None
    for scheme in (mean_value, uniform):
        weights = scheme(points, rings)
        for _ in range(SOLVES):
            try:
                mapped = solve_map(points, loop, boundary_uv, rings, weights=fixed(weights), solver=solver)
            except SolveError as reason:
                failure = failure or reason
                break
            if (orientation_signs(mapped.uv, triangles) > 0).all():
                return mapped
            stretch = vertex_stretches(points, triangles, mapped.uv)
            weights = normalize(weights / stretch[rings.indices], rings)
    if mapped is None:
        raise cast(SolveError, failure)
    return mapped


def fixed(weights: Weights) -> WeightScheme:
    """Make a scheme of weights that are known already."""
    return lambda points, neighborhoods: weights


def uv_of_points(points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver) -> Parameterization:
    """Map the points by their neighbourhoods, as the paper does; triangles may fold."""
    return parameterize(points, loop, boundary_uv, meshed.neighborhoods, weights=meshed.weights, solver=solver)
