"""Tangent planes: least squares through each point and its neighbours; the points smoothed onto them."""

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_neighbors, check_points
from .._kernels.points.tangent_planes import fit_planes
from .._parallel import over_ranges
from ..typing import Floats, Points
from .neighborhoods import Neighborhoods

FADING = 0.8  # the farthest neighbours have 4% of the weight of the nearest in a plane: they may lie on another sheet


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
    return plane_normals(cloud, around, fading)


def plane_normals(cloud: Points, around: Neighborhoods, fading: float = 0.0) -> Floats:
    """Return the normals that `normals` does, of points and neighbours that are known to be right."""
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
    return on_planes(cloud, around)


def on_planes(cloud: Points, around: Neighborhoods) -> Points:
    """Smooth as `smooth` does, points and neighbours that are known to be right."""
    normal, offset = _planes(cloud, around, FADING)
    return np.asarray(cloud + offset[:, None] * normal)


def _planes(cloud: Points, around: Neighborhoods, fading: float) -> tuple[Floats, Floats]:
    """Return the normals of the planes, and the height of each plane above its point."""
    normal, offset, rows = np.empty_like(cloud), np.empty(len(cloud)), around.table
    over_ranges(
        lambda first, last: fit_planes(cloud, *rows, fading, first, last, normal, offset),
        len(cloud),
    )
    return normal, offset
