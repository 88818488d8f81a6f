"""What is seen of a mesh or a fitted surface: the place under each pixel, and what it reflects."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..mesh.quality import area_vectors
from ..surface import Surface
from ..surface.tessellation import tessellate
from ..typing import UV, Floats, Indices, Mask, Points, Triangles
from .camera import OBLIQUE

Box: TypeAlias = tuple[float, float, float, float]

GRID = 15_000  # points of the mesh that finds what is seen; each pixel then samples the surface itself
PIXELS = 1_600_000  # of the box around the surface, about twice as many each way as are printed
CHUNK = 500_000  # pixels of the boxes around triangles that are drawn at a time
MARGIN = 3.0  # pixels around the surface


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A surface as it is seen, one sample a pixel.

    Attributes
    ----------
    uv : (h, w, 2) float64
        Parameters under each pixel, nan beside the surface.
    upright : (3, 3) float64
        Its rows are the longest way of the surface, across it, and its mean normal.
    axes : (3, 3) float64
        Directions right, up and towards us.
    box : tuple of float
        Left, right, bottom and top of the picture, in the unit of the surface.
    area : float
        Of the surface, in that unit squared.
    """

    uv: Floats
    upright: Floats
    axes: Floats
    box: Box
    area: float

    @property
    def seen(self) -> UV:
        """Parameters of the pixels on the surface, (k, 2)."""
        return np.asarray(self.uv[np.isfinite(self.uv[:, :, 0])])

    def thinned(self, step: int) -> Self:
        """Return the same picture with fewer pixels."""
        return replace(self, uv=self.uv[::step, ::step])

    def painted(self, colors: Floats) -> Floats:
        """Return the picture of the surface by colours of the pixels on it, as `spread` does."""
        return spread(np.isfinite(self.uv[:, :, 0]), colors)


@dataclass(frozen=True, slots=True, eq=False)
class Raster:
    """What is seen of a mesh at the middle of each pixel.

    Attributes
    ----------
    which : (h, w) int64
        Row of the triangle, -1 beside the mesh.
    corners : (k, 3) int64
        The points of the triangle under each pixel on the mesh, row by row.
    weights : (k, 3) float64
        Their shares of that place.
    box : tuple of float
        Left, right, bottom and top of the picture, in the unit of the mesh.
    """

    which: Indices
    corners: Triangles
    weights: Floats
    box: Box

    @property
    def is_seen(self) -> Mask:
        """Which pixels are on the mesh, (h, w)."""
        return self.which >= 0

    def interpolated(self, values: Floats) -> Floats:
        """Interpolate values of the points, (n,) or (n, c), at the pixels on the mesh."""
        return np.asarray(np.einsum("ij,ij...->i...", self.weights, values[self.corners]))


def look_at(surface: Surface, loops: Sequence[ArrayLike]) -> Scene:
    """Find what is seen of a surface at each pixel, a little from above on its mean plane.

    Parameters
    ----------
    surface : Surface
    loops : sequence of (b, 2) arrays
        Its boundary in the parameter plane, as for `tessellate`.

    Returns
    -------
    Scene
    """
    mesh = tessellate(surface, loops, GRID)
    upright = _upright(*mesh[:2])
    return look_at_mesh(mesh, upright, OBLIQUE @ upright, PIXELS)


def look_at_mesh(mesh: tuple[Points, Triangles, UV], upright: Floats, axes: Floats, pixels: int) -> Scene:
    """Find what is seen of the mesh of a surface, as `tessellate` makes it, along given axes on so many pixels."""
    points, triangles, uv = mesh
    raster = rasterize(points @ axes.T, triangles, pixels)
    image = np.full((*raster.which.shape, 2), np.nan)
    image[raster.is_seen] = raster.interpolated(uv)
    area = float(np.linalg.norm(area_vectors(points, triangles), axis=1).sum())
    return Scene(image, upright, axes, raster.box, area)


def spread(is_seen: Mask, colors: Floats) -> Floats:
    """Return a picture, (h, w, 4), by colours of the pixels that are seen, (k, 3); it is transparent elsewhere."""
    image = np.zeros((*is_seen.shape, 4))
    image[is_seen, :3] = np.clip(colors, 0.0, 1.0)
    image[is_seen, 3] = 1.0
    return image


def _upright(points: Points, triangles: Triangles) -> Floats:
    """Return the longest way of a mesh, the way across it that is up, and its mean normal."""
    vectors = area_vectors(points, triangles)
    normal, centred = vectors.sum(axis=0), points - points.mean(axis=0)
    if np.linalg.norm(normal) < 0.1 * np.linalg.norm(vectors, axis=1).sum():
        normal = np.linalg.svd(centred, full_matrices=False)[2][2]
    normal = normal / np.linalg.norm(normal)
    longest = np.linalg.svd(centred - np.outer(centred @ normal, normal), full_matrices=False)[2][0]
    longest = longest if np.cross(normal, longest).sum() >= 0.0 else -longest
    return np.stack([longest, np.cross(normal, longest), normal])


