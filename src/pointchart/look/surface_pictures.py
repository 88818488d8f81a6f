"""Pictures of a fitted surface: its deviation from the scan, reflection lines, curvatures; one sample a pixel."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from ..errors import InputError
from ..io import check_output
from ..surface import Surface, curvatures, evaluate, normals
from ..surface.deviation import Deviation, deviation_table
from ..typing import Floats, Points
from .raster import Scene, least_turning, look_at, reflection_angles
from .run_pictures import ACCENT, FAINT, INK, PAPER, PICTURE_SUFFIXES, STONE, lit, number, paint_image, save, style_bar

# Blue under the surface and red over it, in tones that grow as dark on both sides: seen in gray, large stays large.
BELOW_AND_ABOVE = ["#12344f", "#2a6f97", "#8fbcd4", "#f4efe4", "#eba98f", ACCENT, "#7a2416"]
FLAT = 1e-6  # curvature of a surface of area 1 that is taken for rounding
STRIPES = np.array([0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 30.0])  # degrees, each a part of a full turn


def draw_deviation(
    path: Path,
    surface: Surface,
    loops: Sequence[ArrayLike],
    points: Points,
    deviation: Deviation,
    tolerance: float,
    *,
    unit: str,
    outliers: float = 0.0,
) -> None:
    """Draw the deviation of a surface from its scan, its histogram and its figures.

    Each place of the surface has the colour of the scan point nearest to it, and that of stone where none is near. A
    ring is around the point that deviates most.

    Parameters
    ----------
    path : Path
        A file of one of `PICTURE_SUFFIXES`.
    surface : Surface
    loops : sequence of (b, 2) arrays
        Its boundary in the parameter plane, as for `tessellate`.
    points : (n, 3) array
        The scan.
    deviation : Deviation
    tolerance : float
        Absolute deviation that is allowed, more than 0.
    unit : str
        Of the scan and so of all lengths, such as "mm".
    outliers : float
        Share of the points that the second figure leaves out.

    Raises
    ------
    InputError
        If the tolerance is not more than 0, or there is not one deviation for each point.
    """
    check_output(path, suffixes=PICTURE_SUFFIXES)
    if not 0.0 < tolerance < np.inf:
        raise InputError(f"the tolerance is {tolerance}; give a length more than 0, in {unit}")
    if len(points) != len(deviation.signed):
        raise InputError(f"{len(points)} points have {len(deviation.signed)} deviations; measure them on these points")
    scene = look_at(surface, loops)
    scale = diverging(max(1.25 * tolerance, min(deviation.percentile(99.9), 4.0 * tolerance)))
    figure, panels = _panels([["view", "bars"], ["view", "figures"]], width_ratios=[1.9, 1.0])
    paint_deviation(panels["view"], surface, scene, points, scale.to_rgba(deviation.signed)[:, :3])
    if deviation.largest() > 0.0:
        _ring(panels["view"], scene.axes @ points[np.argmax(np.abs(deviation.signed))])
    panels["view"].set_title(f"deviation of {len(points):,} points from the surface", color=INK, fontsize=13)
    bar = _color_bar(panels["view"], scale, f"deviation in {unit}, positive on the side of the normal")
    bar.set_ticks([-tolerance, 0.0, tolerance], labels=_marks(tolerance))
    _histogram(panels["bars"], deviation, tolerance, scale, unit)
    _write_figures(panels["figures"], _figures(surface, deviation, tolerance, outliers, unit))
    save(figure, path)


def draw_reflections(path: Path, surface: Surface, loops: Sequence[ArrayLike], *, unit: str) -> None:
    """Draw how a surface reflects parallel lines of light, and its Gaussian and mean curvature.

    Lines of light are smooth where the surface has continuous curvature, have corners where only its normal is
    continuous, and break where that is not.

    Parameters
    ----------
    path : Path
        A file of one of `PICTURE_SUFFIXES`.
    surface : Surface
    loops : sequence of (b, 2) arrays
        Its boundary in the parameter plane, as for `tessellate`.
    unit : str
        Of the surface, such as "mm".
    """
    check_output(path, suffixes=PICTURE_SUFFIXES)
    scene = look_at(surface, loops)
    figure, panels = _panels([["lines", "gauss"], ["lines", "mean"]], width_ratios=[1.5, 1.0])
    period = paint_lines(panels["lines"], surface, scene)
    panels["lines"].set_title(f"reflection lines, {period:g}° apart", color=INK, fontsize=13)
    small = scene.thinned(2)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # in singular places, which are left stone
        gauss, mean = curvatures(surface, small.seen)
    shade = lit(normals(surface, small.seen) @ small.axes.T, ambient=0.8)
    _map(panels["gauss"], small, shade, gauss, FLAT / scene.area, f"Gaussian curvature in 1 / {unit}²")
    _map(panels["mean"], small, shade, mean, FLAT / np.sqrt(scene.area), f"mean curvature in 1 / {unit}")
    save(figure, path)


def paint_deviation(axes: Any, surface: Surface, scene: Scene, points: Points, colors: Floats) -> None:
    """Show a surface in the colours of the scan points nearest to each place, (n, 3), lit a little."""
    nearest = _nearest_colors(evaluate(surface, scene.seen), points, colors, scene.area)
    shade = lit(normals(surface, scene.seen) @ scene.axes.T, ambient=0.62)
    paint_image(axes, scene.painted(shade[:, None] * nearest), scene.box)


def paint_lines(axes: Any, surface: Surface, scene: Scene) -> float:
    """Show the lines of light that a surface reflects; return how far they are apart, in degrees."""
    facing = normals(surface, scene.seen)
    angles = reflection_angles(facing, scene.upright[2], least_turning(facing, scene.upright[2]))
    period = _period(angles)
    gray = 0.5 + np.clip(1.6 * np.cos(2.0 * np.pi * angles / np.deg2rad(period)), -0.5, 0.5)
    shade = lit(facing @ scene.axes.T, ambient=0.8)
    paint_image(axes, scene.painted(shade[:, None] * _between(gray)), scene.box)
    return period


def _nearest_colors(places: Points, points: Points, colors: Floats, area: float) -> Floats:
    """Give places the colour of the nearest point, and that of stone beyond three times the mean spacing."""
    distance, nearest = cKDTree(points).query(
        places, distance_upper_bound=3.0 * float(np.sqrt(area / len(points))), workers=-1
    )
    return np.asarray(np.vstack([colors, STONE])[np.where(np.isinf(distance), len(points), nearest)])


def _period(angles: Floats) -> float:
    """Choose the distance of the lines, in degrees, so that one or two dozen are seen; that of a plane is the least."""
    known = angles[np.isfinite(angles)]
    low, high = np.rad2deg(np.percentile(known, [2.0, 98.0])) if len(known) else (0.0, 0.0)
    return float(STRIPES[np.argmin(np.abs(np.log(STRIPES) - np.log(max((high - low) / 18.0, 1e-3))))])


def _between(gray: Floats) -> Floats:
    """Mix ink, 0, and paper, 1."""
    from matplotlib.colors import to_rgb

    share = np.nan_to_num(gray, nan=0.5)[:, None]
    return np.asarray((1.0 - share) * np.array(to_rgb(INK)) + share * np.array(to_rgb(PAPER)))


def diverging(reach: float) -> Any:
    """Return a map from numbers to colours, symmetric about 0."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LinearSegmentedColormap, Normalize

    colors = LinearSegmentedColormap.from_list("below and above", BELOW_AND_ABOVE)
    return ScalarMappable(Normalize(-reach, reach), colors.with_extremes(bad=tuple(STONE.tolist())))


