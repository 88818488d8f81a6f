"""Figures of a mesh, in space and in its parameter plane."""

from pathlib import Path
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ..._check import check_points, check_triangles, check_uv
from ...errors import InputError
from ...io.source import AnyPath
from ...mesh.connectivity import boundary_loops, half_edges
from ...mesh.quality import unit_normals
from ...typing import UV, Points, Triangles
from ..camera import Standpoint, camera
from ..color_scales import rgb
from ..paint import MOST_SHAPES, STONE, paint_image, paint_loop, paint_triangles, paint_wires, save, shaded
from ..raster import rasterize
from .sheet import COLUMN, Panel, Sheet, check_sheet, check_values, image_pixels, lay_out, show_values

LINES = 0.05, 0.05, 0.35  # width in edges of the figure; at least and at most in points (1/72 inch)
LINE_TINT = 0.55  # brightness of an edge over that of its triangle
RIM = 0.8  # points


def draw_mesh(
    path: AnyPath,
    points: Points,
    triangles: Triangles,
    *,
    values: ArrayLike | None = None,
    label: str = "value",
    edges: bool | None = None,
    sheet: Sheet = COLUMN,
    **standpoint: Unpack[Standpoint],
) -> None:
    """Draw a mesh, shaded; what turns its back to us has another colour.

    Parameters
    ----------
    path
        A `.png`, `.svg` or `.pdf` file; one that exists is replaced.
    points : (n, 3) array
    triangles : (m, 3) int array
    values : (n,) array, optional
        Shown as colours, with their scale.
    label : str
        What the values are.
    edges : bool, optional
        Whether edges are drawn; by default up to 20,000 triangles. Without them the surface is one image.
    sheet : Sheet, optional
        By default a column of 85 mm at 300 dpi.
    view, up
        As for `camera`.

    Raises
    ------
    FormatError
        The file cannot be written.
    InputError
        On points or triangles that are none, or other than one value a point.
    """
    check_sheet(path, sheet)
    cloud = check_points(points, least=3)
    faces = _check_faces(triangles, len(cloud))
    given = None if values is None else check_values(values, len(cloud), label)
    turned = cloud @ camera(cloud, faces, **standpoint).T
    used = turned[np.unique(faces), :2]
    if (used == used[0]).all():
        raise InputError(f"all {len(used)} points of the triangles are at one place; give a mesh that has an extent")
    panel = lay_out(sheet, used, has_bar=given is not None)
    scale = None if given is None else show_values(panel, given, label)
    if len(faces) <= MOST_SHAPES if edges is None else edges:
        colors = STONE if given is None else rgb(scale, given[faces].mean(axis=1))
        width = _line_width(panel, len(faces))
        paint_triangles(panel.axes, turned, faces, colors, line_width=width, line_tint=LINE_TINT)
    else:
        raster = rasterize(turned, faces, image_pixels(panel, sheet))
        colors = STONE if given is None else rgb(scale, raster.interpolated(given))
        lit = shaded(unit_normals(turned, faces)[raster.which[raster.is_seen]], colors)
        paint_image(panel.axes, raster.is_seen, lit, raster.box)
    save(panel.figure, Path(path), dpi=sheet.dpi)


def draw_plane(
    path: AnyPath,
    uv: UV,
    triangles: Triangles,
    *,
    values: ArrayLike | None = None,
    label: str = "value",
    edges: bool | None = None,
    sheet: Sheet = COLUMN,
) -> None:
    """Draw the parameter plane of a mesh: its edges, and its boundary and gaps in the accent colour.

    Parameters
    ----------
    path
        A `.png`, `.svg` or `.pdf` file; one that exists is replaced.
    uv : (n, 2) array
    triangles : (m, 3) int array
    values : (n,) array, optional
        Shown as colours, with their scale.
    label : str
        What the values are.
    edges : bool, optional
        Whether edges are drawn; by default without values, or up to 20,000 triangles.
    sheet : Sheet, optional
        By default a column of 85 mm at 300 dpi.

    Raises
    ------
    FormatError
        The file cannot be written.
    InputError
        On parameters or triangles that are none, or other than one value a point.
    """
    check_sheet(path, sheet)
    plane = check_uv(uv, len(uv))
    faces = _check_faces(triangles, len(plane))
    given = None if values is None else check_values(values, len(plane), label)
    used = plane[np.unique(faces)]
    if (used == used[0]).all():
        raise InputError(f"the parameters of all {len(used)} points are the same; parameterize the mesh again")
    panel = lay_out(sheet, used, has_bar=given is not None)
    if given is not None:
        scale = show_values(panel, given, label)
        raster = rasterize(np.c_[plane, np.zeros(len(plane))], faces, image_pixels(panel, sheet))
        paint_image(panel.axes, raster.is_seen, rgb(scale, raster.interpolated(given)), raster.box)
    if given is None or len(faces) <= MOST_SHAPES if edges is None else edges:
        paint_wires(panel.axes, plane, faces, line_width=_line_width(panel, len(faces)))
    for loop in boundary_loops(half_edges(faces, len(plane))):
        paint_loop(panel.axes, plane[loop], line_width=RIM)
    save(panel.figure, Path(path), dpi=sheet.dpi)


def _check_faces(triangles: Triangles, n_points: int) -> Triangles:
    faces = check_triangles(triangles, n_points)
    if len(faces) == 0:
        raise InputError(f"the mesh has {n_points} points and no triangles; give a mesh, or draw its points as a cloud")
    return faces


def _line_width(panel: Panel, n_triangles: int) -> float:
    """Return the width of edges, the thinner the more there are."""
    share, least, most = LINES
    edge = np.sqrt(2.0 * panel.size[0] * panel.size[1] / n_triangles)
    return float(np.clip(share * edge, least, most))