def rasterize(turned: Points, triangles: Triangles, pixels: int) -> Raster:
    """Find the triangle under the middle of each pixel, near triangles over far ones.

    Parameters
    ----------
    turned : (n, 3) array
        Points, to the right, up and towards us.
    triangles : (m, 3) int array
    pixels : int
        Of the box around the mesh, about.

    Returns
    -------
    Raster
    """
    used = turned[np.unique(triangles), :2]
    low, high = used.min(axis=0), used.max(axis=0)
    sides = np.maximum(high - low, 1e-3 * (high - low).max())
    pixel = float(np.sqrt(sides.prod() / pixels))
    width, height = np.ceil((high - low) / pixel + 2.0 * MARGIN).astype(int).tolist()
    low = low - MARGIN * pixel
    place = (turned[:, :2] - low) / pixel
    which, weights = np.full((height, width), -1), np.empty((height, width, 3))
    back_to_front = np.argsort(turned[triangles, 2].mean(axis=1))
    first, last = (np.rint(end(place[triangles[back_to_front]], axis=1)).astype(int) for end in (np.min, np.max))
    work = np.cumsum((last - first).prod(axis=1))
    for part in np.split(np.arange(len(triangles)), np.searchsorted(work, np.arange(CHUNK, work[-1], CHUNK))):
        _fill(which, weights, place, triangles, back_to_front[part], (first[part], last[part]))
    is_seen = which >= 0
    box = (low[0], low[0] + width * pixel, low[1], low[1] + height * pixel)
    return Raster(which, triangles[which[is_seen]], weights[is_seen], box)


def _fill(
    which: Indices, weights: Floats, place: UV, triangles: Triangles, drawn: Indices, boxes: tuple[Indices, Indices]
) -> None:
    """Write triangles and the shares of their corners into the pixels under them, later ones over earlier ones."""
    first, last = boxes
    width, height = (last - first).T
    k = np.repeat(np.arange(len(drawn)), width * height)
    step = np.arange(len(k)) - np.repeat(np.cumsum(width * height) - width * height, width * height)
    column, row = first[k, 0] + step % width[k], first[k, 1] + step // width[k]
    # The shares of the corners are the doubled areas opposite to them, seen from the middle of the pixel.
    x, y = (place[triangles[drawn[k]]] - np.stack([column + 0.5, row + 0.5], axis=1)[:, None]).transpose(2, 0, 1)
    share = np.roll(x, -1, axis=1) * np.roll(y, 1, axis=1) - np.roll(x, 1, axis=1) * np.roll(y, -1, axis=1)
    total = share.sum(axis=1)
    inside = (share * np.sign(total)[:, None] >= 0.0).all(axis=1) & (total != 0.0)
    which[row[inside], column[inside]] = drawn[k[inside]]
    weights[row[inside], column[inside]] = share[inside] / total[inside, None]


def reflection_angles(facing: Floats, eye: ArrayLike, lines: ArrayLike) -> Floats:
    r"""Return the angle, about the direction of lines of light, at which places of a surface reflect the view.

    The lines are parallel and far away, as is the eye; what it sees in a place of normal n comes from the direction

    .. math:: r = 2 (n \cdot e) n - e

    where e points towards the eye. The angle is 0 there and grows anticlockwise about the lines; places of one angle
    reflect the same line.

    Parameters
    ----------
    facing : (n, 3) array
        Unit normals.
    eye : (3,) array
        Direction towards the eye.
    lines : (3,) array
        Direction of the lines of light, another than that of the eye.

    Returns
    -------
    (n,) float64 array, from -pi to pi; nan where there is no normal.

    Examples
    --------
    >>> half_way = np.array([[0.0, -np.sqrt(0.5), np.sqrt(0.5)]])
    >>> np.rad2deg(reflection_angles(half_way, [0, 0, 1], [1, 0, 0])).round(9)
    array([90.])
    """
    towards, along = np.asarray(eye, np.float64), np.asarray(lines, np.float64)
    reflected = 2.0 * (facing @ towards)[:, None] * facing - towards
    across = np.cross(along, towards)
    return np.asarray(np.arctan2(reflected @ across, reflected @ np.cross(across, along)))


def least_turning(facing: Floats, eye: Floats) -> Floats:
    """Return the direction across the view in which normals vary least: lines of light along it are met most often."""
    sideways = np.nan_to_num(facing - np.outer(facing @ eye, eye))
    return np.asarray(np.linalg.eigh(np.cov(sideways, rowvar=False) + np.outer(eye, eye) * 4.0)[1][:, 0])
