"""The neighbourhood of one point of a large cloud: Figures 1 to 3 of the paper."""

from dataclasses import dataclass

import numpy as np

from ..errors import InputError, points_called
from ..map.scan_parameters import Connect
from ..map.weights import WeightScheme
from ..points.neighborhoods import Rings
from ..typing import Indices, Points, Weights

LEAST = 100  # points around the centre that are looked at
ROOM = 4  # times as many as the k asked for
MOST = 2000  # points whose neighbourhoods are found within a second or two, to show that of one


@dataclass(frozen=True, slots=True, eq=False)
class Around:
    """The neighbours of a point.

    Attributes
    ----------
    centre : int
    neighbors : (k,) int64
        In order round the centre for a star, nearest first otherwise.
    weights : (k,) float64
        Convex.
    is_star : bool
        Whether the neighbours are in order.
    is_open : bool
        Whether a star has a gap of half a turn, as on the boundary.
    """

    center: int
    neighbors: Indices
    weights: Weights
    is_star: bool
    is_open: bool


def around_point(
    points: Points, center: int, connect: Connect, scheme: WeightScheme, *, k: int = 0, radius: float = 0.0
) -> Around:
    """Find the neighbours of one point, and their weights, as all points together would give them.

    Parameters
    ----------
    points : (n, 3) array
    centre : int
    connect : callable
        ``connect(points) -> Neighborhoods``; a neighbourhood may depend on the points within `radius` and the `k`
        nearest.
    scheme : callable
        ``scheme(points, neighborhoods) -> (nnz,)``.
    k, radius

    Returns
    -------
    Around

    Raises
    ------
    InputError
        If so many points would be looked at that it takes more than a moment.

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.map.weights import uniform
    >>> line = np.array([[0.0, 0, 0], [1, 0, 0], [3, 0, 0], [3, 1, 0], [9, 9, 9]])
    >>> around_point(line, 3, lambda points: nearest(points, 2), uniform, k=2).neighbors.tolist()
    [2, 1]
    """
    if k >= len(points) or ROOM * k > MOST:
        most = min(len(points) - 1, MOST // ROOM)
        raise InputError(f"k is {k}, but of {len(points)} points at most {most} neighbours are shown; take a smaller k")
    rows, local = _near(points, center, max(LEAST, ROOM * k), radius)
    with points_called(rows):
        found = connect(local)
        weights = scheme(local, found)
    row = slice(found.indptr[0], found.indptr[1])
    is_open = isinstance(found, Rings) and bool(found.is_open[0])
    return Around(center, rows[found.indices[row]], weights[row], isinstance(found, Rings), is_open)


def _near(points: Points, center: int, least: int, radius: float) -> tuple[Indices, Points]:
    """Return the distinct points near one, itself first, and where they are from there."""
    offset = points - points[center]
    square = np.einsum("ij,ij->i", offset, offset)
    within = np.count_nonzero(square < radius * radius)
    if within > MOST:
        raise InputError(
            f"the ball of radius {radius:g} around point {center} holds {within} points, and at most {MOST} are looked "
            "at here; take a smaller radius"
        )
    reach = np.partition(square, least)[least] if least < len(points) else np.inf
    rows = np.flatnonzero(square <= max(reach, radius * radius))
    rows = rows[np.argsort(square[rows], kind="stable")]
    rows = np.concatenate([[center], rows[rows != center]])
    first = np.sort(np.unique(offset[rows], axis=0, return_index=True)[1])
    return rows[first], np.ascontiguousarray(offset[rows[first]])
