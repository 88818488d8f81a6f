"""A loop changed by hand: points inserted and dropped, and the way back; knows no page."""

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_loop
from ..errors import InputError
from ..typing import Indices, Loop, Points


def inserted(points: Points, loop: Loop, indices: ArrayLike) -> Loop:
    """Insert points into a loop, one by one where they lengthen it least.

    The nearest to the loop come first; where it has no shape yet, of up to two points, those that are farthest from all
    before (farthest insertion of Rosenkrantz, Stearns and Lewis, 1977), which finds the large shape before the small.

    Parameters
    ----------
    points : (n, 3) array
    loop : (b,) int array
    indices : int or (k,) int array
        Those that are in the loop already stay where they are.

    Returns
    -------
    (b + those that are new,) int64 array.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 0, 0]])
    >>> inserted(corners, np.array([0, 1, 2, 3]), 4).tolist()
    [0, 4, 1, 2, 3]
    """
    new = np.setdiff1d(np.atleast_1d(np.asarray(indices, dtype=np.int64)), loop)
    longer = np.asarray(loop, dtype=np.int64)
    for index in (_by_distance if len(loop) > 2 else _farthest_first)(points, loop, new):
        place, steps = points[longer], np.linalg.norm(points[longer] - points[index], axis=1)
        cost = steps + np.roll(steps, -1) - np.linalg.norm(np.roll(place, -1, axis=0) - place, axis=1)
        longer = np.insert(longer, int(np.argmin(cost)) + 1 if len(longer) > 1 else len(longer), index)
    return longer


def _by_distance(points: Points, loop: Loop, new: Indices) -> Indices:
    from scipy.spatial import cKDTree

    return np.asarray(new[np.argsort(cKDTree(points[loop]).query(points[new])[0], kind="stable")])


def _farthest_first(points: Points, loop: Loop, new: Indices) -> Indices:
    place, order = points[new], np.empty_like(new)
    away = np.linalg.norm(place[:, None] - points[loop], axis=2).min(axis=1, initial=np.inf)
    for position in range(len(new)):
        farthest = int(np.argmax(away))
        order[position] = new[farthest]
        away = np.minimum(away, np.linalg.norm(place - place[farthest], axis=1))
    return order


def dropped(loop: Loop, indices: ArrayLike) -> Loop:
    """Drop points from a loop.

    Examples
    --------
    >>> dropped(np.array([7, 3, 5, 9]), [5, 8]).tolist()
    [7, 3, 9]
    """
    return loop[~np.isin(loop, indices)]


def nearest_of(points: Points, loop: Loop, index: int) -> int:
    """Return the point of a loop that is nearest to a point of the cloud.

    Raises
    ------
    InputError
        If the loop is empty.

    Examples
    --------
    >>> nearest_of(np.array([[0.0, 0, 0], [4, 0, 0], [3, 0, 0]]), np.array([0, 1]), 2)
    1
    """
    if not len(loop):
        raise InputError("the loop has 0 points; find the boundary, or click points to insert them")
    return int(loop[np.argmin(np.linalg.norm(points[loop] - points[index], axis=1))])


class LoopByHand:
    """A loop under way, with the loops that it was before.

    Parameters
    ----------
    n_points : int
        Of the cloud.
    given : (b,) int array, optional
        The user's own loop to begin with.

    Examples
    --------
    >>> hand = LoopByHand(9)
    >>> hand.begin(np.array([4, 1, 7, 8]))
    >>> hand.change(dropped(hand.loop, 8))
    >>> hand.loop.tolist(), hand.is_own
    ([4, 1, 7], True)
    >>> hand.undo()
    >>> hand.loop.tolist(), hand.is_own
    ([4, 1, 7, 8], False)
    """

    def __init__(self, n_points: int, given: ArrayLike | None = None) -> None:
        empty = np.empty(0, np.int64)
        self._past: list[tuple[Loop, bool]] = [(empty, False) if given is None else (check_loop(given, n_points), True)]

    @property
    def loop(self) -> Loop:
        """The loop as it is now, (b,) int64."""
        return self._past[-1][0]

    @property
    def is_own(self) -> bool:
        """Whether it is the user's: given or changed, so that it has to be said what the boundary is."""
        return self._past[-1][1]

    def begin(self, loop: Indices) -> None:
        """Begin again with a loop that was found."""
        self._past.append((np.asarray(loop, dtype=np.int64), False))

    def change(self, loop: Indices) -> None:
        """Take another loop, if it is another."""
        if not np.array_equal(loop, self.loop):
            self._past.append((np.asarray(loop, dtype=np.int64), True))

    def undo(self) -> None:
        """Go back to the loop before.

        Raises
        ------
        InputError
            If there is none.
        """
        if len(self._past) == 1:
            raise InputError("there is no loop before this one")
        self._past.pop()
