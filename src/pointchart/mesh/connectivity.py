"""The connectivity of a triangle mesh: half-edges, boundary loops, rings."""

from dataclasses import dataclass

import numpy as np

from .._check import check_triangles
from .._kernels.mesh.editable import EditableMesh
from .._kernels.mesh.half_edges import count_fans, order_rings, pair_half_edges
from .._kernels.unsigned import unsigned
from ..errors import InputError
from ..points.neighborhoods import Rings
from ..typing import Indices, Loop, Points, Triangles


@dataclass(frozen=True, slots=True, eq=False)
class HalfEdges:
    """The half-edges of a mesh; half-edge 3 t + k runs from corner k of triangle t to the next.

    Attributes
    ----------
    origins : (3 m,) int32
    twins : (3 m,) int32
        Opposite half-edges, -1 on the boundary.
    n_overfull : int
        Half-edges that share their direction with another one: more than two triangles at an edge, or triangles of
        opposite orientation.
    """

    origins: Indices
    twins: Indices
    n_overfull: int

    @property
    def targets(self) -> Indices:
        """Where the half-edges run to, (3 m,)."""
        return np.roll(self.origins.reshape(-1, 3), -1, axis=1).ravel()


def half_edges(triangles: Triangles, n_points: int) -> HalfEdges:
    """Pair the half-edges of a mesh.

    Examples
    --------
    >>> import numpy as np
    >>> half_edges(np.array([[0, 1, 2], [2, 1, 3]]), 4).twins.tolist()
    [-1, 3, -1, 1, -1, -1]
    """
    origins = np.array(triangles, dtype=np.int32).ravel()
    twins = np.empty_like(origins)
    overfull = pair_half_edges(unsigned(origins), n_points, twins)
    return HalfEdges(origins, twins, int(overfull))


def editable_mesh(points: Points, triangles: Triangles, *, journal: int) -> EditableMesh:
    """Copy a manifold mesh for edits that can be undone.

    Parameters
    ----------
    points : (n, 3) float64 array
    triangles : (m, 3) int64 array
        With every point in some triangle.
    journal : int
        Triangles that one edit may touch, each as often as it does.

    Returns
    -------
    EditableMesh

    Raises
    ------
    InputError
        If the mesh is no manifold, or a point is in no triangle.

    Examples
    --------
    >>> import numpy as np
    >>> draft = editable_mesh(np.eye(3), np.array([[0, 1, 2]]), journal=0)
    >>> draft.leaving.tolist()
    [0, 1, 2]
    """
    edges = half_edges(triangles, len(points))
    leaving = np.full(len(points), -1, np.int32)
    leaving[edges.origins] = np.arange(len(edges.origins), dtype=np.int32)
    if edges.n_overfull or (leaving < 0).any():
        raise InputError(
            f"the mesh is no manifold on its points: {edges.n_overfull} half-edges share their direction, and "
            f"{np.count_nonzero(leaving < 0)} points are in no triangle; take these points out and mend the edges"
        )
    return EditableMesh(points, edges.origins, edges.twins, leaving, np.empty((journal, 7), np.int64))


def boundary_loops(edges: HalfEdges) -> list[Loop]:
    """Walk the boundary of a manifold mesh: every loop with the surface on its left, the longest list first.

    Examples
    --------
    >>> import numpy as np
    >>> boundary_loops(half_edges(np.array([[0, 1, 2], [2, 1, 3]]), 4))
    [array([0, 1, 3, 2])]
    """
    rim = np.flatnonzero(edges.twins < 0)
    successor = dict(zip(edges.origins[rim].tolist(), edges.targets[rim].tolist(), strict=True))
    loops = []
    while successor:
        start, following = successor.popitem()
        loop = [start]
        while following != start and following in successor:
            loop.append(following)
            following = successor.pop(following)
        turn = loop.index(min(loop))
        loops.append(np.array(loop[turn:] + loop[:turn], dtype=np.int64))
    return sorted(loops, key=len, reverse=True)


def fans(edges: HalfEdges, n_points: int) -> Indices:
    """Count the fans of triangles at each point, (n,): 0 unused, 1 manifold, more where the mesh is pinched.

    Examples
    --------
    >>> import numpy as np
    >>> fans(half_edges(np.array([[0, 1, 2], [0, 3, 4]]), 6), 6)
    array([2, 1, 1, 1, 1, 0])
    """
    count = np.empty(n_points, np.int64)
    count_fans(edges.origins, edges.twins, count, np.empty(len(edges.origins), np.bool_))
    return count


def one_rings(triangles: Triangles, n_points: int) -> Rings:
    """Gather the neighbours of each point along the edges of a manifold mesh, anticlockwise.

    With mean value weights they give the map that Tutte's theorem guarantees to be one-to-one on a convex domain.

    Examples
    --------
    >>> import numpy as np
    >>> rings = one_rings(np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1]]), 4)
    >>> rings.sizes, rings.is_open
    (array([3, 3, 3, 3]), array([False,  True,  True,  True]))
    """
    return rings_of(check_triangles(triangles, n_points), n_points)


def rings_of(triangles: Triangles, n_points: int) -> Rings:
    """Gather rings as `one_rings` does, of triangles whose corners are known to be points."""
    edges = half_edges(triangles, n_points)
    pinched = int((fans(edges, n_points) > 1).sum())
    if edges.n_overfull or pinched:
        raise InputError(
            f"the mesh is no manifold: {edges.n_overfull} half-edges meet another of their direction and "
            f"{pinched} points have several fans of triangles, so there are no rings; repair it first"
        )
    first = np.full(n_points, -1, np.int64)
    first[edges.origins] = np.arange(len(edges.origins))
    sizes = np.bincount(edges.origins, minlength=n_points) + np.bincount(
        edges.targets[edges.twins < 0], minlength=n_points
    )
    indptr = np.concatenate([[0], np.cumsum(sizes)])
    indices, is_open = np.empty(indptr[-1], np.int32), np.empty(n_points, np.bool_)
    order_rings(edges.origins, edges.twins, first, indptr, indices, is_open)
    return Rings(indptr, indices, is_open)
