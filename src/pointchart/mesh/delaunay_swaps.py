"""Edge swaps in space: from the triangulation of the parameters to the Delaunay mesh of the surface."""

from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points, check_triangles
from .._kernels.mesh.swaps import MOST_SWAPS_OF_A_TRIANGLE, delaunay_swaps
from ..typing import Indices, Mask, Points, Triangles
from .connectivity import half_edges
from .swap_rule import Swapped, Swaps


@partial(Swaps, is_delaunay=True)
def swap_to_delaunay(points: ArrayLike, triangles: Triangles) -> Swapped:
    r"""Swap edges until each is the better diagonal of its two triangles, by angles measured in space.

    Edge ab of triangles abc and bad gives way to cd when the angles opposite to it sum to more than those opposite to
    cd:

    .. math:: \gamma_c + \gamma_d > \gamma_a + \gamma_b

    In a plane the four angles sum to :math:`2 \pi`, so this is the Delaunay criterion :math:`\gamma_c + \gamma_d >
    \pi`; in space, where they sum to less and both diagonals may pass that test, it takes the better one. An edge
    stays when its replacement is in the mesh already, and the boundary never changes. Every map of the right topology
    ends in nearly the same mesh.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
        A manifold mesh.

    Returns
    -------
    Swapped

    References
    ----------
    Floater and Reimers 2001, section 6 (swapping); Dyn, Hormann, Kim and Levin 2001, Optimizing 3D triangulations using
    discrete curvature analysis.

    Examples
    --------
    >>> flat_kite = [[0, 0, 0], [9, 0, 0], [4, 1, 0], [4, -1, 0]]
    >>> swap_to_delaunay(flat_kite, [[0, 1, 2], [1, 0, 3]]).triangles.tolist()
    [[3, 1, 2], [2, 0, 3]]
    """
    cloud = check_points(points)
    edges = half_edges(check_triangles(triangles, len(cloud)), len(cloud))
    n_swaps, is_settled = swap_in_place(cloud, edges.origins, edges.twins)
    return Swapped(edges.origins.reshape(-1, 3), n_swaps, is_settled)


def swap_in_place(
    points: Points, corners: Indices, twins: Indices, *, is_touched: Mask | None = None
) -> tuple[int, bool]:
    """Swap edges of half-edges as `swap_to_delaunay` does, beginning with all, or those of triangles at some points.

    Returns
    -------
    n_swaps : int
    is_settled : bool
    """
    turns, stack = np.zeros(len(corners) // 3, np.int32), np.empty_like(corners)
    asked = twins > np.arange(len(twins), dtype=twins.dtype)
    if is_touched is not None:
        asked &= np.repeat(is_touched[corners].reshape(-1, 3).any(axis=1), 3)
    n_swaps, made = 0, 1
    while made > 0 and asked.any():
        begin, barred = np.flatnonzero(asked), np.zeros(len(corners), np.bool_)
        stack[: len(begin)] = begin
        made = delaunay_swaps(points, corners, twins, stack, len(begin), asked, turns, barred)
        n_swaps, asked = n_swaps + int(made), barred
    return n_swaps, bool(np.all(turns < MOST_SWAPS_OF_A_TRIANGLE))


@partial(Swaps, from_delaunay=False)
def keep_edges(points: ArrayLike, triangles: Triangles) -> Swapped:
    """Leave the triangulation of the parameters as it is."""
    return Swapped(triangles, 0, True)
