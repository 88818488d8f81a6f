"""Delaunay stars: the neighbours of each point in the Delaunay triangulation of its tangent plane (paper, method 3)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_neighbors, check_points
from .._kernels.points.inversion import delaunay_stars as stars_kernel
from .._kernels.points.tangent_planes import fit_planes
from .._parallel import over_ranges
from ..typing import Floats, Indices, Mask, Points
from .neighbors import BoxTree, Neighborhoods

STEEPEST = 0.8  # sine of the steepest neighbour against the tangent plane; steeper ones lie on another sheet
FADING = 0.8  # the farthest neighbours have 4% of the weight of the nearest in a plane: they may lie on another sheet
TIE_BREAK = 1e-2  # spacings, a choice: over the rounding of grids in files, under what changes stars that have no ties
WIDER = 4  # times the candidates, for stars that reach beyond them: so a circle has twice the radius


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


def normals(points: ArrayLike, around: Neighborhoods, *, fading: float = 0.0) -> Floats:
    """Fit the least-squares plane through each point and its neighbours.

    Parameters
    ----------
    points : (n, 3) array
    around : Neighborhoods
        The points that each plane is fitted to, besides its own.
    fading : float
        From 0, all count alike, to 1: the weight falls with the distance d as (1 - fading d^2 / R^2)^2, where R is that
        of the farthest neighbour, which may lie on another sheet.

    Returns
    -------
    (n, 3) float64 array of unit normals, of either sign.

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> corners = [[0, 0, 7], [1, 0, 7], [0, 1, 7], [1, 1, 7]]
    >>> abs(normals(corners, nearest(corners, 3)))[0]
    array([0., 0., 1.])
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    return _planes(cloud, around, fading)[0]


def smooth(points: ArrayLike, around: Neighborhoods) -> Points:
    """Move each point onto the least-squares plane of its neighbours, near ones counting more: less noise.

    Noise across the surface falls by half and more; no point moves along it. Stars and scores, which have to see the
    surface through the noise, look at these points; nothing else does.

    Parameters
    ----------
    points : (n, 3) array
    around : Neighborhoods
        About 20 nearest.

    Returns
    -------
    (n, 3) float64 array.

    Examples
    --------
    >>> from pointchart import shapes
    >>> from pointchart.points.neighbors import nearest
    >>> noisy = shapes.add_noise(shapes.disc(500), sigma_in_spacings=0.5).points
    >>> bool(smooth(noisy, nearest(noisy, 20))[:, 2].std() < 0.5 * noisy[:, 2].std())
    True
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    normal, offset = _planes(cloud, around, FADING)
    return np.asarray(cloud + offset[:, None] * normal)


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
    >>> from pointchart.points.neighbors import nearest
    >>> plus = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [3, 0, 0]]
    >>> star = delaunay_star(plus, nearest(plus, 5))
    >>> sorted(star.indices[: star.indptr[1]].tolist()), star.is_open[:2].tolist()
    ([1, 2, 3, 4], [False, False])
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    return _stars(cloud, normals(cloud, planes or around), around)[0]


class Sides(NamedTuple):
    """What the neighbours of each point say of a boundary.

    Attributes
    ----------
    angle : (n,) float64
        The largest angle free of neighbours in the tangent plane, in radians.
    offset : (n,) float64
        Distance of the neighbours' centroid over their mean distance.
    """

    angle: Floats
    offset: Floats


def nearest_star(points: ArrayLike, around: Neighborhoods) -> Neighborhoods:
    """Find the Delaunay neighbours of each point among its nearest, and among more where its star asks for it.

    A star is the true one if no point beyond the candidates can lie in one of its circles: if its largest
    circumcircle, which passes through the centre, is no wider than the candidates reach. Where it is wider, as across
    the gaps between the lines of a scan, four times as many are searched; the plane stays that of the nearest, in which
    near ones count more.

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
    >>> from pointchart.points.neighbors import nearest
    >>> tracks = [[x, 3 * y, 0] for y in range(3) for x in range(12)]
    >>> near = nearest(tracks, 8)
    >>> sorted(nearest_star(tracks, near).indices[nearest_star(tracks, near).rows == 17].tolist())
    [5, 16, 18, 29]
    """
    return star_and_sides(points, around)[0]


def star_and_sides(points: ArrayLike, around: Neighborhoods, *, local: bool = True) -> tuple[Neighborhoods, Sides]:
    """Find stars as `nearest_star` does, and what the nearest points say of a boundary.

    Parameters
    ----------
    points, around
        As for `nearest_star`.
    local : bool
        Whether positions in the planes are kept.

    Returns
    -------
    Neighborhoods
    Sides
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    normal = normals(cloud, around, fading=FADING)
    found, is_short, sides = _stars(cloud, normal, around, local=local)
    short = np.flatnonzero(is_short)
    wide = min(WIDER * int(around.sizes.max()), len(cloud) - 1)
    if len(short) == 0 or wide <= around.sizes.max():
        return found, sides
    sizes = np.zeros(len(cloud), np.int64)
    sizes[short] = wide
    candidates = BoxTree(cloud).nearest(wide, short)
    widened = Neighborhoods(np.concatenate([[0], np.cumsum(sizes)]), candidates.ravel())
    return _with_rows(found, short, _stars(cloud, normal, widened, local=local)[0]), sides


