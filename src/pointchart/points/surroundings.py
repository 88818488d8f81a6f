"""What is around each point: the nearest points, how far apart they are, and the star on the smoothed surface."""

from dataclasses import dataclass

from numpy.typing import ArrayLike

from .._check import check_points
from ..typing import Floats, Points
from .neighbors import BoxTree, Neighborhoods, rectangular
from .neighbors import spacing as local_spacing
from .stars import Sides, break_ties, smooth, star_and_sides

# Two rings of 6 and 12 points, and a little. On 14 real scans 0.5 to 9% of the stars reach beyond, across the lines of
# a laser scanner 15% and on a strip beside itself 24%; those are searched again, among more.
NEAREST = 20


@dataclass(frozen=True, slots=True, eq=False)
class Vicinity:
    """The surroundings of every point.

    Attributes
    ----------
    around : Neighborhoods
        The 20 nearest points.
    spacing : (n,) float64
        Local spacing, in the unit of the points.
    smoothed : (n, 3) float64
        The points with less noise across the surface.
    star : Neighborhoods
        Delaunay stars of the smoothed points, in general position: neighbouring stars can agree on grids too. Without
        positions in the planes.
    sides : Sides
        What the nearest points say of a boundary.
    """

    around: Neighborhoods
    spacing: Floats
    smoothed: Points
    star: Neighborhoods
    sides: Sides


def explore(points: ArrayLike) -> Vicinity:
    """Find out what is around each point: one search that the boundary and the links share.

    Parameters
    ----------
    points : (n, 3) array
        Distinct points, in spatial order; in any other the search takes long.

    Returns
    -------
    Vicinity

    Examples
    --------
    >>> from pointchart import shapes
    >>> vicinity = explore(shapes.grid(12, 9).points)
    >>> int(vicinity.around.sizes.min()), float(vicinity.spacing.min())
    (20, 1.0)
    """
    cloud = check_points(points)
    around = rectangular(BoxTree(cloud).nearest(NEAREST))
    spacing = local_spacing(cloud, around=around)
    smoothed = smooth(cloud, around)
    star, sides = star_and_sides(break_ties(smoothed, spacing), around, local=False)
    return Vicinity(around, spacing, smoothed, star, sides)
