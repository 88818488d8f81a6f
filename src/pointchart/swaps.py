"""Edge swaps in space: from the triangulation of the parameters to the Delaunay mesh of the surface."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ._check import check_points
from ._kernels.swaps import MOST_SWAPS_OF_A_TRIANGLE, delaunay_swaps
from .mesh import half_edges
from .typing import Triangles


@dataclass(frozen=True, slots=True, eq=False)
class Swapped:
    """A mesh after edge swaps.

    Attributes
    ----------
    triangles : (m, 3) int64
        On the same points, with the same boundary.
    n_swaps : int
        Swaps that were made.
    is_settled : bool
        Whether no edge asks for another swap; False if some triangle reached the limit of swaps.
    """

    triangles: Triangles
    n_swaps: int
    is_settled: bool


def swap_to_delaunay(points: ArrayLike, triangles: Triangles) -> Swapped:
    r"""Swap edges until each is the better diagonal of its two triangles, by angles measured in space.

    Edge ab of triangles abc and bad gives way to cd when the angles opposite to it sum to more than those opposite to cd:

    .. math:: \gamma_c + \gamma_d > \gamma_a + \gamma_b

    In a plane the four angles sum to :math:`2 \pi`, so this is the Delaunay criterion
    :math:`\gamma_c + \gamma_d > \pi`; in space, where they sum to less and both diagonals may pass that test, it takes the
    better one. An edge stays when its replacement is in the mesh already, and the boundary never changes. Every map of the
    right topology ends in nearly the same mesh.

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
    >>> swap_to_delaunay(flat_kite, [[0, 1, 2], [1, 0, 3]]).triangles
    array([[3, 1, 2],
           [2, 0, 3]])
    """
    cloud = check_points(points)
    edges = half_edges(np.asarray(triangles), len(cloud))
    n = len(edges.origins)
    turns = np.zeros(n // 3, np.int64)
    n_swaps = delaunay_swaps(
        cloud, edges.origins, edges.twins, np.empty(n, np.int64), np.empty(n, np.bool_), turns
    )
    return Swapped(edges.origins.reshape(-1, 3), int(n_swaps), bool(np.all(turns < MOST_SWAPS_OF_A_TRIANGLE)))
