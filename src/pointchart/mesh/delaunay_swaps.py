"""Edge swaps in space: from the triangulation of the parameters to the Delaunay mesh of the surface."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points, check_triangles
from .._kernels.mesh.swaps import MOST_SWAPS_OF_A_TRIANGLE, are_joined, delaunay_swaps, swap
from ..typing import UV, Indices, Loop, Mask, Points, Triangles
from .connectivity import HalfEdges, half_edges

STRAIGHT = 1e-9  # sine of the turn under which boundary points lie on one side of the domain


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


def keep_edges(points: Points, triangles: Triangles) -> Swapped:
    """Leave the triangulation of the parameters as it is."""
    return Swapped(triangles, 0, True)


def swap_off_sides(mesh: Swapped, loop: Loop, boundary_uv: UV) -> Swapped:
    """Swap away inner edges whose two ends lie on the same straight side of the domain.

    They are the one exception of Tutte's theorem: such an edge is mapped into the side, and its triangles go flat. On a
    circle there are none. An edge that cannot be swapped stays, and shows in the certificate.

    Parameters
    ----------
    mesh : Swapped
    loop : (b,) int64 array
        Boundary, anticlockwise.
    boundary_uv : (b, 2) array
        Where it is laid out.

    Returns
    -------
    Swapped

    References
    ----------
    Floater 2003, One-to-one piecewise linear mappings over triangulations, theorem 4.1.

    Examples
    --------
    >>> import numpy as np
    >>> square = np.array([[0.0, 0.0], [1, 0], [2, 0], [2, 2], [0, 2]])
    >>> ear = Swapped(np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]]), 0, True)
    >>> swap_off_sides(ear, np.arange(5), square).n_swaps
    1
    """
    if _is_corner(boundary_uv).all():
        return mesh
    ahead, behind = _sides(mesh.triangles.max() + 1, loop, boundary_uv)
    edges = half_edges(mesh.triangles, len(ahead))
    n_swaps, improves = 0, True
    while improves:
        flat = np.flatnonzero(
            _share_a_side(ahead, behind, edges.origins, edges.targets) & (edges.twins > np.arange(len(edges.twins)))
        )
        done = sum(_swap_off(edges, h, ahead, behind) for h in flat.tolist())
        n_swaps, improves = n_swaps + done, done > 0
        if improves:
            edges = half_edges(edges.origins.reshape(-1, 3), len(ahead))
    return Swapped(edges.origins.reshape(-1, 3), mesh.n_swaps + n_swaps, mesh.is_settled)


def _sides(n_points: int, loop: Loop, boundary_uv: UV) -> tuple[Indices, Indices]:
    """Return the number of the straight side ahead of each boundary point, and of that behind it; -1 elsewhere."""
    is_corner = _is_corner(boundary_uv)
    side = (np.cumsum(is_corner) - 1) % max(is_corner.sum(), 1)
    ahead, behind = np.full(n_points, -1), np.full(n_points, -1)
    ahead[loop], behind[loop] = side, np.roll(side, 1)
    return ahead, behind


def _is_corner(boundary_uv: UV) -> Mask:
    steps = np.roll(boundary_uv, -1, axis=0) - boundary_uv
    before = np.roll(steps, 1, axis=0)
    turn = before[:, 0] * steps[:, 1] - before[:, 1] * steps[:, 0]
    return np.asarray(turn > STRAIGHT * np.linalg.norm(steps, axis=1) * np.linalg.norm(before, axis=1))


def _share_a_side(ahead: Indices, behind: Indices, a: Indices, b: Indices) -> Mask:
    same = (ahead[a] == ahead[b]) | (ahead[a] == behind[b]) | (behind[a] == ahead[b]) | (behind[a] == behind[b])
    return np.asarray(same & (ahead[a] >= 0) & (ahead[b] >= 0))


def _swap_off(edges: HalfEdges, h: int, ahead: Indices, behind: Indices) -> bool:
    """Swap half-edge h if it still lies along a side and its replacement does not."""
    corners, t = edges.origins, int(edges.twins[h])
    h_back, t_back = h - h % 3 + (h + 2) % 3, t - t % 3 + (t + 2) % 3
    one, other = corners[[h, h_back]], corners[[t, t_back]]
    if _share_a_side(ahead, behind, one, other).tolist() != [True, False]:
        return False
    if are_joined(corners, edges.twins, h_back, int(other[1])):
        return False
    swap(corners, edges.twins, h)
    return True
