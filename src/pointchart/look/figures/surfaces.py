"""Figures of a fitted surface: its deviation from a scan, and the lines of light that it reflects."""

from collections.abc import Sequence
from pathlib import Path
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from ..._check import check_points
from ...errors import InputError
from ...io.source import AnyPath
from ...points.trees import search
from ...surface import Deviation, Surface, closest_parameters, measure_deviation
from ...typing import Points
from ..camera import Standpoint, camera
from ..color_scales import diverging, rgb, round_up
from ..paint import save
from ..surface_raster import SurfaceMesh, SurfaceRaster, coarse_mesh, look_at
from ..surface_shading import paint_deviation, paint_lines
from .sheet import COLUMN, Panel, Sheet, check_sheet, image_pixels, lay_out, show_scale

ELSEWHERE = 0.1  # of the scan's diagonal: of which half the points are farther away, that surface is not its own
MOST = 99.0  # per cent of the points whose deviation the scale holds: all but outliers
ROUNDING = 1e-12  # of the scan's extent: a scale that is shorter would colour rounding


def draw_deviation_map(
    path: AnyPath,
    surface: Surface,
    loops: Sequence[ArrayLike],
    points: Points,
    *,
    limit: float | None = None,
    unit: str = "mm",
    sheet: Sheet = COLUMN,
    **standpoint: Unpack[Standpoint],
) -> None:
    """Draw how far a scan is from its surface: warm where it is above, on the side of the normal, cold below.

    Each place of the surface has the colour of the scan point nearest to it, and that of stone where none is near.

    Parameters
    ----------
    path
        A `.png`, `.svg` or `.pdf` file; one that exists is replaced.
    surface : Surface
    loops : sequence of (b, 2) arrays
        Its boundary in the parameter plane, as for `tessellate`.
    points : (n, 3) array
        The scan.
    limit : float, optional
        Deviation at which the scale of colours ends, more than 0, in the unit of the scan; by default 99 per cent of
        the points are within it.
    unit : str
        Of the scan, such as "mm".
    sheet : Sheet, optional
        By default a column of 85 mm at 300 dpi.
    view, up
        As for `camera`.

    Raises
    ------
    FormatError
        The file cannot be written.
    InputError
        On points that are none or far from the surface, or a limit that is no length.
    """
    check_sheet(path, sheet)
    if limit is not None and not 0.0 < limit < np.inf:
        raise InputError(f"the limit of the colours is {limit:g}; give a length more than 0, in {unit}")
    cloud = check_points(points)
    mesh = coarse_mesh(surface, loops)
    deviation = _deviation(surface, mesh, cloud)
    _check_same(deviation, cloud)
    rounding = ROUNDING * float(np.ptp(cloud, axis=0).max())
    reach = round_up(max(deviation.percentile(MOST), rounding)) if limit is None else limit
    panel, seen = _seen(surface, mesh, sheet, standpoint, has_bar=True)
    scale = diverging(reach)
    paint_deviation(panel.axes, seen, cloud, rgb(scale, deviation.signed))
    show_scale(panel, scale, f"deviation in {unit}", [-reach, 0.0, reach])
    save(panel.figure, Path(path), dpi=sheet.dpi)


def draw_zebra(
    path: AnyPath,
    surface: Surface,
    loops: Sequence[ArrayLike],
    *,
    sheet: Sheet = COLUMN,
    **standpoint: Unpack[Standpoint],
) -> None:
    """Draw how a surface reflects parallel lines of light: smooth where its curvature is continuous.

    Parameters
    ----------
    path
        A `.png`, `.svg` or `.pdf` file; one that exists is replaced.
    surface : Surface
    loops : sequence of (b, 2) arrays
        Its boundary in the parameter plane, as for `tessellate`.
    sheet : Sheet, optional
        By default a column of 85 mm at 300 dpi.
    view, up
        As for `camera`.

    Raises
    ------
    FormatError
        The file cannot be written.
    """
    check_sheet(path, sheet)
    panel, seen = _seen(surface, coarse_mesh(surface, loops), sheet, standpoint, has_bar=False)
    paint_lines(panel.axes, seen)
    save(panel.figure, Path(path), dpi=sheet.dpi)


def _seen(
    surface: Surface, mesh: SurfaceMesh, sheet: Sheet, standpoint: Standpoint, *, has_bar: bool
) -> tuple[Panel, SurfaceRaster]:
    """Frame a surface, and find what is seen of it."""
    points, triangles, _ = mesh
    axes = camera(points, triangles, **standpoint)
    panel = lay_out(sheet, points @ axes[:2].T, has_bar=has_bar)
    return panel, look_at(surface, mesh, axes, axes[2], image_pixels(panel, sheet))


def _check_same(deviation: Deviation, points: Points) -> None:
    median, diagonal = deviation.percentile(50.0), float(np.hypot.reduce(np.ptp(points, axis=0)))
    if median > ELSEWHERE * diagonal:
        raise InputError(
            f"half of the {len(points)} points are {median:.3g} or more away from the surface, and the scan is only "
            f"{diagonal:.3g} across: give the scan that the surface was fitted to, in its unit"
        )


def _deviation(surface: Surface, mesh: SurfaceMesh, points: Points) -> Deviation:
    """Measure the signed distance of points from a surface, from the nearest of many points on it."""
    places, _, uv = mesh
    nearest = search(cKDTree(places), points, 1)[1][:, 0]
    return measure_deviation(points, surface, closest_parameters(surface, points, uv[nearest]))
