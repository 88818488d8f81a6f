"""Which boundary points go to the corners of a domain."""

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_loop, check_points
from ..errors import InputError
from ..typing import Floats, Indices, Points
from .steps import checked_steps, chord_length_steps


def quarter_places(steps: Floats) -> Indices:
    """Find four places on the loop that quarter its length as nearly as the points allow.

    Examples
    --------
    >>> quarter_places([1, 1, 2, 2, 2]).tolist()
    [0, 2, 3, 4]
    """
    lengths = checked_steps(steps)
    b = len(lengths)
    if b < 4:
        raise InputError(f"the boundary has {b} points; a square needs at least 4: use the circle")
    start = np.cumsum(lengths) - lengths
    places = [0]
    for k in range(1, 4):
        free = np.arange(places[-1] + 1, b - 3 + k)
        places.append(int(free[np.argmin(np.abs(start[free] - k * lengths.sum() / 4))]))
    return np.array(places)


def places_of(corners: ArrayLike, loop: ArrayLike) -> Indices:
    """Find the places of boundary points on the loop, in the order of the loop, the first given one first.

    Raises
    ------
    InputError
        If a corner is not on the loop.

    Examples
    --------
    >>> places_of([7, 3, 9], [3, 5, 7, 9])
    array([2, 3, 0])
    """
    rim, names = np.asarray(loop), np.asarray(corners)
    missing = names[~np.isin(names, rim)]
    if len(missing):
        raise InputError("corners {missing} are not on the boundary; choose boundary points", missing=missing)
    places = np.array([int(np.flatnonzero(rim == name)[0]) for name in names])
    ordered = np.sort(places)
    return np.roll(ordered, -int(np.flatnonzero(ordered == places[0])[0]))


def sharpest_places(points: ArrayLike, loop: ArrayLike, count: int = 4) -> Indices:
    """Find the places where the loop turns most sharply, at least half a fair share of its length apart.

    The turn at a point is measured between the chords to the points a twentieth of the length before and behind it, so
    that the raggedness of a scan's edge does not count.

    Parameters
    ----------
    points : (n, 3) array
    loop : (b,) int array
    count : int

    Returns
    -------
    (count,) int64 array of places on the loop, ascending.

    Examples
    --------
    >>> rectangle = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0], [2, 2, 0], [1, 2, 0], [0, 2, 0], [0, 1, 0]]
    >>> sharpest_places(rectangle, range(8))
    array([0, 2, 4, 6])
    """
    cloud = check_points(points)
    rim = check_loop(loop, len(cloud))
    if len(rim) < count:
        raise InputError(f"the boundary has {len(rim)} points; {count} corners need at least as many: use the circle")
    steps = chord_length_steps(cloud, rim)
    at, total = np.cumsum(steps) - steps, steps.sum()
    # Twenty windows a loop smooth ragged edges; a coarse loop falls back on the neighbouring points.
    reach = max(total / 20.0, steps.max() * (1.0 + 1e-9)) if len(rim) > 8 else steps.max()
    behind = cloud[rim] - _position(cloud[rim], at, total, at - reach)
    ahead = _position(cloud[rim], at, total, at + reach) - cloud[rim]
    lengths = np.linalg.norm(behind, axis=1) * np.linalg.norm(ahead, axis=1)
    turn = 1.0 - np.einsum("ij,ij->i", behind, ahead) / np.where(lengths > 0.0, lengths, 1.0)
    chosen: list[int] = []
    apart = total / (2 * count)
    while len(chosen) < count:
        distance = np.full(len(rim), np.inf)
        for place in chosen:
            gap = np.abs(at - at[place])
            distance = np.minimum(distance, np.minimum(gap, total - gap))
        allowed = distance >= apart if (distance >= apart).any() else distance == distance.max()
        chosen.append(int(np.argmax(np.where(allowed, turn, -1.0))))
    return np.sort(np.array(chosen))


def _position(corners: Points, at: Floats, total: float, where: Floats) -> Points:
    """Interpolate along the closed polygon at arc lengths `where`."""
    closed_at, closed = np.append(at, total), np.vstack([corners, corners[:1]])
    return np.column_stack([np.interp(where % total, closed_at, closed[:, axis]) for axis in range(3)])
