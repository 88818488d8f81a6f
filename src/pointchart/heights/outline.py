"""The outline of points in the plane: their convex hull, less what only long edges span."""

import heapq

import numpy as np

from ..mesh.connectivity import boundary_loops, half_edges
from ..typing import UV, Floats, Loop, Triangles

LONG_EDGE = 4.0  # times what edges around have: as with gaps that are bridged


def usual_lengths(uv: UV, triangles: Triangles, spacing: Floats) -> Floats:
    """Return how long edges at each point usually are, (n,): its spacing, or the median longest side if that is more.

    Points on contour lines or on lines of a scanner are close along them and far across: triangles join lines.
    """
    sides = uv[triangles] - uv[np.roll(triangles, -1, axis=1)]
    longest = np.sqrt(np.einsum("mij,mij->mi", sides, sides)).max(axis=1)
    return np.asarray(np.maximum(spacing, np.median(longest)))


def drawn_in(uv: UV, triangles: Triangles, usual: Floats) -> tuple[Triangles, Loop]:
    """Take triangles away from the outside while an edge of the outline is long and the point behind it inside.

    What is left is a disc on all points.

    Parameters
    ----------
    uv : (n, 2) array
    triangles : (m, 3) array
        A triangulation of the convex hull.
    usual : (n,) array
        How long edges are usually, at each point.

    Returns
    -------
    triangles : (k, 3) int64
    loop : (b,) int64
        The outline, anticlockwise.

    Examples
    --------
    >>> bay = np.array([[0.0, 0], [0, 1], [9, 1], [9, 0], [4.5, 0.1]])
    >>> hull = np.array([[0, 4, 1], [1, 4, 2], [2, 4, 3], [0, 3, 4]])
    >>> triangles, loop = drawn_in(bay, hull, np.ones(5))
    >>> len(triangles), sorted(loop.tolist())
    (3, [0, 1, 2, 3, 4])
    """
    edges = half_edges(triangles, len(uv))
    origins, twins = edges.origins, edges.twins
    ends = np.where(np.arange(len(origins)) % 3 == 2, np.arange(len(origins)) - 2, np.arange(len(origins)) + 1)
    outside, removed = np.zeros(len(uv), np.bool_), np.zeros(len(triangles), np.bool_)
    rim = np.flatnonzero(twins < 0)
    outside[origins[rim]] = True
    queue: list[tuple[float, int]] = []

    def consider(half_edge: int) -> None:
        a, b = origins[half_edge], origins[ends[half_edge]]
        length = float(np.hypot(*(uv[a] - uv[b])))
        if length > LONG_EDGE * max(usual[a], usual[b]):
            heapq.heappush(queue, (-length, half_edge))

    for half_edge in rim.tolist():
        consider(half_edge)
    while queue:
        _, half_edge = heapq.heappop(queue)
        following = int(ends[half_edge])
        preceding = int(ends[following])
        if outside[origins[preceding]]:
            continue
        removed[half_edge // 3] = outside[origins[preceding]] = True
        consider(int(twins[following]))
        consider(int(twins[preceding]))
    kept = triangles[~removed]
    return kept, boundary_loops(half_edges(kept, len(uv)))[0]
