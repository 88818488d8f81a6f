"""A disc from the triangles on which stars agree: oriented alike, and closed where they leave pockets."""

from dataclasses import dataclass

import numpy as np

from ._kernels.assemble import cap, cut_walks, keep_largest, mark_pinching, mark_rims, turn_alike
from ._kernels.half_edges import pair_half_edges
from ._kernels.rims import name_edges
from .boundary import is_same_loop
from .typing import Indices, Loop, Points, Triangles

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


def assemble(points: Points, surface: Triangles, loop: Loop) -> Assembled | None:
    """Complete a surface of triangles to a disc on all points, with a given boundary.

    Where stars agree, the mesh is there already. What is missing are pockets of a few triangles, mostly where four
    points lie on a circle, and gaps of the scan. So the surface is given one orientation and cleared of pinches, and
    its Euler characteristic tells whether it is a disc but for its pockets, which are closed by cutting ears.

    Parameters
    ----------
    points : (n, 3) float64 array
    surface : (m, 3) int array
        In any orientation, the best first; every edge has one or two triangles.
    loop : (b,) int64 array
        The boundary, in the direction that the result shall have.

    Returns
    -------
    Assembled or None
        None if the surface is no disc but for pockets, has another boundary or does not reach all points: then a map
        has to tell.

    Examples
    --------
    >>> pyramid = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 1]])
    >>> sides = np.array([[0, 1, 4], [1, 4, 2], [2, 3, 4], [4, 0, 3]])
    >>> assemble(pyramid, sides, np.array([3, 2, 1, 0])).triangles
    array([[4, 1, 0],
           [1, 2, 4],
           [2, 3, 4],
           [4, 3, 0]])
    """
    n = len(points)
    cleared = _cleared(_one_way(surface, n), n)
    if cleared is None:
        return None
    corners, twins, loops = cleared
    n_edges = (len(corners) + int((twins < 0).sum())) // 2
    n_used = np.count_nonzero(np.bincount(corners, minlength=n))
    outer = [k for k, rim in enumerate(loops) if is_same_loop(corners[rim], loop)]
    if n_used < n or n_used - n_edges + len(corners) // 3 + len(loops) != 2 or len(outer) != 1:
        return None
    free, pockets = len(corners) // 3, loops[: outer[0]] + loops[outer[0] + 1 :]
    room = np.full(3 * (2 * n - 2 - len(loop)) - len(corners), -1)
    closed, twins = np.concatenate([corners, room]), np.concatenate([twins, room])
    for pocket in pockets:
        free = cap(points, closed, twins, pocket, free)
        if free < 0:
            return None
    # An ear does not see all fans of a point at which pockets touch.
    if pair_half_edges(closed, n, twins) > 0:
        return None
    triangles = closed.reshape(-1, 3)
    place = int(np.flatnonzero(corners[loops[outer[0]]] == loop[0])[0])
    runs_along = corners[loops[outer[0]][(place + 1) % len(loop)]] == loop[1]
    return Assembled(triangles if runs_along else np.ascontiguousarray(triangles[:, ::-1]), len(pockets))


def _cleared(triangles: Triangles, n_points: int) -> tuple[Indices, Indices, list[Indices]] | None:
    """Drop fans at which a surface is pinched, other than by pockets that touch; None if that goes on and on.

    Returns corners and twins of the half-edges that are left, and the half-edges of each loop of their boundary.
    """
    for _ in range(ROUNDS):
        corners = triangles.ravel()
        twins, rim, is_kept = np.empty_like(corners), np.empty_like(corners), np.ones(len(triangles), np.bool_)
        pair_half_edges(corners, n_points, twins)
        mark_rims(twins, rim)
        if mark_pinching(corners, twins, rim, np.full(n_points, -1), is_kept) == 0:
            n_rim = int((twins < 0).sum())
            loops, starts, path = np.empty(n_rim, np.int64), np.empty(n_rim + 1, np.int64), np.empty(n_rim, np.int64)
            count, n_tangled = cut_walks(corners, twins, np.full(n_points, -1), path, loops, starts, is_kept)
            if n_tangled == 0:
                return corners, twins, np.split(loops, starts[1:count])
        keep_largest(twins, is_kept)
        triangles = triangles[is_kept]
    return None


def _one_way(surface: Triangles, n_points: int) -> Triangles:
    """Orient triangles alike, and keep the largest part of those that can be."""
    triangles, m = np.array(surface, dtype=np.int64), len(surface)
    edge_of, ends = np.empty((m, 3), np.int64), np.empty((3 * m, 2), np.int64)
    count = name_edges(triangles, np.empty(n_points + 1, np.int64), ends, edge_of)
    is_kept = np.empty(m, np.bool_)
    turn_alike(
        triangles, edge_of, np.empty((count, 2), np.int64), np.empty(m, np.int64), np.empty(m, np.bool_), is_kept
    )
    return triangles[is_kept]
