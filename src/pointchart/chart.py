"""The parameters of a finished mesh: one-to-one on the mesh, or the paper's own."""

from collections.abc import Callable
from typing import TypeAlias

from ._exact import orientation_signs
from .mesh import one_rings
from .parameterize import Parameterization, parameterize, solve_map
from .quality import vertex_stretches
from .refine import Meshed
from .solve import Solver
from .typing import UV, Loop, Points
from .weights import mean_value, normalize

MOST_SOLVES = 6

ChartRule: TypeAlias = Callable[[Points, Loop, UV, Meshed, Solver], Parameterization]


def uv_on_mesh(points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver) -> Parameterization:
    """Map the mesh by mean value weights: one-to-one, by Tutte's and Floater's theorem.

    Where a triangle is flat in double precision all the same, weights are divided by the stretch at the neighbour,
    which opens what has shrunk, and the map is solved again. Weights stay positive, so the theorem holds throughout.

    References
    ----------
    Floater 2003, One-to-one piecewise linear mappings over triangulations.
    Yoshizawa, Belyaev and Seidel 2004, A fast and simple stretch-minimizing mesh parameterization, equation (4).
    """
    triangles = meshed.swapped.triangles
    rings = one_rings(triangles, len(points))
    weights = mean_value(points, rings)
    for solves in range(1, MOST_SOLVES + 1):
        fixed = weights
        mapped = solve_map(points, loop, boundary_uv, rings, weights=lambda *_, fixed=fixed: fixed, solver=solver)
        if solves == MOST_SOLVES or (orientation_signs(mapped.uv, triangles) > 0).all():
            break
        stretch = vertex_stretches(points, triangles, mapped.uv)
        weights = normalize(weights / stretch[rings.indices], rings)
    return mapped


def uv_of_points(points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver) -> Parameterization:
    """Map the points by their neighbourhoods, as the paper does; triangles may fold."""
    return parameterize(points, loop, boundary_uv, meshed.neighborhoods, weights=meshed.weights, solver=solver)
