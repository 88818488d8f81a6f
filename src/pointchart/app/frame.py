"""Where the points of a scan are on the page: centred, of one size, upright, and thinned where they are many."""

import numpy as np

from ..look.camera import camera, upright_axes, upward
from ..points.neighborhoods import Neighborhoods
from ..typing import Floats, Indices, Points, Triangles

SIZE = 4.0  # diagonal of the scan on the page
SOME = 10_000  # points that tell how a scan stands
STEEPEST, LEVEL = np.deg2rad(60.0), 1e-6  # how far down we look at most, and what is no direction to look along
MOST = 0.9  # share of the points that tells the spacing: the others are farther from their neighbours
LIGHT = np.array([-0.45, -0.7, 0.55]) / np.linalg.norm([-0.45, -0.7, 0.55])  # direction towards it


class Frame:
    """The way from the scan to the page, where it is about the middle and of one size.

    Parameters
    ----------
    points : (n, 3) array

    Attributes
    ----------
    scale : float
        Length on the page of a step of one in the file.

    Examples
    --------
    >>> sheet = np.array([[7.0, 7, 0], [9, 7, 0], [9, 9, 0], [7, 9, 0]])
    >>> [round(float(x), 2) for x in Frame(sheet).places(sheet)[2]]
    [1.41, 1.41, 0.0]
    """

    def __init__(self, points: Points) -> None:
        low, high = points.min(axis=0), points.max(axis=0)
        self._middle = (low + high) / 2.0
        self.scale = SIZE / float(np.linalg.norm(high - low))

    def places(self, points: Points) -> Floats:
        """Return places about the middle, in the axes of the file, (n, 3) float32."""
        return np.asarray(((points - self._middle) * self.scale).astype(np.float32))

    def plane(self, uv: Floats) -> Floats:
        """Return where parameters are on the page, upright and facing the viewer, (n, 3) float32."""
        low, high = uv.min(axis=0), uv.max(axis=0)
        flat = (uv - (low + high) / 2.0) * (SIZE / max(float(np.linalg.norm(high - low)), 1e-300))
        return np.column_stack([flat[:, 0], np.zeros(len(uv)), flat[:, 1]]).astype(np.float32)


def stance(points: Points, up: str | None = None) -> tuple[Floats, Floats]:
    """Choose how a scan stands on the page, seen from where figures see it, but neither from below nor straight down.

    Parameters
    ----------
    points : (n, 3) array
    up : str, optional
        The axis of the file that is upwards; by default that of `upward`.

    Returns
    -------
    axes : (3, 3) float64 array
        Its rows are the directions, in the file, to the right, away from the viewer and upwards on the page.
    facing : (3,) float64 array
        Direction on the page from which the scan is looked at.

    Examples
    --------
    >>> axes, facing = stance(np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 1], [1, 0, 1]]))
    >>> axes[2].tolist(), facing.round(2).tolist()
    ([0.0, 0.0, 1.0], [0.0, -0.91, 0.42])
    """
    some = points[:: max(1, len(points) // SOME)]
    _, above, in_front = upright_axes(upward(some) if up is None else up)
    towards = camera(some, up=up)[2]
    height = float(towards @ above)
    level = towards - height * above
    if np.linalg.norm(level) < LEVEL:
        level = in_front
    away = -level / np.linalg.norm(level)
    tilt = np.clip(np.arcsin(np.clip(height, -1.0, 1.0)), 0.0, STEEPEST)
    return np.stack([np.cross(away, above), away, above]), np.array([0.0, -np.cos(tilt), np.sin(tilt)])


def spacing(points: Points, around: Neighborhoods) -> float:
    """Return the step of a square grid that is as dense as most points are at least.

    Parameters
    ----------
    points : (n, 3) array
    around : Neighborhoods
        Their nearest, as many for each.

    Examples
    --------
    >>> from pointchart import nearest, shapes
    >>> sheet = shapes.grid(40, 40).points
    >>> 0.8 < spacing(sheet, nearest(sheet, 12)) < 1.6
    True
    """
    farthest = around.indices.reshape(len(points), -1)[:, -1]
    reach = np.quantile(np.linalg.norm(points[farthest] - points, axis=1), MOST)
    return float(reach * np.sqrt(np.pi / (around.sizes[0] + 1)))


def thinned(n_points: int, most: int) -> Indices:
    """Choose rows of so many points at random, the same ones on every call.

    Examples
    --------
    >>> thinned(3, 5).tolist(), len(thinned(100, 5))
    ([0, 1, 2], 5)
    """
    if n_points <= most:
        return np.arange(n_points)
    return np.sort(np.random.default_rng(0).choice(n_points, most, replace=False, shuffle=False))


def coarser(places: Floats, triangles: Triangles, most: int) -> tuple[Floats, Triangles]:
    """Join the vertices of a mesh in each cell of a grid, so that a large one can be drawn.

    Parameters
    ----------
    places : (n, 3) float32 array
    triangles : (m, 3) int array
    most : int
        Triangles up to which a mesh stays as it is.

    Returns
    -------
    places, triangles

    Examples
    --------
    >>> strip = np.array([[0, 0, 0], [0.9, 0, 0], [0.8, 0.1, 0], [0.1, 0.9, 0]], np.float32)
    >>> [len(part) for part in coarser(strip, np.array([[0, 1, 2], [0, 2, 3]]), 8)]
    [4, 2]
    """
    if len(triangles) <= most:
        return places, triangles
    # A surface of m triangles crosses some m / 2 cells, and the number of cells falls with the square of their size.
    extent = float(np.ptp(places, axis=0).max())
    cell = extent / np.sqrt(most / 2.0)
    _, first, joined = np.unique(
        np.floor(places / cell).astype(np.int64), axis=0, return_index=True, return_inverse=True
    )
    corners = joined.reshape(-1)[triangles]
    a, b, c = corners.T
    kept = np.unique(corners[(a != b) & (b != c) & (c != a)], axis=0)
    return places[first], kept


def shades(upright: Floats) -> Floats:
    """Light a surface from the front, above and left, whichever side of it is seen.

    Parameters
    ----------
    upright : (n, 3) array
        Unit normals, on the page.

    Returns
    -------
    (n,) float64 array, from .35, which faces the light edge on, to 1.

    Examples
    --------
    >>> shades(np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])).round(2).tolist()
    [0.71, 0.71]
    """
    return np.asarray(0.35 + 0.65 * np.abs(upright @ LIGHT))
