"""Neighbourhoods of points: balls and the nearest (paper, section 4)."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_neighbors, check_points
from .._kernels.points.box_tree import LEAF, bound_boxes, find_nearest, middle_distances
from .._kernels.unsigned import unsigned
from .._parallel import over_ranges
from ..errors import InputError
from ..typing import Floats, Indices, Mask, Points
from .morton import morton_order

if TYPE_CHECKING:  # what a short run does not need is imported where it is used
    from scipy.spatial import cKDTree


@dataclass(frozen=True, slots=True, eq=False)
class Neighborhoods:
    """The neighbours of every point, row by row (compressed sparse rows).

    Attributes
    ----------
    indptr : (n + 1,) int64
        Point i has the neighbours ``indices[indptr[i]:indptr[i + 1]]``.
    indices : (nnz,) int32 or int64
        Neighbours; never the point itself, none twice in a row.
    local : (nnz, 2) float64 or None
        Positions of the neighbours in the tangent plane of their centre, if they are ordered: anticlockwise.
    is_open : (n,) bool or None
        For ordered neighbours: whether the star has a gap of at least pi, as it has on the boundary. The gap then lies
        between the last neighbour and the first.
    width : (n,) float64 or None
        For Delaunay stars: the largest radius of a circle through the centre and two neighbours that follow each other;
        infinite if the star is open.
    """

    indptr: Indices
    indices: Indices
    local: Floats | None = None
    is_open: Mask | None = None
    width: Floats | None = None

    @property
    def n_points(self) -> int:
        """Number of points."""
        return len(self.indptr) - 1

    @property
    def sizes(self) -> Indices:
        """Number of neighbours of each point, (n,)."""
        return np.diff(self.indptr)

    @property
    def table(self) -> tuple[Indices, Indices]:
        """`indptr` as uint64 and `indices` as uint32, as compiled loops take them; a copy of indices that are int64."""
        return unsigned(np.asarray(self.indptr, np.int64)), unsigned(np.asarray(self.indices, np.int32))

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
    from scipy.spatial import cKDTree

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
    >>> nearest([[0, 0, 0], [1, 0, 0], [3, 0, 0], [3, 1, 0]], k=1).indices.tolist()
    [1, 0, 3, 2]
    """
    cloud = check_points(points)
    if k < 1:
        raise InputError(f"k is {k}; every point needs at least one neighbour, and 8 to 30 work well")
    order = morton_order(cloud)
    place = np.empty(len(cloud), np.int32)
    place[order] = np.arange(len(cloud), dtype=np.int32)
    found = BoxTree(np.ascontiguousarray(cloud[order])).nearest(k, place)
    return rectangular(order.astype(np.int32)[found])


def rectangular(found: Indices) -> Neighborhoods:
    """Make neighbourhoods of the same number of neighbours for each point, (n, k)."""
    n, k = found.shape
    return Neighborhoods(np.arange(0, n * k + 1, k), found.ravel())


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
    if found.sizes.min() != found.sizes.max():
        raise InputError("the spacing needs the same number of nearest neighbours for every point; use nearest")
    count = min(k, int(found.sizes[0]))
    # Neighbours are sorted by distance: the median is that of the middle one, or the mean of the middle two.
    one, other, result = (count - 1) // 2, count // 2, np.empty(len(cloud))
    rows = found.table
    over_ranges(
        lambda first, last: middle_distances(cloud, *rows, one, other, first, last, result),
        len(cloud),
    )
    return result
