"""Where a mesh bridges gaps: triangles much longer than the points are apart."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .mesh import half_edges
from .typing import Floats, Indices, Points, Triangles

LONG_EDGE = 4.0  # local spacings


@dataclass(frozen=True, slots=True, eq=False)
class Bridge:
    """A patch of triangles with edges of more than four local spacings.

    Attributes
    ----------
    triangles : (k,) int64
        Its triangles.
    points : (c,) int64
        Their corners.
    rim_length : float
        Length of its rim, in the unit of the points.
    """

    triangles: Indices
    points: Indices
    rim_length: float


def find_bridges(points: Points, triangles: Triangles, spacing: Floats) -> list[Bridge]:
    """Find the patches of a mesh that bridge gaps between the points, the longest rim first.

    A gap of the scan is bridged by a few long triangles. A bridge with a rim comparable to the boundary means another
    boundary, so that the surface is no disc.

    Examples
    --------
    >>> square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> faces = np.array([[0, 1, 2], [0, 2, 3]])
    >>> find_bridges(square, faces, np.ones(4)), find_bridges(square, faces, np.full(4, 0.2))[0].rim_length
    ([], 4.0)
    """
    edges = half_edges(triangles, len(points))
    lengths = np.linalg.norm(points[edges.targets] - points[edges.origins], axis=1)
    is_long = lengths > LONG_EDGE * np.maximum(spacing[edges.origins], spacing[edges.targets])
    bridging = is_long.reshape(-1, 3).any(axis=1)
    inner = np.flatnonzero(edges.twins >= 0)
    both = inner[bridging[inner // 3] & bridging[edges.twins[inner] // 3]]
    graph = sp.coo_array((np.ones(len(both)), (both // 3, edges.twins[both] // 3)), shape=(len(triangles),) * 2)
    labels = sp.csgraph.connected_components(graph.tocsr(), directed=False)[1]
    is_rim = np.repeat(bridging, 3)
    is_rim[both] = False
    rim_lengths = np.bincount(np.repeat(labels, 3)[is_rim], lengths[is_rim], labels.max() + 1)
    bridges = []
    # Triangles that bridge nothing are components of their own, and left out.
    found = np.flatnonzero(bridging)
    by_label = found[np.argsort(labels[found], kind="stable")]
    for members in np.split(by_label, np.flatnonzero(np.diff(labels[by_label])) + 1) if len(found) else []:
        label = labels[members[0]]
        bridges.append(Bridge(members, np.unique(triangles[members]), float(rim_lengths[label])))
    return sorted(bridges, key=lambda bridge: -bridge.rim_length)