def _with_rows(found: Neighborhoods, rows: Indices, by: Neighborhoods) -> Neighborhoods:
    """Take some stars from other ones."""
    sizes = found.sizes.copy()
    sizes[rows] = by.sizes[rows]
    indptr = np.concatenate([[0], np.cumsum(sizes)])
    is_new = np.zeros(found.n_points, bool)
    is_new[rows] = True
    of_new, of_old = np.repeat(is_new, sizes), np.repeat(~is_new, found.sizes)
    indices, local = np.empty(indptr[-1], found.indices.dtype), None
    indices[of_new], indices[~of_new] = by.indices, found.indices[of_old]
    if found.local is not None:
        local = np.empty((indptr[-1], 2))
        local[of_new], local[~of_new] = by.local, found.local[of_old]
    is_open = np.where(is_new, np.asarray(by.is_open), np.asarray(found.is_open))
    width = np.where(is_new, np.asarray(by.width), np.asarray(found.width))
    return Neighborhoods(indptr, indices, local, is_open, width)


def _planes(cloud: Points, around: Neighborhoods, fading: float) -> tuple[Floats, Floats]:
    """Return the normals of the planes, and the height of each plane above its point."""
    normal, offset, rows = np.empty_like(cloud), np.empty(len(cloud)), around.table
    over_ranges(
        lambda first, last: fit_planes(cloud, *rows, fading, first, last, normal, offset),
        len(cloud),
    )
    return normal, offset


def _stars(
    cloud: Points, normal: Floats, around: Neighborhoods, *, local: bool = True
) -> tuple[Neighborhoods, Mask, Sides]:
    """Find all stars; tell, too, which closed ones are wider than their candidates, nearest first, reach."""
    n = len(cloud)
    count, is_open, is_short, width = np.empty(n, np.int64), np.empty(n, np.bool_), np.empty(n, np.bool_), np.empty(n)
    sides, rows = Sides(np.empty(n), np.empty(n)), around.table
    parts: dict[int, tuple[Indices, Floats]] = {}

    def find(first: int, last: int) -> None:
        room = int(around.indptr[last] - around.indptr[first])
        star, places = np.empty(room, np.uint32), np.empty((room, 2))
        where = cloud, normal, *rows, STEEPEST, first, last
        size = stars_kernel(*where, star, places, count, is_open, is_short, width, *sides)
        parts[first] = star[:size].view(np.int32).copy(), places[: size if local else 0].copy()

    over_ranges(find, n)
    indices, places = (np.concatenate([parts[first][k] for first in sorted(parts)]) for k in range(2))
    indptr = np.concatenate([[0], np.cumsum(count)])
    return Neighborhoods(indptr, indices, places if local else None, is_open, width), is_short, sides
