"""Neighbourhoods of points: balls and the nearest (paper, section 4)."""

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_neighbors, check_points
from .._kernels.points.box_tree import middle_distances
from .._parallel import over_ranges
from ..errors import InputError
from ..typing import Floats, Points
from .morton import morton_order
from .neighborhoods import Neighborhoods, from_pairs, rectangular
from .trees import BoxTree, search


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
    return nearest_rows(cloud, k)


def nearest_rows(cloud: Points, k: int) -> Neighborhoods:
    """Find the nearest as `nearest` does, of points that are known to be right."""
    order = morton_order(cloud)
    place = np.empty(len(cloud), np.int32)
    place[order] = np.arange(len(cloud), dtype=np.int32)
    found = BoxTree(np.ascontiguousarray(cloud[order])).nearest(k, place)
    return rectangular(order.astype(np.int32)[found])


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
    return median_distances(cloud, found, k)


def spacing_of_places(points: Points) -> Floats:
    """Measure the local spacing as `spacing` does, of points that may coincide: between their places.

    Examples
    --------
    >>> corners = np.repeat([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], 9, axis=0)
    >>> print(spacing(corners).max(), spacing_of_places(corners).min())
    0.0 1.0
    """
    measured = spacing(points)
    if (measured > 0.0).all():
        return measured
    places, place = np.unique(points, axis=0, return_inverse=True)
    return spacing(places)[place.ravel()]


def median_distances(cloud: Points, found: Neighborhoods, k: int = 6) -> Floats:
    """Measure the local spacing as `spacing` does, by nearest points that are known to be right."""
    count = min(k, int(found.sizes[0]))
    # Neighbours are sorted by distance: the median is that of the middle one, or the mean of the middle two.
    one, other, result = (count - 1) // 2, count // 2, np.empty(len(cloud))
    rows = found.table
    over_ranges(
        lambda first, last: middle_distances(cloud, *rows, one, other, first, last, result),
        len(cloud),
    )
    return result