def _panels(layout: Any, *, width_ratios: list[float]) -> tuple[Any, dict[str, Any]]:
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    figure = Figure(figsize=(15.0, 7.4), facecolor=PAPER, layout=ConstrainedLayoutEngine(w_pad=0.15, h_pad=0.15))
    return figure, figure.subplot_mosaic(layout, width_ratios=width_ratios)


def _map(axes: Any, scene: Scene, shade: Floats, values: Floats, least: float, title: str) -> None:
    """Draw numbers as colours, which reach over all but the largest two per cent, and to `least` at least."""
    sizes = np.abs(values[np.isfinite(values)])
    scale = diverging(max(least, float(np.percentile(sizes, 98.0)) if len(sizes) else 0.0))
    paint_image(axes, scene.painted(shade[:, None] * scale.to_rgba(values)[:, :3]), scene.box)
    axes.set_title(title, color=INK, fontsize=13)
    _color_bar(axes, scale)


def _ring(axes: Any, place: Floats) -> None:
    from matplotlib.patheffects import Normal, Stroke

    glow = [Stroke(linewidth=4.0, foreground=PAPER), Normal()]
    axes.plot(*place[:2], "o", ms=15, mfc="none", mec=INK, mew=1.6, clip_on=False, path_effects=glow)
    axes.annotate("max", place[:2], (13, 9), textcoords="offset points", color=INK, fontsize=11, path_effects=glow)


