"""Delaunay meshes of scattered parameters, trimmed to the ragged outline of a scan."""

from heapq import heapify, heappop, heappush

import numpy as np
from scipy.spatial import Delaunay, cKDTree

from pointchart.typing import UV, Floats, Indices, Mask, Triangles


def delaunay(uv: UV) -> Triangles:
    """Triangulate the convex hull of scattered parameters.

    Parameters
    ----------
    uv : (n, 2) float64
        Well-spaced: distances near the rounding error are beyond this function.

    Returns
    -------
    (m, 3) int64
        Anticlockwise.

    Examples
    --------
    >>> import numpy as np
    >>> delaunay(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.3, 0.3]])).shape
    (3, 3)
    """
    triangles: Triangles = Delaunay(uv).simplices.astype(np.int64)
    return triangles


def ragged_delaunay(uv: UV, *, limit: float = 3.0) -> Triangles:
    """Triangulate scattered parameters inside the outline that their own spacing suggests.

    Triangles of the hull are peeled off behind boundary edges longer than `limit` local spacings, the longest first,
    but only when the third corner lies inside: so the mesh stays a disc and keeps every point.

    Parameters
    ----------
    uv : (n, 2) float64
    limit : float
        In local spacings: the mean distance of the two nearest points, averaged over the two ends.

    Returns
    -------
    (m, 3) int64
        Anticlockwise.

    Examples
    --------
    A square with a bay in its left side, whose opening is four spacings wide:

    >>> import numpy as np
    >>> uv = np.array([[x, y] for x in range(9) for y in range(9) if x > 4 or not 2 < y < 6], dtype=float)
    >>> len(ragged_delaunay(uv, limit=2)) < len(delaunay(uv))
    True
    """
    hull = Delaunay(uv)
    triangles: Triangles = hull.simplices.astype(np.int64)
    kept: Triangles = triangles[_peel(triangles, hull.neighbors, _edge_lengths_in_spacings(uv, triangles), limit)]
    return kept


def _edge_lengths_in_spacings(uv: UV, triangles: Triangles) -> Floats:
    """Measure the edge opposite each corner, (m, 3)."""
    start, end = triangles[:, [1, 2, 0]], triangles[:, [2, 0, 1]]
    length = np.linalg.norm(uv[end] - uv[start], axis=2)
    # A tip of the hull sees many far points along the outline, so only its nearest neighbours tell the spacing.
    two_nearest = cKDTree(uv).query(uv, k=3)[0][:, 1:]
    spacing = two_nearest.mean(axis=1)
    ratio: Floats = 2 * length / (spacing[start] + spacing[end])
    return ratio


def _peel(triangles: Triangles, neighbors: Indices, length: Floats, limit: float) -> Mask:
    kept = np.ones(len(triangles), dtype=np.bool_)
    rim = np.argwhere(neighbors < 0)
    on_rim = np.zeros(triangles.max() + 1, dtype=np.bool_)
    on_rim[triangles[rim[:, 0], (rim[:, 1] + 1) % 3]] = True
    heap = [(-length[t, k], t, k) for t, k in rim.tolist() if length[t, k] > limit]
    heapify(heap)
    while heap:
        _, t, k = heappop(heap)
        if on_rim[triangles[t, k]]:
            continue
        kept[t] = False
        on_rim[triangles[t, k]] = True
        for behind in neighbors[t, [(k + 1) % 3, (k + 2) % 3]].tolist():
            opposite = neighbors[behind].tolist().index(t)
            if length[behind, opposite] > limit:
                heappush(heap, (-length[behind, opposite], behind, opposite))
    return kept
