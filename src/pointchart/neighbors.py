"""Neighbourhoods of points: balls and the nearest (paper, section 4)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from ._check import check_neighbors, check_points
from ._parallel import over_ranges
from .errors import InputError
from .typing import Floats, Indices, Mask


@dataclass(frozen=True, slots=True, eq=False)
class Neighborhoods:
    """The neighbours of every point, row by row (compressed sparse rows).

    Attributes
    ----------
    indptr : (n + 1,) int64
        Point i has the neighbours ``indices[indptr[i]:indptr[i + 1]]``.
    indices : (nnz,) int64
        Neighbours; never the point itself, none twice in a row.
    local : (nnz, 2) float64 or None
        Positions of the neighbours in the tangent plane of their centre, if they are ordered: anticlockwise.
    is_open : (n,) bool or None
        For ordered neighbours: whether the star has a gap of at least pi, as it has on the boundary. The gap then lies
        between the last neighbour and the first.
    """

    indptr: Indices
    indices: Indices
    local: Floats | None = None
    is_open: Mask | None = None

    @property
    def n_points(self) -> int:
        """Number of points."""
        return len(self.indptr) - 1

    @property
    def sizes(self) -> Indices:
        """Number of neighbours of each point, (n,)."""
        return np.diff(self.indptr)

    @property
    def rows(self) -> Indices:
        """The centre of every neighbour, (nnz,)."""
        return np.repeat(np.arange(self.n_points), self.sizes)


def from_pairs(rows: Indices, columns: Indices, n_points: int) -> Neighborhoods:
    """Gather (centre, neighbour) pairs, sorted by centre, into neighbourhoods."""
    indptr = np.zeros(n_points + 1, np.int64)
    np.cumsum(np.bincount(rows, minlength=n_points), out=indptr[1:])
    return Neighborhoods(indptr, np.ascontiguousarray(columns, dtype=np.int64))


def ball(points: ArrayLike, radius: float | Floats) -> Neighborhoods:
    r"""Find all points in the open ball around each point.

    .. math:: N_i = \{j : 0 < \|x_j - x_i\| < r_i\}

    A constant radius suits even sampling; give one radius a point, such as a multiple of `spacing`, where it is uneven.

    Parameters
    ----------
    points : (n, 3) array
    radius : float or (n,) array
        In the unit of the points.

    Returns
    -------
    Neighborhoods
        Nearest first.

    Raises
    ------
    InputError
        If a radius is not positive or leaves a point without neighbours.

    References
    ----------
    Floater and Reimers 2001, section 4, equation (4.1).

    Examples
    --------
    >>> line = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0]]
    >>> ball(line, 1.5).sizes
    array([1, 3, 2, 2])
    """
    cloud = check_points(points)
    radii = np.asarray(radius, dtype=np.float64)
    if radii.shape not in ((), (len(cloud),)):
        raise InputError(f"the radii have shape {radii.shape}; give one, or one for each of the {len(cloud)} points")
    radii = np.broadcast_to(radii, len(cloud))
    if not np.all(radii > 0.0):
        raise InputError(
            f"the radius is {radii.min():g}; it has to be positive, some 2 to 4 times the spacing of the points"
        )
    tree = cKDTree(cloud)
    counts = np.empty(len(cloud), np.int64)

    def count(first: int, last: int) -> None:
        counts[first:last] = tree.query_ball_point(cloud[first:last], radii[first:last], return_length=True)

    over_ranges(count, len(cloud))
    rows, columns = [], []
    order = np.argsort(counts, kind="stable")
    # Blocks of like counts: each asks the tree for as many neighbours as its fullest ball holds.
    for block in np.array_split(order, max(1, len(cloud) // 16384)):
        distance, found = search(tree, cloud[block], int(counts[block].max()))
        inside = (distance > 0.0) & (distance < radii[block, None])
        rows.append(np.repeat(block, inside.sum(axis=1)))
        columns.append(found[inside])
    row, column = np.concatenate(rows), np.concatenate(columns)
    by_row = np.argsort(row, kind="stable")
    result = from_pairs(row[by_row], column[by_row], len(cloud))
    lonely = np.flatnonzero(result.sizes == 0)
    if len(lonely):
        raise InputError(
            "the radius leaves points {lonely} without any neighbour; the loneliest has its nearest at "
            f"{spacing(cloud, k=1).max():.4g}: use a larger radius, or the nearest k",
            lonely=lonely,
        )
    return result


def nearest(points: ArrayLike, k: int = 20) -> Neighborhoods:
    """Find the `k` nearest other points of each point (all others, if there are fewer).

    Parameters
    ----------
    points : (n, 3) array
        Distinct points.
    k : int
        Number of neighbours; 8 to 30.

    Returns
    -------
    Neighborhoods
        Nearest first.

    References
    ----------
    Floater and Reimers 2001, section 4, below Figure 1.

    Examples
    --------
    >>> nearest([[0, 0, 0], [1, 0, 0], [3, 0, 0], [3, 1, 0]], k=1).indices
    array([1, 0, 3, 2])
    """
    cloud = check_points(points)
    if k < 1:
        raise InputError(f"k is {k}; every point needs at least one neighbour, and 8 to 30 work well")
    n, k = len(cloud), min(k, len(cloud) - 1)
    found = search(cKDTree(cloud), cloud, k + 1)[1]
    return Neighborhoods(np.arange(0, n * k + 1, k), without(np.arange(n), found).ravel())


def search(tree: cKDTree, points: Floats, k: int) -> tuple[Floats, Indices]:
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


def without(points: Indices, found: Indices) -> Indices:
    """Drop each point from its own row of nearest points, or the farthest where rounding has pushed it out."""
    own = found == points[:, None]
    own[~own.any(axis=1), -1] = True
    return np.asarray(found[~own].reshape(len(found), -1))


def spacing(points: ArrayLike, *, k: int = 6, around: Neighborhoods | None = None) -> Floats:
    """Measure the local spacing: the median distance to the `k` nearest points.

    Parameters
    ----------
    points : (n, 3) array
    k : int
    around : Neighborhoods, optional
        At least `k` nearest points of each, nearest first, if they have been found already.

    Returns
    -------
    (n,) float64 array, in the unit of the points.

    Examples
    --------
    >>> spacing([[0, 0, 0], [1, 0, 0], [0, 2, 0], [1, 2, 0]], k=1)
    array([1., 1., 1., 1.])
    """
    cloud = check_points(points)
    found = nearest(cloud, k) if around is None else around
    check_neighbors(found.indices, found.n_points, len(cloud))
    if len(np.unique(found.sizes)) > 1:
        raise InputError("the spacing needs the same number of nearest neighbours for every point; use nearest")
    closest = found.indices.reshape(len(cloud), -1)
    count = min(k, closest.shape[1])
    # Neighbours are sorted by distance: the median is that of the middle one, or the mean of the middle two.
    middle = {(count - 1) // 2, count // 2}
    lengths = [np.linalg.norm(cloud[closest[:, place]] - cloud, axis=1) for place in middle]
    return np.asarray(sum(lengths) / len(lengths))
