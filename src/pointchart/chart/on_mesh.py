"""The parameters of a finished mesh: one-to-one on the mesh in three ways, or the paper's own."""

from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from typing import cast

import numpy as np
import scipy.sparse as sp

from ..errors import PointchartError, SolveError
from ..map.convex_combination import Parameterization
from ..map.protrusions import openings
from ..map.weights import mean_value, uniform
from ..mesh.connectivity import rings_of
from ..mesh.make import Meshed
from ..plane.exact_signs import orientation_signs
from ..points.neighborhoods import Neighborhoods
from ..solve.algebraic_multigrid import multigrid
from ..solve.solver import Solver
from ..solve.systems import solve_fixed
from ..typing import UV, Loop, Points, Triangles
from .rule import Chart

QUICK_TOLERANCES = 1e-6, 1e-10  # of the first maps, each tried for being one-to-one
MOST_FACTORED = 10_000  # points up to which factors cost less than a hierarchy of matrices


@partial(Chart, name="one-to-one on a convex domain")
def uv_on_mesh(points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver | None) -> Parameterization:
    """Map the mesh by mean value weights: one-to-one, by Tutte's and Floater's theorem.

    Without a solver, large meshes are mapped by multigrid to a relative residual of 1e-6 first, and on to 1e-10 where
    that leaves a triangle that is not positive, by exact signs. Failing that, the map is solved to the last digits;
    where a triangle is flat in double precision all the same, the map is opened by other weights (`openings`), then
    from uniform weights, Tutte's own. Weights stay positive, so the theorem holds throughout.

    Parameters
    ----------
    points : (n, 3) array
    loop : (b,) int array
        Boundary, anticlockwise.
    boundary_uv : (b, 2) array
        Where it goes on the convex domain, anticlockwise.
    meshed : Meshed
    solver : callable, optional
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
    rings = rings_of(triangles, len(points))
    if solver is None and len(points) > MOST_FACTORED:
        with suppress(SolveError):
            for quick in _quick_maps(points, loop, boundary_uv, rings):
                if is_positive(quick.uv, triangles):
                    return quick
    mapped: Parameterization | None = None
    failure: PointchartError | None = None
    for scheme in (mean_value, uniform):
        try:
            for opening in openings(points, loop, boundary_uv, rings, weights=scheme, solver=solver):
                mapped = opening.mapped
                if is_positive(mapped.uv, triangles):
                    return mapped
        except PointchartError as reason:
            failure = failure or reason
    if mapped is None:
        raise cast(PointchartError, failure)
    return mapped


def _quick_maps(points: Points, loop: Loop, boundary_uv: UV, rings: Neighborhoods) -> Iterator[Parameterization]:
    """Map the mesh to residuals that are small against the whole, not where it is fine."""
    start = None
    for tolerance in QUICK_TOLERANCES:
        solver = partial(multigrid, tolerance=tolerance, start=start)
        solution = solve_fixed(_mean_value_matrix(points, rings), loop, boundary_uv, solver=solver)
        yield Parameterization(solution.values, loop, solution)
        start = np.delete(solution.values, loop, axis=0)


def _mean_value_matrix(points: Points, rings: Neighborhoods) -> sp.csr_array:
    indptr = np.asarray(rings.indptr, rings.indices.dtype)  # of two types, both would be copied
    return sp.csr_array((mean_value(points, rings), rings.indices, indptr), shape=(rings.n_points,) * 2)


def is_positive(uv: UV, triangles: Triangles) -> bool:
    """Tell exactly whether all triangles are anticlockwise."""
    return bool((orientation_signs(uv, triangles) > 0).all())
