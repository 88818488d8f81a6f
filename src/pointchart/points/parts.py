"""The parts that a scan falls into."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from .._kernels.points.forest import join_parts
from ..errors import InputError, Remedy
from ..typing import Floats, Indices, Mask, Points
from .cloud import prepare
from .neighborhoods import Neighborhoods
from .neighbors import median_distances, nearest_rows
from .surroundings import NEAREST

# Spacings: flying pixels of depth frames are 8 to 20 apart. Where spacing grows gradually, links of up to one and a
# half lead from any point to sparser ones: three of the six nearest are within one, as that is the median.
SPARSE, GRADUAL = 6.0, 1.5
FEW = 1 / 16  # of all points: flying pixels are 1 to 5 % of a depth frame
BORDER = 1.0  # of the root of the points of a region: a square of k points has a side of the root of k
APART = 10.0  # spacings: at 5 no scan of the evaluation falls apart yet


def label_parts(points: Points, around: Neighborhoods, spacing: Floats) -> Indices:
    """Label the parts that links of up to ten spacings, of the denser end, join; the largest is 0, (n,).

    Examples
    --------
    >>> points = np.array([[0.0, 0, 0], [0, 1, 0], [19, 0, 0], [19, 1, 0], [19, 2, 0]])
    >>> label_parts(points, nearest_rows(points, 4), np.ones(5))
    array([1, 1, 0, 0, 0])
    """
    part = np.empty(around.n_points, np.int32)
    join_parts(points, around.indptr, around.indices, spacing, APART, part)
    sizes = np.bincount(part)
    seeds = np.flatnonzero(sizes)
    rank = np.empty(len(sizes), np.int64)
    rank[seeds[np.argsort(-sizes[seeds], kind="stable")]] = np.arange(len(seeds))
    return np.asarray(rank[part])


def check_one_piece(points: Points, around: Neighborhoods, spacing: Floats) -> None:
    """Check that the points are in one part.

    Raises
    ------
    InputError
        Saying how many parts there are and how large, with a point of each.
    """
    labels = label_parts(points, around, spacing)
    sizes = np.bincount(labels)
    if len(sizes) > 1:
        shown = " and ".join(str(size) for size in sizes[:4]) + (" ..." if len(sizes) > 4 else "")
        raise InputError(
            f"the points fall into {len(sizes)} separate parts, of {shown} points (some of them: {{seeds}}), but a "
            "patch is in one piece",
            remedies=(Remedy.take_the_largest_part, Remedy.take_one_part),
            seeds=np.unique(labels, return_index=True)[1],
        )


def strays(points: Points, around: Neighborhoods, spacing: Floats) -> Mask:
    """Find points far sparser than most that nothing leads to gradually, as flying pixels of a depth frame; (n,) bool.

    Points of over `SPARSE` times the median spacing are strays, unless enough of them have links to the rest that are
    no longer than `GRADUAL` spacings of their denser end, and over which the spacing changes by no more: a
    region of a surface has a border with the rest. More than a few are a coarser scan beside a finer one.

    Examples
    --------
    >>> from pointchart import shapes
    >>> sheet = shapes.grid(20, 10).points
    >>> both = np.concatenate([sheet, sheet[:8] * 9 + [0, 0, 20]])
    >>> around = nearest_rows(both, NEAREST)
    >>> np.flatnonzero(strays(both, around, median_distances(both, around))).tolist()
    [200, 201, 202, 203, 204, 205, 206, 207]
    """
    is_sparse = spacing > SPARSE * np.median(spacing)
    if not is_sparse.any():
        return is_sparse
    i, j = around.rows, around.indices
    touches = is_sparse[i] | is_sparse[j]
    i, j = i[touches], j[touches]
    denser, sparser = np.minimum(spacing[i], spacing[j]), np.maximum(spacing[i], spacing[j])
    length = np.linalg.norm(points[i] - points[j], axis=1)
    is_gradual = (length <= GRADUAL * denser) & (sparser <= GRADUAL * denser)
    i, j, n = i[is_gradual], j[is_gradual], len(points)
    are_both = is_sparse[i] & is_sparse[j]
    links = csr_array((np.ones(int(are_both.sum())), (i[are_both], j[are_both])), (n, n))
    _, group = connected_components(links, directed=False)
    ends = np.concatenate([i[~are_both], j[~are_both]])
    sizes, leads = np.bincount(group), np.bincount(group[np.unique(ends[is_sparse[ends]])], minlength=n)
    is_stray = is_sparse & (leads[group] < BORDER * np.sqrt(sizes[group]))
    return np.asarray(is_stray & (np.count_nonzero(is_stray) <= FEW * n))


def largest_component(points: ArrayLike) -> Indices:
    """Find the rows of the largest part of a scan: strays, flying pixels and other sheets are left out.

    Parameters
    ----------
    points : (N, 3) array
        In any unit and at any offset.

    Returns
    -------
    (k,) int64 array, ascending.

    Raises
    ------
    InputError
        If the points are no surface; see `prepare`.

    Examples
    --------
    >>> from pointchart import shapes
    >>> points = shapes.grid(12, 9).points
    >>> len(largest_component(np.concatenate([points, points[:50] + [0, 0, 100]])))
    108
    """
    cloud = prepare(points)
    kept = np.arange(len(cloud.points))
    while True:  # without some strays the others are sparser still
        around = nearest_rows(cloud.points[kept], NEAREST)
        spacing = median_distances(cloud.points[kept], around)
        labels = label_parts(cloud.points[kept], around, spacing)
        stays = (labels == 0) & ~strays(cloud.points[kept], around, spacing)
        kept = kept[stays]
        if stays.all() or len(kept) <= NEAREST:
            break
    is_kept = np.zeros(len(cloud.points), np.bool_)
    is_kept[kept] = True
    return np.flatnonzero(is_kept[cloud.places])
