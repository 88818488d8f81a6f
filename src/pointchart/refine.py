"""From points to a mesh: map, triangulate, swap; and again with the links distrusted that the mesh contradicts."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from .clock import StageClock
from .links import Links, distrust_far, is_near, trusted
from .neighbors import Neighborhoods
from .parameterize import Parameterization, parameterize
from .solve import Solver
from .swaps import Swapped
from .triangulate import separate, triangulate
from .typing import UV, Loop, Points, Triangles
from .weights import WeightScheme

SwapRule = Callable[[Points, Triangles], Swapped]

MOST_ROUNDS = 4
TOLERATED = (
    0.01  # share of trusted links that a sound mesh contradicts: long diagonals, on every scan with thin triangles
)
LEAST_GAIN = 0.9


@dataclass(frozen=True, slots=True, eq=False)
class Meshed:
    """A mesh, the map it came from, and how far the neighbourhoods contradict it.

    Attributes
    ----------
    neighborhoods : Neighborhoods
    weights : WeightScheme
        What the first map was made with.
    first_map : Parameterization
    swapped : Swapped
    contradicted : tuple of float
        After each round, the share of trusted links whose ends are more than two edges apart on the mesh.
    """

    neighborhoods: Neighborhoods
    weights: WeightScheme
    first_map: Parameterization
    swapped: Swapped
    contradicted: tuple[float, ...]


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
        return Meshed(neighborhoods, weights, first_map, swap(points, triangles), ())


def mesh_repeatedly(
    points: Points,
    loop: Loop,
    layout: UV,
    links: Links,
    *,
    swap: SwapRule,
    solver: Solver,
    clock: StageClock,
) -> Meshed:
    """Mesh the points; while the mesh contradicts many links and ever fewer, mesh them again without trust in those.

    Links across to a second sheet, such as from lip to lip, pull the map together there. On the mesh their ends are far
    apart, which gives them away.
    """
    history: list[float] = []
    current = links
    while True:
        meshed = mesh_once(
            points, loop, layout, current.neighborhoods, weights=trusted(current), swap=swap, solver=solver, clock=clock
        )
        with clock("compare"):
            is_far = ~is_near(links, meshed.swapped.triangles)
            # On a grid no star agrees with another, and all links are trusted alike.
            contradicted = float(is_far[links.trust == links.trust.max()].mean())
            if not history or contradicted < min(history):
                best = meshed
            gains = not history or contradicted < LEAST_GAIN * min(history)
            history.append(contradicted)
            if contradicted <= TOLERATED or not gains or len(history) == MOST_ROUNDS:
                return replace(best, contradicted=tuple(history))
            current = distrust_far(links, meshed.swapped.triangles)
