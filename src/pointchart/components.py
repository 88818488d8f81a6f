"""The parts that a scan falls into."""

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike

from .errors import InputError
from .neighbors import Neighborhoods, nearest
from .prepare import prepare
from .typing import Indices
from .vicinity import NEAREST


def label_parts(around: Neighborhoods) -> Indices:
    """Label the parts that neighbourhoods join, the largest 0, (n,).

    Examples
    --------
    >>> pairs = nearest([[0, 0, 0], [0, 1, 0], [9, 0, 0], [9, 1, 0], [9, 2, 0]], k=1)
    >>> label_parts(pairs)
    array([1, 1, 0, 0, 0])
    """
    n = around.n_points
    graph = sp.csr_array((np.ones(len(around.indices), np.int8), around.indices, around.indptr), shape=(n, n))
    labels = sp.csgraph.connected_components(graph, directed=False)[1]
    rank = np.empty(labels.max() + 1, np.int64)
    rank[np.argsort(-np.bincount(labels), kind="stable")] = np.arange(len(rank))
    return np.asarray(rank[labels])


def check_one_piece(around: Neighborhoods) -> None:
    """Check that the neighbourhoods join all points.

    Raises
    ------
    InputError
        Saying how many parts there are and how large, with a point of each.
    """
    labels = label_parts(around)
    sizes = np.bincount(labels)
    if len(sizes) > 1:
        shown = " and ".join(str(size) for size in sizes[:4]) + (" ..." if len(sizes) > 4 else "")
        raise InputError(
            f"the points fall into {len(sizes)} separate parts, of {shown} points (some of them: {{seeds}}), but a "
            "patch is in one piece; mesh the largest (--component largest), or the parts one by one",
            seeds=np.unique(labels, return_index=True)[1],
        )


def largest_component(points: ArrayLike) -> Indices:
    """Find the rows of the largest part of a scan, as the 20 nearest neighbours join it.

    Parameters
    ----------
    points : (N, 3) array
        In any unit and at any offset.

    Returns
    -------
    (k,) int64 array, ascending.

    Examples
    --------
    >>> from pointchart import shapes
    >>> points = shapes.grid(12, 9).points
    >>> len(largest_component(np.concatenate([points, points[:50] + [0, 0, 100]])))
    108
    """
    cloud = prepare(points)
    return np.flatnonzero(label_parts(nearest(cloud.points, NEAREST))[cloud.places] == 0)
