"""From points to a mesh: assembled where stars agree, or by a map, its triangulation and swaps; then mended."""

from dataclasses import dataclass

import numpy as np

from .._kernels.mesh.put_back import JOURNAL
from ..agreement.agreed_surface import AgreedSurface
from ..agreement.links import Links
from ..clock import StageClock
from ..map.convex_combination import Parameterization, map_points
from ..map.protrusions import parameterize_open
from ..map.weights import WeightScheme, trusted
from ..points.neighborhoods import Neighborhoods
from ..solve.solver import Solver
from ..typing import UV, Loop, Points, Triangles
from .assembly import assemble
from .connectivity import editable_mesh
from .delaunay_swaps import swap_in_place
from .planar_delaunay import separate, triangulate
from .recover import recover_links
from .relocate import least_gain, relocate_in_place, suspect_points
from .swap_rule import SwapFunction, Swapped

PASSES = 3  # of relocation and swaps, each from the points that the mesh before contradicts


@dataclass(frozen=True, slots=True)
class MeshCounts:
    """What was swapped and mended on the way to a mesh.

    Attributes
    ----------
    n_swaps : int
    is_settled : bool
        Whether no edge asks for another swap.
    n_pockets : int
        Loops that were closed in assembling.
    n_recovered : int
        Links that were made edges before the swaps.
    n_relocated : int
        Moves of points to other places of the mesh.
    """

    n_swaps: int
    is_settled: bool
    n_pockets: int
    n_recovered: int
    n_relocated: int


@dataclass(frozen=True, slots=True, eq=False)
class Meshed:
    """A mesh, the map it came from, and what was mended on the way.

    Attributes
    ----------
    swapped : Swapped
    neighborhoods : Neighborhoods or None
    weights : WeightScheme or None
        What the map was made with.
    first_map : Parameterization or None
        None if the mesh was assembled without a map.
    n_pockets, n_recovered, n_relocated : int
        See `MeshCounts`.
    """

    swapped: Swapped
    neighborhoods: Neighborhoods | None = None
    weights: WeightScheme | None = None
    first_map: Parameterization | None = None
    n_pockets: int = 0
    n_recovered: int = 0
    n_relocated: int = 0

    @property
    def counts(self) -> MeshCounts:
        """What was swapped and mended."""
        swapped = self.swapped
        return MeshCounts(swapped.n_swaps, swapped.is_settled, self.n_pockets, self.n_recovered, self.n_relocated)


def mesh_once(
    points: Points,
    loop: Loop,
    layout: UV,
    neighborhoods: Neighborhoods,
    *,
    weights: WeightScheme,
    swap: SwapFunction,
    solver: Solver,
    clock: StageClock,
) -> Meshed:
    """Map the points, triangulate their parameters, swap edges in space: the paper's way."""
    with clock("map"):
        first_map = map_points(points, loop, layout, neighborhoods, weights=weights, solver=solver)
    with clock("triangulate"):
        triangles = triangulate(separate(first_map.uv, first_map.loop), first_map.loop)
    with clock("swap"):
        return Meshed(swap(points, triangles), neighborhoods, weights, first_map)


def mesh_by_agreement(
    points: Points, loop: Loop, surface: AgreedSurface, star: Neighborhoods, around: Neighborhoods, *, clock: StageClock
) -> Meshed | None:
    """Assemble the mesh from the triangles on which stars agree, without a map; None if they do not make a disc."""
    with clock("assemble"):
        assembled = assemble(points, surface, loop)
    if assembled is None:
        return None
    settled, n_moves = _settled(points, assembled.triangles, star, around, clock)
    return Meshed(settled, n_pockets=assembled.n_pockets, n_relocated=n_moves)


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
    settled, n_moves = _settled(points, recovered.triangles, graph, around, clock)
    return Meshed(settled, graph, weights, first_map, n_recovered=recovered.n_recovered, n_relocated=n_moves)


def _settled(
    points: Points, triangles: Triangles, links: Neighborhoods, around: Neighborhoods, clock: StageClock
) -> tuple[Swapped, int]:
    """Swap edges, relocate the points whose links the mesh contradicts, and so on until none moves; return the moves.

    Swaps and suspects are looked for everywhere at first, then where points have moved.
    """
    n_moves, among, is_touched, least = 0, None, None, 0.0
    with clock("swap"):
        draft = editable_mesh(points, triangles, journal=JOURNAL)
        n_swaps, is_settled = swap_in_place(points, draft.corners, draft.twins)
    for _ in range(PASSES):
        with clock("relocate"):
            draft.leaving[draft.corners] = np.arange(len(draft.corners), dtype=np.int32)
            suspects = suspect_points(links, draft, among)
            if len(suspects) > 0 and least == 0.0:  # once, and only if there is anything to move
                least = least_gain(draft)
            moves, is_touched = relocate_in_place(draft, around, suspects, least)
        if moves == 0:
            break
        among = np.flatnonzero(is_touched)
        with clock("swap"):
            more, is_settled = swap_in_place(points, draft.corners, draft.twins, is_touched=is_touched)
        n_swaps, n_moves = n_swaps + more, n_moves + moves
    return Swapped(draft.corners.reshape(-1, 3), n_swaps, is_settled), n_moves
