"""A figure of a point cloud."""

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..._check import check_points
from ...errors import InputError
from ...io.source import AnyPath
from ...typing import Floats, Points
from ..camera import camera
from ..run_pictures import INK, MOST_SHAPES, save
from .sheet import COLUMN, Sheet, check_sheet, lay_out, sequential, show_scale

FARTHEST = np.array([0.73, 0.77, 0.78])  # color of the points farthest from us: still to be seen on white
SHALLOW = 0.1  # depth over width of a cloud whose tones differ by all they can
DOTS = 0.75, 0.25, 3.0  # diameter in spacings of the figure; at least and at most in points (1/72 inch)


def draw_cloud(
    path: AnyPath,
    points: Points,
    *,
    values: ArrayLike | None = None,
    label: str = "value",
    view: tuple[float, float] | None = None,
    up: str | None = None,
    sheet: Sheet = COLUMN,
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
    view, up
        As for `camera`.
    sheet : Sheet, optional
        By default a column of 85 mm at 300 dpi.

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
    turned = cloud @ camera(cloud, view=view, up=up).T
    order = np.argsort(turned[:, 2], kind="stable")
    panel = lay_out(sheet, turned[:, :2], has_bar=given is not None)
    if given is None:
        colors = _by_depth(turned[order, 2], SHALLOW * float(np.ptp(turned[:, :2], axis=0).max()))
    else:
        scale = sequential(given, label)
        colors = scale.to_rgba(given[order])
        show_scale(panel, scale, label)
    share, least, most = DOTS
    dot = float(np.clip(share * np.sqrt(panel.size[0] * panel.size[1] / len(cloud)), least, most))
    drawn = panel.axes.scatter(*turned[order, :2].T, c=colors, s=dot**2, linewidths=0, clip_on=False)
    drawn.set_rasterized(len(cloud) > MOST_SHAPES)
    save(panel.figure, Path(path), dpi=sheet.dpi)


def check_values(values: ArrayLike, n_points: int, label: str) -> Floats:
    """Return the values of points as (n,) float64; not-a-number is allowed.

    Raises
    ------
    InputError
        If they are no numbers, or there is not one for each point.
    """
    try:
        array = np.asarray(values, np.float64)
    except (TypeError, ValueError) as reason:
        raise InputError(f"'{label}' is no array of numbers ({reason}); choose another colour") from None
    if array.shape != (n_points,):
        raise InputError(f"'{label}' has shape {array.shape}, but there are {n_points} points; give one value for each")
    return array


def _by_depth(depth: Floats, least: float) -> Floats:
    """Mix ink for near points and a faint tone for far ones, (n, 3); depths of less than `least` differ less."""
    from matplotlib.colors import to_rgb

    share = (1.0 - (depth.max() - depth) / max(float(np.ptp(depth)), least))[:, None] ** 1.5
    return np.asarray(share * np.array(to_rgb(INK)) + (1.0 - share) * FARTHEST)
