"""The places where a mesh passes through itself, as a result of one search."""

from dataclasses import dataclass

from ..typing import Indices, Points, Triangles
from .intersections import places_of, self_intersections


@dataclass(frozen=True, slots=True, eq=False)
class SelfIntersections:
    """Where a mesh passes through itself.

    Attributes
    ----------
    pairs : (k, 2) int64
        The triangles that meet, as of `self_intersections`.
    places : (p, 3) float64
        A point of each place where some do, the place of most pairs first.
    """

    pairs: Indices
    places: Points


def find_places(points: Points, triangles: Triangles) -> SelfIntersections:
    """Find where a mesh passes through itself, exactly; see `self_intersections`.

    Examples
    --------
    >>> import numpy as np
    >>> upright = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [9, 9, 0]])
    >>> len(find_places(upright, np.array([[3, 4, 5], [0, 1, 2]])).places)
    1
    """
    pairs = self_intersections(points, triangles)
    return SelfIntersections(pairs, places_of(points, triangles, pairs))
