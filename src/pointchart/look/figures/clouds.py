"""A figure of a point cloud."""

from pathlib import Path
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ..._check import check_points
from ...io.source import AnyPath
from ...typing import Floats, Points
from ..camera import Standpoint, camera
from ..color_scales import rgb
from ..paint import INK, MOST_SHAPES, mixed, save
from .sheet import COLUMN, Sheet, check_sheet, check_values, lay_out, show_values

FARTHEST = (0.73, 0.77, 0.78)  # between ink and white, so that far points are seen on it still
FADING = 1.5  # power of the nearness that is the share of ink: more than 1, so that the near side stands out
SHALLOW = 0.1  # depth over width of a cloud whose tones differ by all they can
DOTS = 0.75, 0.25, 3.0  # diameter in spacings of the figure; at least and at most in points (1/72 inch)


def draw_cloud(
    path: AnyPath,
    points: Points,
    *,
    values: ArrayLike | None = None,
    label: str = "value",
    sheet: Sheet = COLUMN,
    **standpoint: Unpack[Standpoint],
) -> None:
    """Draw a point cloud: one dot a point, near ones dark, or by a value of each point.

    Parameters
    ----------
    path
        A `.png`, `.svg` or `.pdf` file; one that exists is replaced.
    points : (n, 3) array
    values : (n,) array, optional
        Shown as colours, with their scale.
    label : str
        What the values are.
    sheet : Sheet, optional
        By default a column of 85 mm at 300 dpi.
    view, up
        As for `camera`.

    Raises
    ------
    FormatError
        The file cannot be written.
    InputError
        On fewer than four points, not-a-number, or other than one value a point.
    """
    check_sheet(path, sheet)
    cloud = check_points(points)
    given = None if values is None else check_values(values, len(cloud), label)
    turned = cloud @ camera(cloud, **standpoint).T
    order = np.argsort(turned[:, 2], kind="stable")
    panel = lay_out(sheet, turned[:, :2], has_bar=given is not None)
    if given is None:
        colors = _by_depth(turned[order, 2], SHALLOW * float(np.ptp(turned[:, :2], axis=0).max()))
    else:
        colors = rgb(show_values(panel, given, label), given[order])
    share, least, most = DOTS
    dot = float(np.clip(share * np.sqrt(panel.size[0] * panel.size[1] / len(cloud)), least, most))
    drawn = panel.axes.scatter(*turned[order, :2].T, c=colors, s=dot**2, linewidths=0, clip_on=False)
    drawn.set_rasterized(len(cloud) > MOST_SHAPES)
    save(panel.figure, Path(path), dpi=sheet.dpi)


def _by_depth(depth: Floats, least: float) -> Floats:
    """Mix ink for near points and a faint tone for far ones, (n, 3); depths of less than `least` differ less."""
    share = (1.0 - (depth.max() - depth) / max(float(np.ptp(depth)), least)) ** FADING
    return mixed(share, INK, FARTHEST)
