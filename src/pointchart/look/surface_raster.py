"""What is under each pixel of a picture of a fitted surface: a mesh finds it, the surface itself is sampled there."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..mesh.quality import area_vectors
from ..surface import Surface
from ..surface.tessellation import tessellate
from ..typing import UV, Floats, Mask, Points, Triangles
from .raster import Box, rasterize

SurfaceMesh: TypeAlias = tuple[Points, Triangles, UV]

GRID = 15_000  # points of the mesh that finds what is seen; each pixel then samples the surface itself


@dataclass(frozen=True, slots=True, eq=False)
class SurfaceRaster:
    """What is seen of a surface, one sample a pixel.

    Attributes
    ----------
    surface : Surface
    uv : (h, w, 2) float64
        Parameters under each pixel, nan beside the surface.
    axes : (3, 3) float64
        Directions right, up and towards us.
    eye : (3,) float64
        Direction from which lines of light are seen.
    box : tuple of float
        Left, right, bottom and top of the picture, in the unit of the surface.
    area : float
        Of the surface, in that unit squared.
    """

    surface: Surface
    uv: Floats
    axes: Floats
    eye: Floats
    box: Box
    area: float

    @property
    def is_seen(self) -> Mask:
        """Which pixels are on the surface, (h, w)."""
        return np.isfinite(self.uv[:, :, 0])

    @property
    def seen(self) -> UV:
        """Parameters of the pixels on the surface, (k, 2)."""
        return np.asarray(self.uv[self.is_seen])

    def thinned(self, step: int) -> Self:
        """Return the same picture with fewer pixels."""
        return replace(self, uv=self.uv[::step, ::step])


def coarse_mesh(surface: Surface, loops: Sequence[ArrayLike]) -> SurfaceMesh:
    """Mesh a surface within its loops in the parameter plane, finely enough to find what is seen of it."""
    return tessellate(surface, loops, GRID)


def look_at(surface: Surface, mesh: SurfaceMesh, axes: Floats, eye: Floats, pixels: int) -> SurfaceRaster:
    """Find what is seen of a surface along given axes, on so many pixels.

    Parameters
    ----------
    surface : Surface
    mesh : points, triangles, uv
        As `coarse_mesh` makes it.
    axes : (3, 3) array
        Directions right, up and towards us.
    eye : (3,) array
        Direction from which lines of light are seen.
    pixels : int
        Of the box around the surface, about.
    """
    points, triangles, uv = mesh
    raster = rasterize(points @ axes.T, triangles, pixels)
    image = np.full((*raster.which.shape, 2), np.nan)
    image[raster.is_seen] = raster.interpolated(uv)
    area = float(np.linalg.norm(area_vectors(points, triangles), axis=1).sum())
    return SurfaceRaster(surface, image, axes, eye, raster.box, area)
