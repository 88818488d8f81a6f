"""Neighbourhoods of points: balls, the nearest, and Delaunay stars (paper, section 4)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from ._check import check_neighbors, check_points
from ._kernels.planes import fit_normals
from ._kernels.stars import delaunay_stars as stars_kernel
from ._parallel import over_ranges
from .errors import InputError
from .typing import Floats, Indices, Mask, Points

STEEPEST = 0.8  # sine of the steepest neighbour against the tangent plane; steeper ones lie on another sheet
TIE_BREAK = 1e-2
WIDER = 4


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
    return Neighborhoods(np.arange(0, n * k + 1, k), _without(np.arange(n), found).ravel())


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


def _without(points: Indices, found: Indices) -> Indices:
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


def break_ties(points: ArrayLike, spacing: Floats) -> Points:
    """Move each point by up to a hundredth of the spacing, the same way on every call.

    On a grid all circles hold four points, and neighbouring stars cannot agree on a diagonal. So stars that have to
    agree are searched among points in general position; nothing else ever sees the moved points.

    Parameters
    ----------
    points : (n, 3) array
    spacing : (n,) array
        Local spacing.

    Returns
    -------
    (n, 3) float64 array.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    >>> bool(np.abs(break_ties(corners, np.ones(4)) - corners).max() < 1e-2)
    True
    """
    cloud = check_points(points)
    return cloud + TIE_BREAK * spacing[:, None] * np.random.default_rng(0).uniform(-1.0, 1.0, cloud.shape)


def normals(points: ArrayLike, around: Neighborhoods) -> Floats:
    """Fit the least-squares plane through each point and its neighbours.

    Parameters
    ----------
    points : (n, 3) array
    around : Neighborhoods
        The points that each plane is fitted to, besides its own.

    Returns
    -------
    (n, 3) float64 array of unit normals, of either sign.

    Examples
    --------
    >>> corners = [[0, 0, 7], [1, 0, 7], [0, 1, 7], [1, 1, 7]]
    >>> abs(normals(corners, nearest(corners, 3)))[0]
    array([0., 0., 1.])
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    result = np.empty_like(cloud)
    over_ranges(lambda first, last: fit_normals(cloud, around.indptr, around.indices, first, last, result), len(cloud))
    return result


def delaunay_star(points: ArrayLike, around: Neighborhoods, *, planes: Neighborhoods | None = None) -> Neighborhoods:
    """Find the Delaunay neighbours of each point in its tangent plane: the neighbourhood of the paper's method 3.

    The candidates are projected to the least-squares plane, where the neighbours of the centre in their Delaunay
    triangulation are found by inversion, without a triangulation. Candidates steeper than 53 degrees against the plane
    are left out: they lie on another sheet.

    Parameters
    ----------
    points : (n, 3) array
        Distinct points.
    around : Neighborhoods
        The candidates: a large ball (the paper) or about 20 nearest.
    planes : Neighborhoods, optional
        What the planes are fitted to; the candidates, if not given.

    Returns
    -------
    Neighborhoods
        Ordered anticlockwise about the normal, with `local` and `is_open`. Normals have either sign.

    References
    ----------
    Floater and Reimers 2001, section 4, equation (4.4).

    Examples
    --------
    >>> plus = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [3, 0, 0]]
    >>> star = delaunay_star(plus, nearest(plus, 5))
    >>> sorted(star.indices[: star.indptr[1]].tolist()), star.is_open[:2].tolist()
    ([1, 2, 3, 4], [False, False])
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    return _compact(around, *_stars(cloud, normals(cloud, planes or around), around)[:4])


def nearest_star(points: ArrayLike, around: Neighborhoods) -> Neighborhoods:
    """Find the Delaunay neighbours of each point among its nearest, and among more where its star asks for it.

    A star is the true one if no point beyond the candidates can lie in one of its circles: if its largest
    circumcircle, which passes through the centre, is no wider than the candidates reach. Where it is wider, as across
    the gaps between the lines of a scan, four times as many are searched; the plane stays that of the nearest.

    Parameters
    ----------
    points : (n, 3) array
        Distinct points.
    around : Neighborhoods
        The same number of nearest points of each, nearest first.

    Returns
    -------
    Neighborhoods
        As those of `delaunay_star`.

    Examples
    --------
    >>> tracks = [[x, 3 * y, 0] for y in range(3) for x in range(12)]
    >>> near = nearest(tracks, 8)
    >>> sorted(nearest_star(tracks, near).indices[nearest_star(tracks, near).rows == 17].tolist())
    [5, 16, 18, 29]
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    normal = normals(cloud, around)
    star, local, count, is_open, diameter = _stars(cloud, normal, around)
    found = _compact(around, star, local, count, is_open)
    reach = np.linalg.norm(cloud[around.indices[around.indptr[1:] - 1]] - cloud, axis=1)
    short = np.flatnonzero(~is_open & (diameter > reach))
    wide = min(WIDER * int(around.sizes.max()), len(cloud) - 1)
    if len(short) == 0 or wide <= around.sizes.max():
        return found
    candidates = _without(short, search(cKDTree(cloud), cloud[short], wide + 1)[1])
    sizes = np.zeros(len(cloud), np.int64)
    sizes[short] = wide
    widened = Neighborhoods(np.concatenate([[0], np.cumsum(sizes)]), candidates.ravel())
    again = _compact(widened, *_stars(cloud, normal, widened)[:4])
    return _replace_rows(found, short, again)


def _replace_rows(found: Neighborhoods, rows: Indices, by: Neighborhoods) -> Neighborhoods:
    """Take some stars from other neighbourhoods, which hold those alone."""
    is_replaced = np.zeros(found.n_points, bool)
    is_replaced[rows] = True
    kept = ~np.repeat(is_replaced, found.sizes)
    centers = np.concatenate([found.rows[kept], by.rows])
    order = np.argsort(centers, kind="stable")
    indptr = np.concatenate([[0], np.cumsum(np.bincount(centers, minlength=found.n_points))])
    indices = np.concatenate([found.indices[kept], by.indices])[order]
    if found.local is None or by.local is None or found.is_open is None or by.is_open is None:
        return Neighborhoods(indptr, indices)
    local = np.concatenate([found.local[kept], by.local])[order]
    return Neighborhoods(indptr, indices, local, np.where(is_replaced, by.is_open, found.is_open))


def _stars(cloud: Points, normal: Floats, around: Neighborhoods) -> tuple[Indices, Floats, Indices, Mask, Floats]:
    star, local = np.empty_like(around.indices), np.empty((len(around.indices), 2))
    count, is_open = np.empty(len(cloud), np.int64), np.empty(len(cloud), np.bool_)
    diameter = np.empty(len(cloud))
    over_ranges(
        lambda first, last: stars_kernel(
            cloud, normal, around.indptr, around.indices, STEEPEST, first, last, star, local, count, is_open, diameter
        ),
        len(cloud),
    )
    return star, local, count, is_open, diameter


def _compact(around: Neighborhoods, star: Indices, local: Floats, count: Indices, is_open: Mask) -> Neighborhoods:
    """Close the places that candidates left free."""
    taken = np.arange(len(star)) - np.repeat(around.indptr[:-1], around.sizes) < np.repeat(count, around.sizes)
    return Neighborhoods(np.concatenate([[0], np.cumsum(count)]), star[taken], local[taken], is_open)
