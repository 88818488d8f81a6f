"""The paper's own parameters, of the points instead of the mesh."""

from functools import partial

from ..errors import InputError
from ..map.convex_combination import Parameterization, map_points
from ..mesh.make import Meshed
from ..solve.solver import Solver
from ..typing import UV, Loop, Points
from .rule import Chart


@partial(Chart, needs_map=True, is_one_to_one=False, name="of the points, by the paper")
def uv_of_points(
    points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver | None
) -> Parameterization:
    """Map the points by their neighbourhoods, as the paper does; triangles may fold.

    Raises
    ------
    InputError
        If the mesh was assembled without neighbourhoods.
    """
    if meshed.neighborhoods is None or meshed.weights is None:
        raise InputError(
            "the mesh was made without a map, so it has no parameters of the points; use parameterize, or let "
            "the Chart of a rule that calls this one promise needs_map=True"
        )
    return map_points(points, loop, boundary_uv, meshed.neighborhoods, weights=meshed.weights, solver=solver)
