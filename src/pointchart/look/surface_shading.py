"""The colours of a fitted surface at each pixel: of its deviation from a scan, of lines of light, of numbers."""

from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from ..points.trees import search
from ..surface import evaluate, normals
from ..typing import Floats, Points
from .color_scales import rgb
from .paint import COLORED, INK, PAPER, STONE, STRIPED, lit, mixed, paint_image
from .reflections import least_turning, line_spacing, reflection_angles
from .surface_raster import SurfaceRaster

NEAR = 3.0  # mean spacings of the scan, beyond which a place has none: wider than most pores, narrower than gaps
STEEP = 1.6  # of the waves of light over those of a cosine, so that lines have sharp sides


def paint_deviation(axes: Any, seen: SurfaceRaster, points: Points, colors: Floats) -> None:
    """Show a surface in the colours of the scan points nearest to each place, (n, 3), lit a little."""
    places = evaluate(seen.surface, seen.seen)
    distance, nearest = (found[:, 0] for found in search(cKDTree(points), places, 1))
    is_bare = distance >= NEAR * float(np.sqrt(seen.area / len(points)))
    _paint_lit(axes, seen, np.where(is_bare[:, None], STONE, colors[nearest]), COLORED)


def paint_lines(axes: Any, seen: SurfaceRaster) -> float:
    """Show the lines of light that a surface reflects; return how far they are apart, in degrees."""
    facing = normals(seen.surface, seen.seen)
    angles = reflection_angles(facing, seen.eye, least_turning(facing, seen.eye))
    spacing = line_spacing(angles)
    bright = 0.5 + np.clip(STEEP * np.cos(2.0 * np.pi * angles / np.deg2rad(spacing)), -0.5, 0.5)
    _paint_lit(axes, seen, mixed(np.nan_to_num(bright, nan=0.5), PAPER, INK), STRIPED, facing)
    return spacing


def paint_numbers(axes: Any, seen: SurfaceRaster, values: Floats, scale: Any) -> None:
    """Show numbers of the places, (k,), as colours."""
    _paint_lit(axes, seen, rgb(scale, values), STRIPED)


def _paint_lit(axes: Any, seen: SurfaceRaster, colors: Floats, ambient: float, facing: Floats | None = None) -> None:
    turned = (normals(seen.surface, seen.seen) if facing is None else facing) @ seen.axes.T
    paint_image(axes, seen.is_seen, lit(turned, ambient=ambient)[:, None] * colors, seen.box)
