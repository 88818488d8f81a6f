"""Loops from agreeing stars: the triangles that neighbouring stars share form a surface with rims."""

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points
from .._kernels.rims import JOINED, TWISTED, count_votes, draw_tight, fill_sides, keep_manifold, name_edges, walk_rims
from .._parallel import over_ranges
from ..errors import InputError
from ..neighbors import Neighborhoods
from ..typing import Floats, Indices, Loop, Mask, Points, Triangles

LEAST_VOTES = 2
WIDEST = 2.0  # circumradius of the largest triangle taken, in local spacings


def agreed_triangles(points: ArrayLike, star: Neighborhoods, spacing: Floats) -> Triangles:
    """Collect the triangles that at least two stars hold, the best ones where three would share an edge.

    Parameters
    ----------
    points : (n, 3) array
    star : Neighborhoods
        Delaunay stars.
    spacing : (n,) array
        Local spacing: triangles with a circumradius over two spacings bridge a gap and are left out.

    Returns
    -------
    (m, 3) int64 array, of no particular orientation; every edge has one or two triangles.
    """
    cloud = check_points(points)
    if star.is_open is None:
        raise InputError("only ordered neighbourhoods hold triangles; use Delaunay stars")
    votes = np.empty(len(star.indices), np.int64)
    over_ranges(
        lambda first, last: count_votes(star.indptr, star.indices, star.is_open, first, last, votes), len(cloud)
    )
    held = np.flatnonzero(votes >= LEAST_VOTES)
    rows = star.rows[held]
    following = np.where(held + 1 < star.indptr[rows + 1], held + 1, star.indptr[rows])
    triangles = np.column_stack([rows, star.indices[held], star.indices[following]])
    width = circumradii(cloud, triangles) / spacing[triangles].max(axis=1)
    narrow = width < WIDEST
    order = np.lexsort((width[narrow], -votes[held][narrow]))
    candidates = np.ascontiguousarray(triangles[narrow][order])
    edge_of, sides, _ = _edges(candidates, len(cloud))
    m = len(candidates)
    outcome = np.empty(m, np.int64)
    keep_manifold(candidates, edge_of, sides, np.empty(m, np.int64), np.empty(m, np.bool_), outcome)
    return np.concatenate([candidates[outcome == JOINED], candidates[outcome == TWISTED]])


def tightened(points: ArrayLike, triangles: Triangles, is_boundary: Mask) -> Triangles:
    """Draw the rims of a surface tighter, so that boundary points that they jump over come to lie on them.

    A triangle on a rim goes when its inner corner scores as a boundary point and sees the rim edge under more than a
    right angle; so the triangles behind it. No point is lost, and the topology stays.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
        Every edge has one or two triangles.
    is_boundary : (n,) bool array

    Returns
    -------
    (k, 3) int64 array: the triangles left.

    Examples
    --------
    >>> points = [[0, 0, 0], [2, 0, 0], [1, 0.5, 0], [1, 2, 0]]
    >>> tightened(points, np.array([[0, 1, 2], [1, 3, 2], [3, 0, 2]]), np.ones(4, bool)).tolist()
    [[1, 3, 2], [3, 0, 2]]
    """
    cloud = check_points(points)
    edge_of, sides, ends = _edges(triangles, len(cloud))
    fill_sides(edge_of, sides)
    removed, queue = np.zeros(len(triangles), np.bool_), np.empty(len(ends) + 2 * len(triangles), np.int64)
    draw_tight(cloud, triangles, ends, edge_of, sides, is_boundary, np.zeros(len(cloud), np.bool_), queue, removed)
    return triangles[~removed]


def rims(triangles: Triangles, n_points: int) -> list[Loop]:
    """Walk the rims of a surface whose edges have one or two triangles: simple loops, in order, of either direction.

    Where a rim passes a point twice, it is split into loops that pass it once.

    Examples
    --------
    >>> bow_tie = np.array([[0, 1, 2], [0, 3, 4]])
    >>> [loop.tolist() for loop in rims(bow_tie, 5)]
    [[2, 0, 1], [4, 0, 3]]
    """
    edge_of, sides, ends = _edges(triangles, n_points)
    fill_sides(edge_of, sides)
    walk, starts = np.empty(len(ends) + 1, np.int64), np.empty(len(ends) + 1, np.int64)
    count = walk_rims(ends, edge_of, sides, np.zeros(len(ends), np.bool_), walk, starts)
    return [loop for k in range(count) for loop in _simple(walk[starts[k] : starts[k + 1]])]


def _edges(triangles: Triangles, n_points: int) -> tuple[Indices, Indices, Indices]:
    """Return the edges of each triangle, an empty place for two triangles at each edge, and the ends of the edges."""
    edge_of, ends = np.empty((len(triangles), 3), np.int64), np.empty((3 * len(triangles), 2), np.int64)
    count = name_edges(triangles, np.empty(n_points + 1, np.int64), ends, edge_of)
    return edge_of, np.full((count, 2), -1, np.int64), ends[:count]


def _simple(walk: Indices) -> list[Loop]:
    """Cut a closed walk into loops that pass no point twice."""
    loops: list[Loop] = []
    path: list[int] = []
    place: dict[int, int] = {}
    for point in [*walk.tolist(), int(walk[0])]:
        if point in place:
            at = place[point]
            loops.append(np.array([*path[at + 1 :], point], dtype=np.int64))
            for left in path[at + 1 :]:
                del place[left]
            del path[at + 1 :]
        else:
            place[point] = len(path)
            path.append(point)
    return [loop for loop in loops if len(loop) >= 3]


def circumradii(points: Points, triangles: Triangles) -> Floats:
    """Return the circumradius of each triangle, (m,), in the unit of the points; infinite for flat ones."""
    corner = points[triangles]
    a, b, c = (np.linalg.norm(corner[:, (k + 1) % 3] - corner[:, (k + 2) % 3], axis=1) for k in range(3))
    twice_area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    return np.asarray(a * b * c / np.maximum(2.0 * twice_area, 1e-300))
