"""Scores that tell boundary points from interior ones."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_kind, check_neighbors, check_points
from .._kernels.agreement.agreed_triangles import add_corner_angles
from .._kernels.boundary.sides import survey_sides
from .._kernels.unsigned import unsigned
from .._parallel import over_ranges
from ..points.neighborhoods import Neighborhoods, Rings, Stars
from ..points.planes import FADING, plane_normals
from ..points.stars import STEEPEST, Sides
from ..typing import Floats, Mask, Points, Triangles

WIDE_STAR = 1.0  # circumradius of a star in spacings where the doubt begins: that of an even sampling is 0.6


@dataclass(frozen=True, slots=True, eq=False)
class BoundaryScores:
    """How much speaks for each point lying on a boundary: four parts, each from 0, none, to 1, as on a straight edge.

    Attributes
    ----------
    gap : (n,) float64
        Largest angle free of neighbours: 1 from a half turn on.
    half_disc : (n,) float64
        Distance of the neighbours' centroid, against that of half a disc.
    width : (n,) float64
        Circumradius of the Delaunay star: 0 up to one spacing, 1 from two on, and for an open star.
    uncovered : (n,) float64
        Angle that the triangles on which stars agree leave free: 1 from a half turn on.
    """

    gap: Floats
    half_disc: Floats
    width: Floats
    uncovered: Floats

    @property
    def total(self) -> Floats:
        """The mean of the four parts, (n,): from a half on, more speaks for the boundary than against it."""
        return (self.gap + self.half_disc + self.width + self.uncovered) / 4.0

    @property
    def is_boundary(self) -> Mask:
        """Whether more speaks for the boundary than against it, (n,)."""
        return self.total >= 0.5


def boundary_scores(
    points: ArrayLike,
    around: Neighborhoods,
    star: Stars,
    agreed: Triangles,
    spacing: Floats,
    *,
    sides: Sides | None = None,
) -> BoundaryScores:
    """Score every point by what its neighbours, its star and its triangles say of a boundary.

    Each part fails on its own: gaps open by chance in uneven samplings, centroids shift where the density changes,
    stars widen in noise, triangles are missing at creases. Their mean is steadier than any.

    Parameters
    ----------
    points : (n, 3) array
        Smoothed, if they are noisy.
    around : Neighborhoods
        About 20 nearest.
    star : Stars
    agreed : (m, 3) int array
        The triangles on which the stars agree.
    spacing : (n,) array
        Local spacing.
    sides : Sides, optional
        If they are known.

    Returns
    -------
    BoundaryScores

    Raises
    ------
    InputError
        If the stars are not ordered.

    References
    ----------
    Bendels, Schnabel and Klein 2006, Detecting holes in point set surfaces, sections 4.1 and 4.2.

    Examples
    --------
    >>> from pointchart.agreement.agreed_surface import collect_agreed
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.points.stars import delaunay_star
    >>> plus = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]])
    >>> near = nearest(plus, 4)
    >>> star = delaunay_star(plus, near)
    >>> agreed = collect_agreed(plus, star, np.ones(5)).triangles
    >>> boundary_scores(plus, near, star, agreed, np.ones(5)).is_boundary
    array([False,  True,  True,  True,  True])
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    check_kind(star, Stars, "the neighbourhoods are no stars, so they have no width; use Delaunay stars")
    return score_points(cloud, around, star, agreed, spacing, sides or _sides(cloud, around))


def score_points(
    cloud: Points, around: Neighborhoods, star: Stars, agreed: Triangles, spacing: Floats, sides: Sides
) -> BoundaryScores:
    """Score points as `boundary_scores` does, by what is known to be right."""
    angle, offset = sides
    even = 2.0 * np.pi / np.maximum(around.sizes, 3)
    free = 1.0 - corner_angles(cloud, agreed) / (2.0 * np.pi)
    return BoundaryScores(
        gap=np.clip((angle - even) / np.maximum(np.pi - even, 1e-300), 0.0, 1.0),
        half_disc=np.minimum(0.5 * np.pi * offset, 1.0),
        width=np.clip(star.width / spacing - WIDE_STAR, 0.0, 1.0),
        uncovered=np.clip(2.0 * free, 0.0, 1.0),
    )


def angular_gaps(points: ArrayLike, around: Neighborhoods) -> Floats:
    """Measure the largest angle free of neighbours around each point, in its tangent plane.

    About 30 neighbours leave gaps well under a right angle inside a surface and of about pi on its boundary.
    Neighbours steeper than 53 degrees lie on another sheet and are left out.

    Parameters
    ----------
    points : (n, 3) array
    around : Neighborhoods
        20 to 30 nearest.

    Returns
    -------
    (n,) float64 array, in radians.

    References
    ----------
    Bendels, Schnabel and Klein 2006, Detecting holes in point set surfaces, section 4.1.

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> plus = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    >>> np.rad2deg(angular_gaps(plus, nearest(plus, 4))[:2]).round(6)
    array([ 90., 270.])
    """
    cloud = check_points(points)
    check_neighbors(around.indices, around.n_points, len(cloud))
    return _sides(cloud, around).angle


def hull_test(star: Rings) -> Mask:
    """Tell which points lie on the hull of their own local triangulation: the boundary points of the paper.

    Finds convex stretches of a boundary; points in its concave bends lie inside the hull and are missed.

    Parameters
    ----------
    star : Rings
        Delaunay stars.

    Returns
    -------
    (n,) bool array.

    Raises
    ------
    InputError
        If the stars are not ordered.

    References
    ----------
    Floater and Reimers 2001, section 5.

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.points.stars import delaunay_star
    >>> plus = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    >>> hull_test(delaunay_star(plus, nearest(plus, 4))).tolist()
    [False, True, True, True, True]
    """
    sentence = "the neighbourhoods are not ordered, so no star is known to be open; use Delaunay stars"
    return check_kind(star, Rings, sentence).is_open.copy()


def corner_angles(points: Points, triangles: Triangles) -> Floats:
    """Add up the angles of the triangles at each point, (n,), in radians.

    Examples
    --------
    >>> right = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    >>> np.rad2deg(corner_angles(right, np.array([[0, 1, 2]]))).round(6)
    array([90., 45., 45.])
    """
    total = np.zeros(len(points))
    add_corner_angles(points, unsigned(np.asarray(triangles, np.int32)), total)
    return total


def _sides(cloud: Points, around: Neighborhoods) -> Sides:
    normal, sides = plane_normals(cloud, around, FADING), Sides(np.empty(len(cloud)), np.empty(len(cloud)))
    rows = around.table
    over_ranges(
        lambda first, last: survey_sides(cloud, normal, *rows, STEEPEST, first, last, *sides),
        len(cloud),
    )
    return sides
