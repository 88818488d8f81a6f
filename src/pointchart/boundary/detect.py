"""Scores that tell boundary points from interior ones."""

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points
from .._kernels.rims import largest_gaps
from .._parallel import over_ranges
from ..errors import InputError
from ..neighbors import Neighborhoods
from ..stars import normals
from ..typing import Floats, Mask

BOUNDARY_GAP = np.pi / 2.0


def angular_gaps(points: ArrayLike, around: Neighborhoods) -> Floats:
    """Measure the largest angle free of neighbours around each point, in its tangent plane.

    About 30 neighbours leave gaps well under a right angle inside a surface and of about pi on its boundary; more than
    `BOUNDARY_GAP`, a right angle, speaks for the boundary.

    Parameters
    ----------
    points : (n, 3) array
    around : Neighborhoods
        About 30 nearest.

    Returns
    -------
    (n,) float64 array, in radians.

    References
    ----------
    Bendels, Schnabel and Klein 2006, Detecting holes in point set surfaces, section 4.1.

    Examples
    --------
    >>> from pointchart.neighbors import nearest
    >>> plus = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    >>> np.rad2deg(angular_gaps(plus, nearest(plus, 4))[:2]).round(6)
    array([ 90., 270.])
    """
    cloud = check_points(points)
    normal, gap = normals(cloud, around), np.empty(len(cloud))
    over_ranges(
        lambda first, last: largest_gaps(cloud, normal, around.indptr, around.indices, first, last, gap), len(cloud)
    )
    return gap


def hull_test(star: Neighborhoods) -> Mask:
    """Tell which points lie on the hull of their own local triangulation: the boundary points of the paper.

    Finds convex stretches of a boundary; points in its concave bends lie inside the hull and are missed.

    Parameters
    ----------
    star : Neighborhoods
        Delaunay stars.

    Returns
    -------
    (n,) bool array.

    References
    ----------
    Floater and Reimers 2001, section 5.

    Examples
    --------
    >>> from pointchart.neighbors import nearest
    >>> from pointchart.stars import delaunay_star
    >>> plus = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    >>> hull_test(delaunay_star(plus, nearest(plus, 4))).tolist()
    [False, True, True, True, True]
    """
    if star.is_open is None:
        raise InputError("the hull test needs ordered neighbourhoods; use Delaunay stars")
    return star.is_open.copy()
