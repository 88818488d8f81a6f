"""The parameters of a finished mesh: one-to-one on the mesh in three ways, or the paper's own."""

from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from itertools import islice
from typing import cast

import numpy as np
import scipy.sparse as sp

from ..errors import InputError, PointchartError, SolveError
from ..map.convex_combination import Parameterization, parameterize, solve_map
from ..map.protrusions import openings
from ..map.weights import WeightScheme, fixed, mean_value, normalize, uniform
from ..mesh.connectivity import one_rings
from ..mesh.make import Meshed
from ..mesh.quality import l2_stretch, vertex_stretches
from ..plane.exact_signs import orientation_signs
from ..points.neighbors import Neighborhoods
from ..solve.algebraic_multigrid import multigrid
from ..solve.systems import Solver, solve_fixed
from ..typing import UV, Loop, Points, Triangles
from .free_boundary import minimize_dirichlet
from .rule import Chart

QUICK_TOLERANCES = 1e-6, 1e-10  # of the first maps, each tried for being one-to-one
DIRECT_LIMIT = 10_000  # points up to which factors cost less than a hierarchy of matrices
RELAXATIONS = 8  # the stretch falls most in the first two; thin limbs go on to open up to the eighth


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
    rings = one_rings(triangles, len(points))
    if solver is None and len(points) > DIRECT_LIMIT:
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


@partial(Chart, name="of low stretch on a convex domain")
def uv_low_stretch(
    points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver | None
) -> Parameterization:
    r"""Map the mesh to the same domain with little stretch, one-to-one: ears and fingers get their share of the plane.

    From the map of `uv_on_mesh`, weights are divided by the stretch at the neighbour, and the map is solved again:

    .. math:: \lambda_{ij} \leftarrow \lambda_{ij} / \sigma_j

    Weights stay positive, so Tutte's theorem holds throughout. Of the first eight such maps, that of least L2 stretch
    is kept; where none is better than the start, uniform weights are tried in the same way. It pays with angles: the
    map is far from conformal.

    Parameters
    ----------
    points, loop, boundary_uv, meshed, solver
        See `uv_on_mesh`.

    Returns
    -------
    Parameterization

    References
    ----------
    Yoshizawa, Belyaev and Seidel 2004, A fast and simple stretch-minimizing mesh parameterization, section 3.
    """
    triangles = meshed.swapped.triangles
    best = uv_on_mesh(points, loop, boundary_uv, meshed, solver)
    least = l2_stretch(points, triangles, best.uv) if is_positive(best.uv, triangles) else float("inf")
    start = best
    for scheme in (mean_value, uniform):
        # Where weights go out of hand, the maps before stand.
        with suppress(PointchartError):
            for mapped in islice(relaxations(points, loop, boundary_uv, triangles, scheme, solver), RELAXATIONS + 1):
                stretch = l2_stretch(points, triangles, mapped.uv)
                if stretch < least and is_positive(mapped.uv, triangles):
                    best, least = mapped, stretch
        if best is not start:
            break
    return best


@partial(Chart, name="with a free boundary, in the unit of the scan")
def uv_free_boundary(
    points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver | None
) -> Parameterization:
    """Map the mesh with a free boundary and the least distortion of lengths, one-to-one: for texturing.

    Lengths, angles and areas are all kept as well as may be (symmetric Dirichlet energy), from the map of
    `uv_low_stretch`; a developable surface comes out isometric. The parameters have the area of the surface.

    Parameters
    ----------
    points, loop, boundary_uv, meshed, solver
        See `uv_on_mesh`; the domain and the solver serve for the start only.

    Returns
    -------
    Parameterization
        One-to-one; the start itself, where that is not.

    References
    ----------
    Smith and Schaefer 2015, Bijective parameterization with free boundaries.
    """
    triangles = meshed.swapped.triangles
    start = uv_low_stretch(points, loop, boundary_uv, meshed, solver)
    if not is_positive(start.uv, triangles):
        return start
    flattened = minimize_dirichlet(points, triangles, loop, start.uv)
    return Parameterization(flattened.uv, loop, flattened.solution)


def relaxations(
    points: Points, loop: Loop, boundary_uv: UV, triangles: Triangles, scheme: WeightScheme, solver: Solver | None
) -> Iterator[Parameterization]:
    """Map a mesh again and again, each time with weights divided by the last map's stretch at the neighbour."""
    rings = one_rings(triangles, len(points))
    weights = scheme(points, rings)
    while True:
        mapped = solve_map(points, loop, boundary_uv, rings, weights=fixed(weights), solver=solver)
        yield mapped
        weights = normalize(weights / vertex_stretches(points, triangles, mapped.uv)[rings.indices], rings)


def is_positive(uv: UV, triangles: Triangles) -> bool:
    """Tell exactly whether all triangles are anticlockwise."""
    return bool((orientation_signs(uv, triangles) > 0).all())


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
        raise InputError("the mesh was made without a map, so it has no parameters of the points; use parameterize")
    return parameterize(points, loop, boundary_uv, meshed.neighborhoods, weights=meshed.weights, solver=solver)
