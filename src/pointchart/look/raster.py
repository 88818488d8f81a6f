"""What is under each pixel of a picture of a mesh."""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ..typing import UV, Floats, Indices, Mask, Points, Triangles

Box: TypeAlias = tuple[float, float, float, float]

CHUNK = 500_000  # pixels of the boxes around triangles that are drawn at a time: some 100 MB
MARGIN = 3.0  # pixels around the mesh, so that smoothing, which mixes neighbours, cuts off nothing of its rim
FLATTEST = 1e-3  # height of the box over its width, or the other way round: that of a line would have no pixels


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
    sides = np.maximum(high - low, FLATTEST * (high - low).max())
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
