"""Where a mesh bridges gaps: triangles much longer than the points are apart."""

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .._kernels.mesh.half_edges import measure_edges
from .._parallel import over_ranges
from ..mesh.connectivity import half_edges
from ..typing import Floats, Indices, Mask, Points, Triangles

LONG_EDGE = 4.0  # local spacings
GAP_SHARE = 0.5  # of a bridge's corners that score as boundary points, from which on it lies over a gap of the scan


@dataclass(frozen=True, slots=True, eq=False)
class Bridge:
    """A patch of triangles with edges of more than four local spacings.

    Attributes
    ----------
    points : (c,) int64
        Corners of its triangles.
    n_triangles : int
    rim_length : float
        Length of its rim, in the unit of the points.
    rim_in_spacings : float
        The same, in spacings of its corners.
    share : float
        Share of its corners that score as boundary points, in [0, 1].
    """

    points: Indices
    n_triangles: int
    rim_length: float
    rim_in_spacings: float
    share: float

    @property
    def is_gap(self) -> bool:
        """Whether it bridges a gap of the scan: the scan ends along it. Otherwise the mesh is in doubt there."""
        return self.share >= GAP_SHARE


@dataclass(frozen=True, slots=True, eq=False)
class BridgedPatch(Bridge):
    """A bridge with the places of its triangles in the mesh.

    Attributes
    ----------
    triangles : (k,) int64
    """

    triangles: Indices

    def called(self, names: Indices) -> Bridge:
        """Return what is known of the bridge, with point i called ``names[i]``."""
        return Bridge(names[self.points], self.n_triangles, self.rim_length, self.rim_in_spacings, self.share)


def find_bridges(
    points: Points, triangles: Triangles, spacing: Floats, is_boundary: Callable[[], Mask]
) -> list[BridgedPatch]:
    """Find the patches of a mesh that bridge gaps between the points, the longest rim first.

    A gap of the scan is bridged by a few long triangles. Bridges where the scan has no gap mean that the points do not
    lie on the disc that they were made into, or that the mesh is wrong there.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
    spacing : (n,) array
        Local spacing.
    is_boundary : callable
        Gives (n,) bool, which points score as boundary points; asked only if there is a bridge.

    Returns
    -------
    list of BridgedPatch

    Examples
    --------
    >>> square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> faces = np.array([[0, 1, 2], [0, 2, 3]])
    >>> find_bridges(square, faces, np.ones(4), lambda: np.ones(4, bool))
    []
    >>> find_bridges(square, faces, np.full(4, 0.2), lambda: np.ones(4, bool))[0].rim_in_spacings
    20.0
    """
    # Lengths alone, for which no half-edge needs its twin.
    origins = np.asarray(triangles, np.int32).ravel()
    alone, ratios = np.full_like(origins, -1), np.empty(len(origins))
    over_ranges(
        lambda first, last: measure_edges(points, origins, alone, spacing, -1.0, first, last, ratios), len(ratios)
    )
    found = np.unique(np.flatnonzero(ratios > LONG_EDGE) // 3)
    if len(found) == 0:
        return []
    edges = half_edges(triangles, len(points))
    place = np.full(len(triangles), -1)
    place[found] = np.arange(len(found))
    sides = 3 * found[:, None] + np.arange(3)
    beside = np.where(edges.twins[sides] >= 0, place[edges.twins[sides] // 3], -1)
    rows, columns = np.repeat(np.arange(len(found)), 3)[beside.ravel() >= 0], beside[beside >= 0]
    graph = sp.coo_array((np.ones(len(rows)), (rows, columns)), shape=(len(found),) * 2)
    labels = sp.csgraph.connected_components(graph.tocsr(), directed=False)[1]
    is_rim = beside < 0
    ends = triangles[found], np.roll(triangles[found], -1, axis=1)
    lengths = np.linalg.norm(points[ends[1]] - points[ends[0]], axis=2)
    rim_lengths = np.bincount(np.repeat(labels, 3)[is_rim.ravel()], lengths[is_rim], labels.max() + 1)
    bridges = []
    scores = is_boundary()
    by_label = np.argsort(labels, kind="stable")
    for group in np.split(by_label, np.flatnonzero(np.diff(labels[by_label])) + 1):
        members, length = found[group], float(rim_lengths[labels[group[0]]])
        corners = np.unique(triangles[members])
        in_spacings, share = length / float(np.median(spacing[corners])), float(scores[corners].mean())
        bridges.append(BridgedPatch(corners, len(members), length, in_spacings, share, members))
    return sorted(bridges, key=lambda bridge: -bridge.rim_length)


def open_gaps(triangles: Triangles, patches: Iterable[Indices], n_points: int) -> tuple[Triangles, int]:
    """Take patches of triangles out of a mesh, leaving a hole for each.

    No point is lost and no hole touches another rim: triangles that this asks for stay.

    Parameters
    ----------
    triangles : (m, 3) int array
        A disc.
    patches : iterable of (k,) int arrays
        The triangles of each, joined by edges.
    n_points : int

    Returns
    -------
    triangles : (k, 3) int64 array
    n_holes : int
        Fewer than the patches, where one lies along the boundary.

    Examples
    --------
    >>> ring = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5], [3, 4, 5]])
    >>> open_gaps(ring, [np.array([6])], 6)[1]
    1
    """
    patches = list(patches)
    if not patches:
        return triangles, 0
    edges, removed = half_edges(triangles, n_points), np.zeros(len(triangles), np.bool_)
    on_rim, in_gap, n_holes = np.zeros(n_points, np.bool_), np.zeros(len(triangles), np.bool_), 0
    on_rim[edges.origins[edges.twins < 0]] = True
    for patch in patches:
        inner = patch[~on_rim[triangles[patch]].any(axis=1)]
        if len(inner) == 0:
            continue
        first, in_gap[patch], n_holes = int(inner[0]), True, n_holes + 1
        removed[first], on_rim[triangles[first]] = True, True
        queue = deque(edges.twins[3 * first : 3 * first + 3].tolist())
        while queue:
            half_edge = queue.popleft()
            triangle, side = divmod(half_edge, 3)
            opposite = triangles[triangle, (side + 2) % 3]
            if in_gap[triangle] and not removed[triangle] and not on_rim[opposite]:
                removed[triangle], on_rim[opposite] = True, True
                queue.extend(edges.twins[[3 * triangle + (side + 1) % 3, 3 * triangle + (side + 2) % 3]].tolist())
    return triangles[~removed], n_holes
