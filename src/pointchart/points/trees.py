"""Search trees over points."""

from typing import TYPE_CHECKING

import numpy as np

from .._kernels.points.box_tree import LEAF, bound_boxes, find_nearest
from .._parallel import over_ranges
from ..typing import Floats, Indices, Points

if TYPE_CHECKING:  # what a short run does not need is imported where it is used
    from scipy.spatial import cKDTree


class BoxTree:
    """A search tree over points that are in spatial order already; see `morton_order`.

    Parameters
    ----------
    points : (n, 3) float64 array

    Examples
    --------
    >>> BoxTree(np.array([[0.0, 0, 0], [1, 0, 0], [3, 0, 0], [3, 1, 0]])).nearest(1).tolist()
    [[1], [0], [3], [2]]
    """

    def __init__(self, points: Points) -> None:
        leaves = 1
        while leaves * LEAF < len(points):
            leaves *= 2
        self._points = points
        self._low, self._high = np.empty((2 * leaves, 3)), np.empty((2 * leaves, 3))
        bound_boxes(points, self._low, self._high)

    def nearest(self, k: int, queries: Indices | None = None) -> Indices:
        """Find the `k` nearest others, if there are as many, of some points or of all, nearest first: (q, k) int32."""
        points = self._points
        places = np.arange(len(points), dtype=np.uint32) if queries is None else queries.astype(np.uint32)
        found = np.empty((len(places), min(k, len(points) - 1)), np.uint32)
        if found.size == 0:
            return found.view(np.int32)

        def find(first: int, last: int) -> None:
            squares = np.empty((last - first, found.shape[1]))
            find_nearest(points, self._low, self._high, places[first:last], found[first:last], squares)

        over_ranges(find, len(places))
        return found.view(np.int32)


def search(tree: "cKDTree", points: Floats, k: int) -> tuple[Floats, Indices]:
    """Find the `k` nearest points of a tree on all cores.

    The tree's own threads outlive an interrupt and then read freed memory, so the threads are ours.

    Returns
    -------
    distance, index : (n, k) arrays, nearest first.
    """
    distance, index = np.empty((len(points), k)), np.empty((len(points), k), np.int64)

    def query(first: int, last: int) -> None:
        distance[first:last], index[first:last] = tree.query(points[first:last], k=np.arange(1, k + 1))

    over_ranges(query, len(points))
    return distance, index
