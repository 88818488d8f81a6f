"""What a click or a drawn polygon means on a cloud of points, and a loop changed by hand; knows no page."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_loop
from ..errors import InputError
from ..typing import UV, Floats, Indices, Loop, Mask, Points

AIM = 0.012  # radians: how far beside a point a click may be, some ten pixels
DEEP = 4.0  # times as far as that behind the first point hit, others are hit as well, as on a slanted surface


@dataclass(frozen=True, slots=True, eq=False)
class Camera:
    """A pinhole camera.

    Attributes
    ----------
    position : (3,) float64
    axes : (3, 3) float64
        Its rows are the directions right, down and ahead.
    fov : float
        Vertical field of view, in radians.
    aspect : float
        Width of the picture over its height.
    """

    position: Floats
    axes: Floats
    fov: float
    aspect: float


def project(points: Points, camera: Camera) -> UV:
    """Return where points are seen: (0, 0) is the upper left corner, (1, 1) the lower right; nan if behind.

    Parameters
    ----------
    points : (n, 3) array
    camera : Camera

    Returns
    -------
    (n, 2) float64 array.

    Examples
    --------
    >>> ahead = Camera(np.zeros(3), np.eye(3), fov=np.pi / 2, aspect=2.0)
    >>> project(np.array([[0.0, 0, 5], [2, 1, 1], [0, 0, -1]]), ahead).tolist()
    [[0.5, 0.5], [1.0, 1.0], [nan, nan]]
    """
    right, down, depth = camera.axes @ (points - camera.position).T
    depth = np.where(depth > 0.0, depth, np.nan)
    half = np.tan(camera.fov / 2.0) * np.array([camera.aspect, 1.0])
    return np.asarray(0.5 + np.column_stack([right, down]) / (2.0 * half * depth[:, None]))


def nearest_to_ray(
    points: Points, origin: ArrayLike, direction: ArrayLike, *, reach: float = 0.0, aim: float = AIM
) -> int | None:
    """Find the point that a click means: of those close to its ray and in front, the one closest to it.

    Parameters
    ----------
    points : (n, 3) array
    origin, direction : (3,) arrays
    reach : float
        Distance from the ray within which a point is hit: its size as it is drawn.
    aim : float
        Angle from the ray within which it is hit as well, in radians.

    Returns
    -------
    Its index, None if no point is hit.

    Examples
    --------
    >>> column = np.array([[0.0, 0, 9], [0.01, 0, 5], [3, 0, 5], [0, 0, -1]])
    >>> nearest_to_ray(column, [0, 0, 0], [0, 0, 2])
    1
    >>> nearest_to_ray(column, [0, 0, 0], [0, 1, 0]) is None
    True
    """
    ray = (np.asarray(direction, dtype=np.float64) / np.linalg.norm(direction)).astype(points.dtype)
    offset = points - np.asarray(origin, dtype=points.dtype)
    depth = offset @ ray
    offset -= depth[:, None] * ray
    beside = np.sqrt(np.einsum("ij,ij->i", offset, offset))
    hit = np.flatnonzero((depth > 0.0) & (beside <= np.maximum(np.tan(aim) * depth, reach)))
    if not len(hit):
        return None
    nearest = depth[hit].min()
    front = hit[depth[hit] <= nearest + DEEP * max(np.tan(aim) * nearest, reach)]
    return int(front[np.argmin(beside[front] / depth[front])])


def inside_polygon(places: UV, polygon: ArrayLike) -> Mask:
    """Tell which places lie inside a polygon, by the number of its sides that a ray to the left crosses.

    Parameters
    ----------
    places : (n, 2) array
        Those with nan are outside.
    polygon : (k, 2) array
        Corners in order, not closed.

    Returns
    -------
    (n,) bool array.

    Examples
    --------
    >>> inside_polygon(np.array([[1.0, 1], [3, 1], [np.nan, 1]]), [[0, 0], [2, 0], [2, 2], [0, 2]]).tolist()
    [True, False, False]
    """
    corners = np.asarray(polygon, dtype=np.float64)
    x, y = places.T
    is_inside = np.zeros(len(places), np.bool_)
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        spans = (y0 > y) != (y1 > y)
        is_inside ^= spans & ((x - x0) * abs(y1 - y0) > (y - y0) * (x1 - x0) * np.sign(y1 - y0))
    return is_inside


def inserted(points: Points, loop: Loop, indices: ArrayLike) -> Loop:
    """Insert points into a loop, one by one where they lengthen it least, the nearest to it first.

    Parameters
    ----------
    points : (n, 3) array
    loop : (b,) int array
    indices : int or (k,) int array
        Those that are in the loop already stay where they are.

    Returns
    -------
    (b + k,) int64 array.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 0, 0]])
    >>> inserted(corners, np.array([0, 1, 2, 3]), 4).tolist()
    [0, 4, 1, 2, 3]
    """
    new = np.setdiff1d(np.atleast_1d(np.asarray(indices, dtype=np.int64)), loop)
    if len(loop):
        from scipy.spatial import cKDTree

        new = new[np.argsort(cKDTree(points[loop]).query(points[new])[0], kind="stable")]
    longer = np.asarray(loop, dtype=np.int64)
    for index in new:
        place, steps = points[longer], np.linalg.norm(points[longer] - points[index], axis=1)
        cost = steps + np.roll(steps, -1) - np.linalg.norm(np.roll(place, -1, axis=0) - place, axis=1)
        longer = np.insert(longer, int(np.argmin(cost)) + 1 if len(longer) > 1 else len(longer), index)
    return longer


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
        """Go back to the loop before, if there is one."""
        if len(self._past) > 1:
            self._past.pop()
