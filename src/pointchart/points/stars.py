"""Delaunay stars: the neighbours of each point in the Delaunay triangulation of its tangent plane (paper, method 3)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_neighbors, check_points
from .._kernels.points.inversion import delaunay_stars as stars_kernel
from .._parallel import over_ranges
from ..typing import Floats, Indices, Mask, Points
from .neighborhoods import Neighborhoods, PlanarStars, Stars
from .planes import FADING, plane_normals
from .trees import BoxTree

STEEPEST = 0.8  # sine of the steepest neighbour against the tangent plane; steeper ones lie on another sheet
WIDER = 4  # times the candidates, for stars that reach beyond them: so a circle has twice the radius


def delaunay_star(points: ArrayLike, around: Neighborhoods, *, planes: Neighborhoods | None = None) -> PlanarStars:
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
    PlanarStars
        Anticlockwise about the normal. Normals have either sign.

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
    if planes is not None:
        check_neighbors(planes.indices, planes.n_points, len(cloud))
    found, _, _, local = _stars(cloud, plane_normals(cloud, planes or around), around)
    return PlanarStars(found.indptr, found.indices, found.is_open, found.width, local)


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


def nearest_star(points: ArrayLike, around: Neighborhoods) -> PlanarStars:
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
    PlanarStars
        As those of `delaunay_star`.

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> tracks = [[x, 3 * y, 0] for y in range(3) for x in range(12)]
    >>> near = nearest(tracks, 8)
    >>> sorted(nearest_star(tracks, near).indices[nearest_star(tracks, near).rows == 17].tolist())
    [5, 16, 18, 29]
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    return planar_stars(cloud, around)


def planar_stars(cloud: Points, around: Neighborhoods) -> PlanarStars:
    """Find stars as `nearest_star` does, of points and neighbours that are known to be right."""
    found, _, local = _widened(cloud, around)
    return PlanarStars(found.indptr, found.indices, found.is_open, found.width, local)


def star_and_sides(cloud: Points, around: Neighborhoods) -> tuple[Stars, Sides]:
    """Find stars as `nearest_star` does, without positions, and what the nearest points say of a boundary.

    Parameters
    ----------
    cloud, around
        As for `nearest_star`, but known to be right.

    Returns
    -------
    Stars
    Sides
    """
    found, sides, _ = _widened(cloud, around, has_places=False)
    return found, sides


def _widened(cloud: Points, around: Neighborhoods, *, has_places: bool = True) -> tuple[Stars, Sides, Floats]:
    """Find stars among the nearest, and among more where they ask for it."""
    normal = plane_normals(cloud, around, FADING)
    found, is_short, sides, local = _stars(cloud, normal, around, has_places=has_places)
    short = np.flatnonzero(is_short)
    wide = min(WIDER * int(around.sizes.max()), len(cloud) - 1)
    if len(short) == 0 or wide <= around.sizes.max():
        return found, sides, local
    sizes = np.zeros(len(cloud), np.int64)
    sizes[short] = wide
    candidates = BoxTree(cloud).nearest(wide, short)
    more = Neighborhoods(np.concatenate([[0], np.cumsum(sizes)]), candidates.ravel())
    by, _, _, by_local = _stars(cloud, normal, more, has_places=has_places)
    joined, places = _with_rows(found, local, short, by, by_local)
    return joined, sides, places


def _with_rows(found: Stars, local: Floats, rows: Indices, by: Stars, by_local: Floats) -> tuple[Stars, Floats]:
    """Take some stars, and positions if there are any, from other ones."""
    sizes = found.sizes.copy()
    sizes[rows] = by.sizes[rows]
    indptr = np.concatenate([[0], np.cumsum(sizes)])
    is_new = np.zeros(found.n_points, bool)
    is_new[rows] = True
    of_new, of_old = np.repeat(is_new, sizes), np.repeat(~is_new, found.sizes)
    indices, places = np.empty(indptr[-1], found.indices.dtype), local
    indices[of_new], indices[~of_new] = by.indices, found.indices[of_old]
    if len(local):
        places = np.empty((indptr[-1], 2))
        places[of_new], places[~of_new] = by_local, local[of_old]
    is_open, width = np.where(is_new, by.is_open, found.is_open), np.where(is_new, by.width, found.width)
    return Stars(indptr, indices, is_open, width), places


def _stars(
    cloud: Points, normal: Floats, around: Neighborhoods, *, has_places: bool = True
) -> tuple[Stars, Mask, Sides, Floats]:
    """Find all stars; tell, too, which closed ones are wider than their candidates, nearest first, reach.

    The last array, (nnz, 2), holds positions in the planes; it is empty if none are asked for.
    """
    n = len(cloud)
    count, is_open, is_short, width = np.empty(n, np.int64), np.empty(n, np.bool_), np.empty(n, np.bool_), np.empty(n)
    sides, rows = Sides(np.empty(n), np.empty(n)), around.table
    parts: dict[int, tuple[Indices, Floats]] = {}

    def find(first: int, last: int) -> None:
        room = int(around.indptr[last] - around.indptr[first])
        star, places = np.empty(room, np.uint32), np.empty((room, 2))
        where = cloud, normal, *rows, STEEPEST, first, last
        size = stars_kernel(*where, star, places, count, is_open, is_short, width, *sides)
        parts[first] = star[:size].view(np.int32).copy(), places[: size if has_places else 0].copy()

    over_ranges(find, n)
    indices, places = (np.concatenate([parts[first][k] for first in sorted(parts)]) for k in range(2))
    indptr = np.concatenate([[0], np.cumsum(count)])
    return Stars(indptr, indices, is_open, width), is_short, sides, places
