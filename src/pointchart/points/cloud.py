"""Before the first stage: duplicates merged, units and offsets removed, points in spatial order."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points
from .._kernels.points.tie_hash import shift_points
from .._parallel import over_ranges
from ..typing import Indices, Keys, Points
from .morton import morton_keys
from .ties import tie_keys


@dataclass(frozen=True, slots=True, eq=False)
class Cloud:
    """A scan made ready: distinct points in spatial order, coordinates within -1 and 1.

    Attributes
    ----------
    points : (n, 3) float64
        Dimensionless.
    rows : (n,) int64
        The row of the scan that each point was read from: the first one, where rows repeat a point.
    places : (N,) int32
        The point that each of the N rows of the scan gave.
    scale : float
        Length 1 of the cloud in the unit of the scan; a power of two.
    keys : (n,) uint64
        A hash of each point's coordinates in the scan, by which ties are broken: the same in any part of the scan.
    """

    points: Points
    rows: Indices
    places: Indices
    scale: float
    keys: Keys

    @property
    def n_repeated(self) -> int:
        """Rows that repeat an earlier one exactly."""
        return len(self.places) - len(self.rows)


def prepare(points: ArrayLike) -> Cloud:
    """Merge repeated points, centre and scale, and sort along a Morton curve.

    The scale is a power of two and the centre a point of the scan, so that coordinates keep their digits and scans that
    differ by such a scale give identical results. Axes on which a centre would round a coordinate, as none can that has
    an offset of twice its extent or more, stay without one: prepared points are exactly those of the scan.

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
    >>> cloud.rows.tolist(), cloud.places.tolist(), cloud.n_repeated
    ([1, 3, 4, 0], [3, 0, 3, 1, 2], 1)
    """
    return made_ready(check_points(points))


def made_ready(scan: Points) -> Cloud:
    """Prepare a scan as `prepare` does, after its first check; that it has distinct points enough is checked here."""
    keys = morton_keys(scan)
    order = np.argsort(keys, kind="stable")
    first = _first_rows(scan, order, keys[order])
    is_first = first == np.arange(len(scan), dtype=first.dtype)
    rows = order[is_first[order]]
    places = np.empty(len(scan), np.int32)
    places[rows] = np.arange(len(rows), dtype=np.int32)
    distinct = check_points(scan[rows])
    centered = _centered(distinct)
    exponent = int(np.ceil(np.log2(max(centered.max(), -centered.min()))))
    return Cloud(np.ldexp(centered, -exponent), rows, places[first], 2.0**exponent, tie_keys(distinct))


def _centered(points: Points) -> Points:
    """Move a point near the middle to the origin, on those axes on which this rounds no coordinate."""
    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    center = points[np.argmin(np.abs(points - middle).max(axis=1))]
    centered, is_rounded = np.empty_like(points), np.zeros(3, bool)

    over_ranges(
        lambda first, last: shift_points(points, center, first, last, centered, is_rounded),
        len(points),
    )
    centered[:, is_rounded] = points[:, is_rounded]
    return centered


def _first_rows(points: Points, order: Indices, keys: Indices) -> Indices:
    """Return for each point the first row of its coordinates, (n,) int32, given its order and keys along a curve.

    Only points that share their key can be the same.
    """
    first = np.arange(len(points), dtype=np.int32)
    is_same = keys[1:] == keys[:-1]
    shared = order[np.append(is_same, False) | np.insert(is_same, 0, False)]
    if len(shared):
        # lexsort is stable: the first of each run of equal points is the earliest row.
        run = shared[np.lexsort(points[shared].T)]
        is_new = np.append(True, (points[run[1:]] != points[run[:-1]]).any(axis=1))
        first[run] = run[is_new][np.cumsum(is_new) - 1]
    return first
