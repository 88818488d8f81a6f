"""Parameters of low stretch on the same domain."""

from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from itertools import islice

from ..errors import PointchartError
from ..map.convex_combination import Parameterization, solve_map
from ..map.weights import WeightScheme, fixed, mean_value, normalize, uniform
from ..mesh.connectivity import rings_of
from ..mesh.distortion import l2_stretch, vertex_stretches
from ..mesh.make import Meshed
from ..solve.solver import Solver
from ..typing import UV, Loop, Points, Triangles
from .on_mesh import is_positive, uv_on_mesh
from .rule import Chart

RELAXATIONS = 8  # the stretch falls most in the first two; thin limbs go on to open up to the eighth


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


def relaxations(
    points: Points, loop: Loop, boundary_uv: UV, triangles: Triangles, scheme: WeightScheme, solver: Solver | None
) -> Iterator[Parameterization]:
    """Map a mesh again and again, each time with weights divided by the last map's stretch at the neighbour."""
    rings = rings_of(triangles, len(points))
    weights = scheme(points, rings)
    while True:
        mapped = solve_map(points, loop, boundary_uv, rings, weights=fixed(weights), solver=solver)
        yield mapped
        weights = normalize(weights / vertex_stretches(points, triangles, mapped.uv)[rings.indices], rings)
