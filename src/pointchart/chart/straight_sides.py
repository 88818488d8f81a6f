"""Inner edges along the straight sides of a domain, swapped away before the mesh is mapped."""

import numpy as np

from .._kernels.mesh.swaps import are_joined, swap
from ..mesh.connectivity import HalfEdges, half_edges
from ..mesh.swap_rule import Swapped
from ..plane.polygons import sides_at
from ..plane.vectors import cross
from ..typing import UV, Indices, Loop, Mask

STRAIGHT = 1e-9  # sine of the turn under which boundary points lie on one side of the domain


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
    behind, ahead = sides_at(boundary_uv)
    slack = STRAIGHT * np.linalg.norm(ahead, axis=1) * np.linalg.norm(behind, axis=1)
    return np.asarray(cross(behind, ahead) > slack)


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
