"""Figures of a fitted surface: its deviation from a scan, and the lines of light that it reflects."""

from collections.abc import Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from ..._check import check_points
from ...errors import InputError
from ...io.source import AnyPath
from ...surface import Surface, closest_parameters, measure_deviation, tessellate
from ...typing import UV, Floats, Points, Triangles
from ..camera import camera
from ..raster import GRID, Scene, look_at_mesh
from ..run_pictures import save
from ..surface_pictures import diverging, paint_deviation, paint_lines
from .sheet import COLUMN, Panel, Sheet, check_sheet, image_pixels, lay_out, round_up, show_scale

Mesh: TypeAlias = tuple[Points, Triangles, UV]

ELSEWHERE = 0.1  # of the scan's diagonal: of which half the points are farther away, that surface is not its own
MOST = 99.0  # per cent of the points whose deviation the scale holds


def draw_deviation_map(
    path: AnyPath,
    surface: Surface,
    loops: Sequence[ArrayLike],
    points: Points,
    *,
    limit: float | None = None,
    unit: str = "mm",
    view: tuple[float, float] | None = None,
    up: str | None = None,
    sheet: Sheet = COLUMN,
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
    view, up
        As for `camera`.
    sheet : Sheet, optional
        By default a column of 85 mm at 300 dpi.

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
    mesh = tessellate(surface, loops, GRID)
    signed = _deviation(surface, mesh, cloud)
    _check_same(signed, cloud)
    within = float(np.percentile(np.abs(signed), MOST))
    rounding = 1e-12 * float(np.ptp(cloud, axis=0).max())
    reach = round_up(max(within, rounding)) if limit is None else limit
    panel, scene = _seen(mesh, view, up, sheet, has_bar=True)
    scale = diverging(reach)
    paint_deviation(panel.axes, surface, scene, cloud, scale.to_rgba(signed)[:, :3])
    show_scale(panel, scale, f"deviation in {unit}", [-reach, 0.0, reach])
    save(panel.figure, Path(path), dpi=sheet.dpi)


def draw_zebra(
    path: AnyPath,
    surface: Surface,
    loops: Sequence[ArrayLike],
    *,
    view: tuple[float, float] | None = None,
    up: str | None = None,
    sheet: Sheet = COLUMN,
) -> None:
    """Draw how a surface reflects parallel lines of light: smooth where its curvature is continuous.

    Parameters
    ----------
    path
        A `.png`, `.svg` or `.pdf` file; one that exists is replaced.
    surface : Surface
    loops : sequence of (b, 2) arrays
        Its boundary in the parameter plane, as for `tessellate`.
    view, up
        As for `camera`.
    sheet : Sheet, optional
        By default a column of 85 mm at 300 dpi.

    Raises
    ------
    FormatError
        The file cannot be written.
    """
    check_sheet(path, sheet)
    panel, scene = _seen(tessellate(surface, loops, GRID), view, up, sheet, has_bar=False)
    paint_lines(panel.axes, surface, scene)
    save(panel.figure, Path(path), dpi=sheet.dpi)


def _seen(
    mesh: Mesh, view: tuple[float, float] | None, up: str | None, sheet: Sheet, *, has_bar: bool
) -> tuple[Panel, Scene]:
    """Frame a surface, and find what is seen of it."""
    points, triangles, _ = mesh
    axes = camera(points, triangles, view=view, up=up)
    panel = lay_out(sheet, points @ axes[:2].T, has_bar=has_bar)
    return panel, look_at_mesh(mesh, axes, axes, image_pixels(panel, sheet))


def _check_same(signed: Floats, points: Points) -> None:
    median, diagonal = float(np.median(np.abs(signed))), float(np.hypot.reduce(np.ptp(points, axis=0)))
    if median > ELSEWHERE * diagonal:
        raise InputError(
            f"half of the {len(points)} points are {median:.3g} or more away from the surface, and the scan is only "
            f"{diagonal:.3g} across: give the scan that the surface was fitted to, in its unit"
        )


def _deviation(surface: Surface, mesh: Mesh, points: Points) -> Floats:
    """Measure the signed distance of points from a surface, from the nearest of many points on it."""
    places, _, uv = mesh
    nearest = cKDTree(places).query(points, workers=-1)[1]
    return measure_deviation(points, surface, closest_parameters(surface, points, uv[nearest])).signed
