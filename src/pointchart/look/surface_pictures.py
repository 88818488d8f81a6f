"""Pictures of a fitted surface: its deviation from the scan, its reflection lines, its curvatures."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError
from ..io import check_output
from ..mesh.quality import area_vectors
from ..surface import Surface, curvatures
from ..surface.deviation import Deviation, deviation_table
from ..typing import Floats, Points, Triangles
from .camera import oblique
from .color_scales import counted, diverging, number, rgb, style_bar
from .paint import FAINT, INK, PAPER, PICTURE_SUFFIXES, save
from .surface_raster import SurfaceRaster, coarse_mesh, look_at
from .surface_shading import paint_deviation, paint_lines, paint_numbers

PIXELS = 1_600_000  # of the box around the surface, about twice as many each way as are printed
THINNED = 2  # pixels each way of which the smaller pictures of curvature take one
# Where the colours of deviations end, in tolerances: beyond it in any case, at what 99.9 % of the points are within,
# and so near at most that what exceeds the tolerance still stands out.
BEYOND, NEARLY_ALL, FARTHEST = 1.25, 99.9, 4.0
MOST_CURVED = 98.0  # per cent of the pixels that the colours of curvatures hold; they have no bound at sharp places
FLAT = 1e-6  # curvature of a surface of area 1 that is taken for rounding
NO_SIDE = 0.1  # of the area: what it faces altogether, below which a surface has no side but that of its mean plane
BARS = 61  # of the histogram: an odd number, so that one is about 0
TITLE, TEXT = 13, 11  # points


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
    seen = _seen(surface, loops)
    scale = diverging(max(BEYOND * tolerance, min(deviation.percentile(NEARLY_ALL), FARTHEST * tolerance)))
    figure, panels = _panels([["view", "bars"], ["view", "figures"]], width_ratios=[1.9, 1.0])
    paint_deviation(panels["view"], seen, points, rgb(scale, deviation.signed))
    if deviation.largest() > 0.0:
        _ring(panels["view"], seen.axes @ points[np.argmax(np.abs(deviation.signed))])
    panels["view"].set_title(f"deviation of {len(points):,} points from the surface", color=INK, fontsize=TITLE)
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
    seen = _seen(surface, loops)
    figure, panels = _panels([["lines", "gauss"], ["lines", "mean"]], width_ratios=[1.5, 1.0])
    spacing = paint_lines(panels["lines"], seen)
    panels["lines"].set_title(f"reflection lines, {spacing:g}° apart", color=INK, fontsize=TITLE)
    small = seen.thinned(THINNED)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # in singular places, which are left stone
        gauss, mean = curvatures(surface, small.seen)
    _map(panels["gauss"], small, gauss, FLAT / seen.area, f"Gaussian curvature in 1 / {unit}²")
    _map(panels["mean"], small, mean, FLAT / np.sqrt(seen.area), f"mean curvature in 1 / {unit}")
    save(figure, path)


def _seen(surface: Surface, loops: Sequence[ArrayLike]) -> SurfaceRaster:
    """Look at a surface a little from above on its mean plane."""
    mesh = coarse_mesh(surface, loops)
    upright = _upright(*mesh[:2])
    return look_at(surface, mesh, oblique() @ upright, upright[2], PIXELS)


def _upright(points: Points, triangles: Triangles) -> Floats:
    """Return the longest way of a mesh, the way across it that is up, and its mean normal."""
    vectors = area_vectors(points, triangles)
    normal, centred = vectors.sum(axis=0), points - points.mean(axis=0)
    if np.linalg.norm(normal) < NO_SIDE * np.linalg.norm(vectors, axis=1).sum():
        normal = np.linalg.svd(centred, full_matrices=False)[2][2]
    normal = normal / np.linalg.norm(normal)
    longest = np.linalg.svd(centred - np.outer(centred @ normal, normal), full_matrices=False)[2][0]
    longest = longest if np.cross(normal, longest).sum() >= 0.0 else -longest
    return np.stack([longest, np.cross(normal, longest), normal])


def _panels(layout: Any, *, width_ratios: list[float]) -> tuple[Any, dict[str, Any]]:
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    figure = Figure(figsize=(15.0, 7.4), facecolor=PAPER, layout=ConstrainedLayoutEngine(w_pad=0.15, h_pad=0.15))
    return figure, figure.subplot_mosaic(layout, width_ratios=width_ratios)


def _map(axes: Any, seen: SurfaceRaster, values: Floats, least: float, title: str) -> None:
    """Draw numbers as colours, which reach over all but the largest two per cent, and to `least` at least."""
    sizes = np.abs(values[np.isfinite(values)])
    scale = diverging(max(least, float(np.percentile(sizes, MOST_CURVED)) if len(sizes) else 0.0))
    paint_numbers(axes, seen, values, scale)
    axes.set_title(title, color=INK, fontsize=TITLE)
    _color_bar(axes, scale)


def _ring(axes: Any, place: Floats) -> None:
    from matplotlib.patheffects import Normal, Stroke

    glow = [Stroke(linewidth=4.0, foreground=PAPER), Normal()]
    axes.plot(*place[:2], "o", ms=15, mfc="none", mec=INK, mew=1.6, clip_on=False, path_effects=glow)
    axes.annotate("max", place[:2], (13, 9), textcoords="offset points", color=INK, fontsize=TEXT, path_effects=glow)


def _color_bar(axes: Any, scale: Any, label: str = "") -> Any:
    from matplotlib.ticker import MaxNLocator

    bar = axes.figure.colorbar(scale, ax=axes, location="bottom", shrink=0.7, aspect=45, pad=0.02, extend="both")
    bar.locator = MaxNLocator(4, prune="both")
    style_bar(bar, label, size=TEXT)
    return bar


def _histogram(axes: Any, deviation: Deviation, tolerance: float, scale: Any, unit: str) -> None:
    """Draw how many points have which deviation, those beyond the colours in the outermost bars."""
    low, high = scale.get_clim()
    counts, edges = counted(deviation.signed, low, high, BARS)
    middles = (edges[1:] + edges[:-1]) / 2
    axes.bar(middles, counts, width=np.diff(edges), color=scale.to_rgba(middles), edgecolor=INK, linewidth=0.3)
    for mark in (-tolerance, tolerance):
        axes.axvline(mark, color=INK, linewidth=1.2, linestyle=(0, (4, 3)))
    axes.set_title(f"points by deviation in {unit}", color=INK, fontsize=TITLE)
    axes.set(facecolor=PAPER, xlim=(low, high), yticks=[])
    axes.set_xticks([-tolerance, 0.0, tolerance], labels=_marks(tolerance))
    axes.tick_params(colors=INK, labelsize=TEXT)
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
        axes.text(0.02, k + 0.5, name, color=INK, fontsize=TITLE, va="center")
        axes.text(0.98, k + 0.5, figure, color=INK, fontsize=TITLE, va="center", ha="right", fontweight="bold")
        axes.axhline(k + 1.0, color=FAINT, linewidth=0.8)


def _marks(tolerance: float) -> list[str]:
    return [number(-tolerance), "0", f"+{number(tolerance)}"]
