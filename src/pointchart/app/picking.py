"""What a click or a drawn polygon means on a cloud of points; knows no page."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..typing import UV, Floats, Mask, Points

AIM = 0.012  # radians: how far beside a point a click may be, some ten pixels
DEEP = 4.0  # times as far as that behind the first point hit, others are hit as well, as on a slanted surface
STEEP = 7.0  # spacings before a point where its line of sight has left a surface that is seen at 80 degrees


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

    @property
    def half(self) -> Floats:
        """Half the width and height of what is seen, one ahead, (2,)."""
        return np.asarray(np.tan(self.fov / 2.0) * np.array([self.aspect, 1.0]))

    def depths(self, points: Points) -> Floats:
        """Return how far ahead points are, (n,)."""
        return np.asarray((points - self.position) @ self.axes[2])


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
    depth = camera.depths(points)[:, None]
    aside = (points - camera.position) @ camera.axes[:2].T
    return np.asarray(0.5 + aside / (2.0 * camera.half * np.where(depth > 0.0, depth, np.nan)))


def unproject(places: UV, camera: Camera, depth: float) -> Points:
    """Return the points so far ahead of a camera that are seen at places of its picture; the inverse of `project`.

    Parameters
    ----------
    places : (n, 2) array
    camera : Camera
    depth : float

    Returns
    -------
    (n, 3) float64 array.

    Examples
    --------
    >>> ahead = Camera(np.zeros(3), np.eye(3), fov=np.pi / 2, aspect=2.0)
    >>> unproject(np.array([[0.5, 0.5], [1.0, 1.0]]), ahead, 5.0).round(9).tolist()
    [[0.0, 0.0, 5.0], [10.0, 5.0, 5.0]]
    """
    rays = np.column_stack([(2.0 * places - 1.0) * camera.half, np.ones(len(places))])
    return np.asarray(camera.position + depth * (rays @ camera.axes))


def visible(points: Points, places: Points, eye: Floats, *, spacing: float) -> Mask:
    """Tell which points of a cloud are seen from a place: those whose lines of sight pass no others closely.

    Parameters
    ----------
    points : (n, 3) array
        What hides.
    places : (k, 3) array
        What may be seen; they may be points of the cloud.
    eye : (3,) array
    spacing : float
        Of the points: a line of sight is cut off where one is as close to it.

    Returns
    -------
    (k,) bool array.

    Examples
    --------
    >>> wall = np.array([[0.0, 0, 5], [0.1, 0, 5], [0, 0, 9], [3, 0, 9]])
    >>> visible(wall, wall[[0, 2, 3]], np.zeros(3), spacing=0.1).tolist()
    [True, False, True]
    """
    from scipy.spatial import cKDTree

    tree, ahead = cKDTree(points), places - eye
    length = np.linalg.norm(ahead, axis=1)
    ahead = ahead / np.maximum(length, 1e-300)[:, None]
    is_seen: Mask = np.ones(len(places), np.bool_)
    # No line of sight is in the cloud for longer than its diagonal.
    farthest = min(float(length.max(initial=0.0)), float(np.linalg.norm(np.ptp(points, axis=0))))
    for before in np.arange(STEEP * spacing, farthest, spacing):
        asked = np.flatnonzero(is_seen & (length > before))
        passed = places[asked] - before * ahead[asked]
        is_seen[asked] = ~np.isfinite(tree.query(passed, distance_upper_bound=spacing)[0])
    return is_seen


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
