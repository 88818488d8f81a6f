"""From points to a mesh: map, triangulate, swap; by links of the surface, also recover edges and relocate points."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from .clock import StageClock
from .links import Links, trusted
from .neighbors import Neighborhoods
from .parameterize import Parameterization, parameterize
from .recover import recover_links
from .relocate import relocate_points, suspect_points
from .reopen import parameterize_open
from .solve import Solver
from .swaps import Swapped, swap_to_delaunay
from .triangulate import separate, triangulate
from .typing import UV, Loop, Points, Triangles
from .weights import WeightScheme

SwapRule = Callable[[Points, Triangles], Swapped]

PASSES = 3  # of relocation and swaps, each from the points that the mesh before contradicts


@dataclass(frozen=True, slots=True, eq=False)
class Meshed:
    """A mesh, the map it came from, and what was mended on the way.

    Attributes
    ----------
    neighborhoods : Neighborhoods
    weights : WeightScheme
        What the map was made with.
    first_map : Parameterization
    swapped : Swapped
    n_recovered : int
        Links that were made edges before the swaps.
    n_relocated : int
        Moves of points to other places of the mesh.
    """

    neighborhoods: Neighborhoods
    weights: WeightScheme
    first_map: Parameterization
    swapped: Swapped
    n_recovered: int
    n_relocated: int


def mesh_once(
    points: Points,
    loop: Loop,
    layout: UV,
    neighborhoods: Neighborhoods,
    *,
    weights: WeightScheme,
    swap: SwapRule,
    solver: Solver,
    clock: StageClock,
) -> Meshed:
    """Map the points, triangulate their parameters, swap edges in space: the paper's way."""
    with clock("map"):
        first_map = parameterize(points, loop, layout, neighborhoods, weights=weights, solver=solver)
    with clock("triangulate"):
        triangles = triangulate(separate(first_map.uv, first_map.loop), first_map.loop)
    with clock("swap"):
        return Meshed(neighborhoods, weights, first_map, swap(points, triangles), 0, 0)


def mesh_by_links(
    points: Points,
    loop: Loop,
    layout: UV,
    links: Links,
    around: Neighborhoods,
    *,
    solver: Solver,
    clock: StageClock,
) -> Meshed:
    """Map the points by links of the surface, and let the links mend what the map gets wrong.

    Where sheets are close or a part is narrow, the map folds, or its triangulation joins points that are far apart. So
    links on which stars agree are recovered as edges, and points whose links the mesh contradicts are moved to where
    they cost less. `around` holds the near points at whose triangles they may be put.
    """
    graph = links.neighborhoods
    with clock("map"):
        first_map, weights = parameterize_open(points, loop, layout, graph, weights=trusted(links), solver=solver)
    with clock("triangulate"):
        uv = separate(first_map.uv, loop)
        triangles = triangulate(uv, loop)
    with clock("recover"):
        recovered = recover_links(points, uv, triangles, links)
    with clock("swap"):
        swapped = swap_to_delaunay(points, recovered.triangles)
    n_swaps, n_moves = swapped.n_swaps, 0
    for _ in range(PASSES):
        with clock("relocate"):
            suspects = suspect_points(links, swapped.triangles)
            relocated = relocate_points(points, swapped.triangles, around, suspects)
        if relocated.n_moves == 0:
            break
        with clock("swap"):
            swapped = swap_to_delaunay(points, relocated.triangles)
        n_swaps, n_moves = n_swaps + swapped.n_swaps, n_moves + relocated.n_moves
    total = replace(swapped, n_swaps=n_swaps)
    return Meshed(graph, weights, first_map, total, recovered.n_recovered, n_moves)
