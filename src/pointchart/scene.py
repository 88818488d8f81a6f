"""What is seen of a fitted surface: the parameters under each pixel, and how light falls there."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from .fit import Surface
from .fit.tessellate import tessellate
from .picture import PAPER
from .quality import area_vectors
from .typing import UV, Floats, Points, Triangles

GRID = 15_000  # points of the mesh that finds what is seen; each pixel then samples the surface itself
PIXELS = 1_600_000  # of the box around the surface, about twice as many each way as are printed
CHUNK = 4096  # triangles drawn at a time
MARGIN = 3.0  # pixels around the surface
TURN, TILT = np.deg2rad([-10.0, 25.0])
OBLIQUE = np.array(  # out of the view along the mean normal
    [
        [np.cos(TURN), 0.0, np.sin(TURN)],
        [np.sin(TILT) * np.sin(TURN), np.cos(TILT), -np.sin(TILT) * np.cos(TURN)],
        [-np.cos(TILT) * np.sin(TURN), np.sin(TILT), np.cos(TILT) * np.cos(TURN)],
    ]
)
BRIGHTEST = 0.85  # cosine of the angle to the light within which places have their full colour
LIGHT = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A surface as it is seen, one sample a pixel.

    Attributes
    ----------
    uv : (h, w, 2) float64
        Parameters under each pixel, nan beside the surface.
    upright : (3, 3) float64
        Its rows are the longest way of the surface, across it, and its mean normal.
    box : tuple of float
        Left, right, bottom and top of the picture, in the unit of the surface.
    area : float
        Of the surface, in that unit squared.
    """

    uv: Floats
    upright: Floats
    box: tuple[float, float, float, float]
    area: float

    @property
    def seen(self) -> UV:
        """Parameters of the pixels on the surface, (k, 2)."""
        return np.asarray(self.uv[np.isfinite(self.uv[:, :, 0])])

    @property
    def axes(self) -> Floats:
        """Directions right, up and towards us, (3, 3): `upright` turned a little."""
        return np.asarray(OBLIQUE @ self.upright)

    def thinned(self, step: int) -> Self:
        """Return the same picture with fewer pixels."""
        return replace(self, uv=self.uv[::step, ::step])

    def painted(self, colors: Floats) -> Floats:
        """Return the picture of the surface on paper, (h, w, 3), by colours of the pixels on it, (k, 3)."""
        from matplotlib.colors import to_rgb

        image = np.full((*self.uv.shape[:2], 3), to_rgb(PAPER))
        image[np.isfinite(self.uv[:, :, 0])] = np.clip(colors, 0.0, 1.0)
        return image


def look_at(surface: Surface, loops: Sequence[ArrayLike]) -> Scene:
    """Find what is seen of a surface at each pixel.

    Parameters
    ----------
    surface : Surface
    loops : sequence of (b, 2) arrays
        Its boundary in the parameter plane, as for `tessellate`.

    Returns
    -------
    Scene
    """
    points, triangles, uv = tessellate(surface, loops, GRID)
    upright = _upright(points, triangles)
    turned = points @ (OBLIQUE @ upright).T
    low, high = turned[:, :2].min(axis=0), turned[:, :2].max(axis=0)
    pixel = float(np.sqrt((high - low).prod() / PIXELS))
    width, height = np.ceil((high - low) / pixel + 2.0 * MARGIN).astype(int).tolist()
    low = low - MARGIN * pixel
    back_to_front = np.argsort(turned[triangles, 2].mean(axis=1))
    seen = _rasterize((turned[:, :2] - low) / pixel, triangles[back_to_front], uv, (height, width))
    box = (low[0], low[0] + width * pixel, low[1], low[1] + height * pixel)
    return Scene(seen, upright, box, float(np.linalg.norm(area_vectors(points, triangles), axis=1).sum()))


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


def _rasterize(place: Floats, triangles: Triangles, uv: UV, shape: tuple[int, int]) -> Floats:
    """Interpolate parameters at the middle of each pixel, later triangles over earlier ones; nan beside them."""
    image = np.full((*shape, 2), np.nan)
    for part in np.array_split(triangles, len(triangles) // CHUNK + 1):
        low, high = np.rint(place[part].min(axis=1)).astype(int), np.rint(place[part].max(axis=1)).astype(int)
        width, height = (high - low).T
        which = np.repeat(np.arange(len(part)), width * height)
        step = np.arange(len(which)) - np.repeat(np.cumsum(width * height) - width * height, width * height)
        column, row = low[which, 0] + step % width[which], low[which, 1] + step // width[which]
        # The shares of the corners are the doubled areas opposite to them, seen from the middle of the pixel.
        x, y = (place[part[which]] - np.stack([column + 0.5, row + 0.5], axis=1)[:, None]).transpose(2, 0, 1)
        share = np.roll(x, -1, axis=1) * np.roll(y, 1, axis=1) - np.roll(x, 1, axis=1) * np.roll(y, -1, axis=1)
        total = share.sum(axis=1)
        inside = (share * np.sign(total)[:, None] >= 0.0).all(axis=1) & (total != 0.0)
        weights = share[inside] / total[inside, None]
        image[row[inside], column[inside]] = np.einsum("ij,ijk->ik", weights, uv[part[which[inside]]])
    return image


def lit(turned: Floats, *, ambient: float) -> Floats:
    """Return the brightness of places by their normals, lit from the upper left; the back is darker."""
    shade = ambient + (1.0 - ambient) * np.clip(turned @ LIGHT / BRIGHTEST, 0.0, 1.0)
    return np.asarray(np.where(turned[:, 2] < 0.0, 0.6, 1.0) * np.nan_to_num(shade, nan=ambient))


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
