"""A disc from the triangles on which stars agree: oriented alike, and closed where they leave pockets."""

from dataclasses import dataclass

import numpy as np

from .._kernels.mesh.half_edges import pair_half_edges
from .._kernels.mesh.pinches import cut_walks, keep_largest, mark_pinching, mark_rims, to_half_edges
from .._kernels.mesh.pockets import cap
from .._kernels.unsigned import unsigned
from ..agreement.agreed_surface import AgreedSurface
from ..boundary import is_same_loop
from ..typing import Indices, Loop, Points, Triangles

ROUNDS = 10  # of pinches: dropping a fan may leave others


@dataclass(frozen=True, slots=True, eq=False)
class Assembled:
    """A disc that was assembled.

    Attributes
    ----------
    triangles : (m, 3) int64
        On all points, with the boundary asked for.
    n_pockets : int
        Loops that were closed.
    """

    triangles: Triangles
    n_pockets: int


def assemble(points: Points, surface: AgreedSurface, loop: Loop) -> Assembled | None:
    """Complete a surface of triangles to a disc on all points, with a given boundary.

    Where stars agree, the mesh is there already. What is missing are pockets of a few triangles, mostly where four
    points lie on a circle, and gaps of the scan. So the surface is given one orientation and cleared of pinches, and
    its Euler characteristic tells whether it is a disc but for its pockets, which are closed by cutting ears.

    Parameters
    ----------
    points : (n, 3) float64 array
    surface : AgreedSurface
        Its largest part is taken.
    loop : (b,) int64 array
        The boundary, in the direction that the result shall have.

    Returns
    -------
    Assembled or None
        None if the surface is no disc but for pockets, has another boundary or does not reach all points: then a map
        has to tell.

    Examples
    --------
    >>> from pointchart.agreement.agreed_surface import patchwork
    >>> pyramid = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 1]])
    >>> sides = patchwork([[0, 1, 4], [1, 4, 2], [2, 3, 4], [4, 0, 3]], 5)
    >>> assemble(pyramid, sides, np.array([3, 2, 1, 0])).triangles.tolist()
    [[4, 1, 0], [4, 2, 1], [4, 3, 2], [0, 3, 4]]
    """
    n = len(points)
    cleared = _cleared(surface.extended(loop), loop)
    if cleared is None:
        return None
    corners, twins, loops = cleared
    n_edges = (len(corners) + int((twins < 0).sum())) // 2
    n_used = np.count_nonzero(np.bincount(corners, minlength=n))
    outer = [k for k, rim in enumerate(loops) if is_same_loop(corners[rim], loop)]
    if n_used < n or n_used - n_edges + len(corners) // 3 + len(loops) != 2 or len(outer) != 1:
        return None
    free, pockets = len(corners) // 3, loops[: outer[0]] + loops[outer[0] + 1 :]
    room = np.full(3 * (2 * n - 2 - len(loop)) - len(corners), -1, np.int32)
    closed, twins = np.concatenate([corners, room]), np.concatenate([twins, room])
    for pocket in pockets:
        free = cap(points, closed, twins, pocket, free)
        if free < 0:
            return None
    # An ear does not see all fans of a point at which pockets touch.
    if pair_half_edges(unsigned(closed), n, twins) > 0:
        return None
    triangles = closed.reshape(-1, 3)
    place = int(np.flatnonzero(corners[loops[outer[0]]] == loop[0])[0])
    runs_along = corners[loops[outer[0]][(place + 1) % len(loop)]] == loop[1]
    return Assembled(triangles if runs_along else np.ascontiguousarray(triangles[:, ::-1]), len(pockets))


def _cleared(surface: AgreedSurface, loop: Loop) -> tuple[Indices, Indices, list[Indices]] | None:
    """Drop fans at which a surface is pinched, other than by pockets that touch; None if that goes on and on.

    Returns corners and twins of the half-edges that are left, and the half-edges of each loop of their boundary.
    """
    n = surface.n_points
    ahead, behind = np.full(n, -1, np.int32), np.full(n, -1, np.int32)
    ahead[loop], behind[loop] = np.roll(loop, -1), np.roll(loop, 1)
    is_kept = surface.largest
    for _ in range(ROUNDS):
        number = np.where(is_kept, np.cumsum(is_kept, dtype=np.int32) - 1, -1)
        m = int(np.count_nonzero(is_kept))
        corners, twins, rim = (np.empty(3 * m, np.int32) for _ in range(3))
        to_half_edges(surface.triangles, surface.edge_of, surface.sides, number, corners, twins)
        mark_rims(twins, rim)
        still, first = np.ones(m, np.bool_), np.full(n, -1, np.int32)
        if mark_pinching(corners, twins, rim, ahead, behind, first, still) == 0:
            n_rim = int((twins < 0).sum())
            loops, starts, path = np.empty(n_rim, np.int64), np.empty(n_rim + 1, np.int64), np.empty(n_rim, np.int64)
            place = np.full(n, -1, np.int32)
            count, n_tangled = cut_walks(corners, twins, ahead, behind, place, path, loops, starts, still)
            if n_tangled == 0:
                return corners, twins, np.split(loops, starts[1:count])
        keep_largest(twins, still)
        is_kept[np.flatnonzero(is_kept)[~still]] = False
    return None