def _color_bar(axes: Any, scale: Any, label: str = "") -> Any:
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    bar = axes.figure.colorbar(scale, ax=axes, location="bottom", shrink=0.7, aspect=45, pad=0.02, extend="both")
    bar.locator, bar.formatter = MaxNLocator(4, prune="both"), FuncFormatter(lambda x, _: number(x))
    style_bar(bar, label, size=11)
    return bar


def _histogram(axes: Any, deviation: Deviation, tolerance: float, scale: Any, unit: str) -> None:
    """Draw how many points have which deviation, those beyond the colours in the outermost bars."""
    low, high = scale.get_clim()
    counts, edges = np.histogram(np.clip(deviation.signed, low, high), bins=61, range=(low, high))
    middles = (edges[1:] + edges[:-1]) / 2
    axes.bar(middles, counts, width=np.diff(edges), color=scale.to_rgba(middles), edgecolor=INK, linewidth=0.3)
    for mark in (-tolerance, tolerance):
        axes.axvline(mark, color=INK, linewidth=1.2, linestyle=(0, (4, 3)))
    axes.set_title(f"points by deviation in {unit}", color=INK, fontsize=13)
    axes.set(facecolor=PAPER, xlim=(low, high), yticks=[])
    axes.set_xticks([-tolerance, 0.0, tolerance], labels=_marks(tolerance))
    axes.tick_params(colors=INK, labelsize=11)
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
    axes.spines["bottom"].set_color(INK)


def _figures(
    surface: Surface, deviation: Deviation, tolerance: float, outliers: float, unit: str
) -> list[tuple[str, str]]:
    """Return the rows of the table: the figures of the deviation, and how few numbers hold the scan."""
    *lengths, (_, share) = deviation_table(deviation, outliers, tolerance=tolerance)
    rows = [
        (name, f"{number(figure)} {unit}") for name, figure in lengths if outliers or not name.startswith("max but")
    ]
    rows.append((f"within {number(tolerance)} {unit}", f"{100.0 * share:.2f} %"))
    n_control = getattr(surface, "n_control", None)  # not every surface has control points
    if n_control:
        rows.append(("control points", f"{n_control:,}"))
        rows.append(("points per control point", f"{len(deviation.signed) / n_control:.1f}"))
    return rows


def _write_figures(axes: Any, rows: list[tuple[str, str]]) -> None:
    axes.set(xlim=(0.0, 1.0), ylim=(len(rows) + 0.2, -0.2))
    axes.set_axis_off()
    for k, (name, figure) in enumerate(rows):
        axes.text(0.02, k + 0.5, name, color=INK, fontsize=13, va="center")
        axes.text(0.98, k + 0.5, figure, color=INK, fontsize=13, va="center", ha="right", fontweight="bold")
        axes.axhline(k + 1.0, color=FAINT, linewidth=0.8)


def _marks(tolerance: float) -> list[str]:
    return [number(-tolerance), "0", f"+{number(tolerance)}"]
