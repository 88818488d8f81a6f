"""Loops from an agreed surface: its rims, drawn tight."""

import numpy as np

from .._kernels.boundary.rim_walks import draw_tight, walk_rims
from ..agreement.agreed_surface import AgreedSurface
from ..points.surroundings import Vicinity
from ..typing import Indices, Loop, Mask, Points

# Spacings of an edge across a slot: those of an even sampling have two, the diameter of a star in no doubt.
WIDE = 2.5


def without_slots(cloud: Points, surface: AgreedSurface, is_boundary: Mask, near: Vicinity) -> AgreedSurface:
    """Leave out triangles across slots: two corners score as boundary points, and two edges are long.

    Where a slot is no wider than a triangle may be, stars on both sides agree across it. The length is told in
    spacings further in, as that of a boundary point counts the gap beside it.

    Parameters
    ----------
    cloud : (n, 3) float64 array
    surface : AgreedSurface
    is_boundary : (n,) bool array
    near : Vicinity

    Returns
    -------
    AgreedSurface

    Examples
    --------
    >>> from pointchart import shapes
    >>> from pointchart.agreement.agreed_surface import patchwork
    >>> from pointchart.points.surroundings import explore
    >>> sheets = np.r_[shapes.grid(5, 9).points, shapes.grid(5, 9).points + [7.4, 0, 0]]
    >>> across = patchwork([[4, 45, 50], [4, 50, 9], [0, 1, 5]], 90)
    >>> without_slots(sheets, across, np.ones(90, bool), explore(sheets)).triangles.tolist()
    [[0, 1, 5]]
    """
    chosen = np.flatnonzero(is_boundary[surface.triangles].sum(axis=1) >= 2)
    corners = surface.triangles[chosen]
    near_each = near.around.indices.reshape(len(cloud), -1)
    usual = np.median(near.spacing[near_each[corners]], axis=2).max(axis=1)
    edges = np.linalg.norm(cloud[corners] - cloud[np.roll(corners, -1, axis=1)], axis=2)
    dropped = np.zeros(len(surface.triangles), np.bool_)
    dropped[chosen[(edges > WIDE * usual[:, None]).sum(axis=1) >= 2]] = True
    return surface.without(dropped)


def tightened(cloud: Points, surface: AgreedSurface, is_boundary: Mask) -> AgreedSurface:
    """Draw the rims of a surface tighter, so that boundary points that they jump over come to lie on them.

    A triangle on a rim goes when its inner corner scores as a boundary point and sees the rim edge under more than a
    right angle; so the triangles behind it. No point is lost, and the topology stays.

    Parameters
    ----------
    cloud : (n, 3) float64 array
    surface : AgreedSurface
    is_boundary : (n,) bool array

    Returns
    -------
    AgreedSurface
        The triangles left.

    Examples
    --------
    >>> from pointchart.agreement.agreed_surface import patchwork
    >>> points = np.array([[0.0, 0, 0], [2, 0, 0], [1, 0.5, 0], [1, 2, 0]])
    >>> surface = patchwork([[0, 1, 2], [1, 3, 2], [3, 0, 2]], 4)
    >>> tightened(points, surface, np.ones(4, bool)).triangles.tolist()
    [[1, 3, 2], [3, 0, 2]]
    """
    m = len(surface.triangles)
    n_rim = int(((surface.sides[:, 0] >= 0) & (surface.sides[:, 1] < 0)).sum())
    removed, queue = np.zeros(m, np.bool_), np.empty(n_rim + 2 * m, np.int32)
    on_rim = np.zeros(len(cloud), np.bool_)
    draw_tight(
        cloud, surface.triangles, surface.ends, surface.edge_of, surface.sides, is_boundary, on_rim, queue, removed
    )
    return surface.without(removed)


def rims(surface: AgreedSurface) -> list[Loop]:
    """Walk the rims of a surface: simple loops, in order, of either direction.

    Where a rim passes a point twice, it is split into loops that pass it once.

    Examples
    --------
    >>> from pointchart.agreement.agreed_surface import patchwork
    >>> bow_tie = patchwork([[0, 1, 2], [0, 3, 4]], 5)
    >>> [loop.tolist() for loop in rims(bow_tie)]
    [[2, 0, 1], [4, 0, 3]]
    """
    ends, sides = surface.ends, surface.sides
    n_rim = int(((sides[:, 0] >= 0) & (sides[:, 1] < 0)).sum())
    walk, starts = np.empty(n_rim + 1, np.int64), np.empty(n_rim + 1, np.int64)
    count = walk_rims(ends, surface.edge_of, sides, np.zeros(len(ends), np.bool_), walk, starts)
    return [loop for k in range(count) for loop in _simple(walk[starts[k] : starts[k + 1]])]


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
