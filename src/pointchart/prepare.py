"""Before the first stage: duplicates merged, units and offsets removed, points in spatial order."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ._check import check_points
from .morton import morton_order
from .typing import Indices, Points


@dataclass(frozen=True, slots=True, eq=False)
class Cloud:
    """A scan made ready: distinct points in spatial order, coordinates within -1 and 1.

    Attributes
    ----------
    points : (n, 3) float64
        Dimensionless.
    rows : (n,) int64
        The row of the scan that each point was read from: the first one, where rows repeat a point.
    places : (N,) int64
        The point that each of the N rows of the scan gave.
    scale : float
        Length 1 of the cloud in the unit of the scan; a power of two.
    """

    points: Points
    rows: Indices
    places: Indices
    scale: float

    @property
    def n_repeated(self) -> int:
        """Rows that repeat an earlier one exactly."""
        return len(self.places) - len(self.rows)


def prepare(points: ArrayLike) -> Cloud:
    """Merge repeated points, centre and scale, and sort along a Morton curve.

    The scale is a power of two and the centre a point of the scan, so that coordinates keep their digits and scans that
    differ by such a scale give identical results.

    Parameters
    ----------
    points : (n, 3) array
        In any unit and at any offset.

    Returns
    -------
    Cloud

    Raises
    ------
    InputError
        If there are fewer than 4 distinct points, or they are not finite, or lie on one line.

    Examples
    --------
    >>> cloud = prepare([[8, 8, 0], [0, 0, 0], [8, 8, 0], [8, 0, 0], [0, 8, 0]])
    >>> cloud.rows, cloud.places, cloud.n_repeated
    (array([1, 3, 4, 0]), array([3, 0, 3, 1, 2]), 1)
    """
    scan = check_points(points)
    first, group = _distinct_rows(scan)
    distinct = check_points(scan[first])
    middle = (distinct.min(axis=0) + distinct.max(axis=0)) / 2.0
    centred = distinct - distinct[np.argmin(np.abs(distinct - middle).max(axis=1))]
    exponent = int(np.ceil(np.log2(np.abs(centred).max())))
    unit = np.ldexp(centred, -exponent)
    order = morton_order(unit)
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return Cloud(np.ascontiguousarray(unit[order]), first[order], place[group], 2.0**exponent)


def _distinct_rows(points: Points) -> tuple[Indices, Indices]:
    """List the first row of each distinct point, ascending, and for each row the place of its point in that list."""
    order = np.lexsort(points.T)
    is_new = np.append(True, (points[order[1:]] != points[order[:-1]]).any(axis=1))
    # lexsort is stable: the first of each run of equal points is the earliest row.
    first_of = np.empty_like(order)
    first_of[order] = order[is_new][np.cumsum(is_new) - 1]
    first = np.flatnonzero(first_of == np.arange(len(points)))
    return first, np.searchsorted(first, first_of)
