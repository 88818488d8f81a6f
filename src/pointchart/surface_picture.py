"""Pictures of a fitted surface: its deviation from the scan, reflection lines, curvatures; one sample a pixel."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from .errors import InputError
from .fit import Surface, curvatures, evaluate, normals
from .fit.deviation import Deviation, deviation_table
from .fit.tessellate import tessellate
from .io import replacing
from .picture import ACCENT, FAINT, INK, PAPER, STONE
from .quality import area_vectors
from .typing import UV, Floats, Points, Triangles

GRID = 15_000  # points of the mesh that finds what is seen; each pixel then samples the surface itself
PIXELS = 1_600_000  # of the box around the surface, about twice as many each way as are printed
CHUNK = 4096  # triangles drawn at a time
MARGIN = 3.0  # pixels around the surface
TURN, TILT = np.deg2rad([-10.0, 25.0])
OBLIQUE = np.array(  # out of the view along the mean normal
    [
        [np.cos(TURN), 0.0, np.sin(TURN)],
        [np.sin(TILT) * np.sin(TURN), np.cos(TILT), -np.sin(TILT) * np.cos(TURN)],
        [-np.cos(TILT) * np.sin(TURN), np.sin(TILT), np.cos(TILT) * np.cos(TURN)],
    ]
)
LIGHT = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])
BELOW_AND_ABOVE = ["#12344f", "#2a6f97", "#8fbcd4", "#f4efe4", "#eba98f", ACCENT, "#7a2416"]
FLAT = 1e-6  # curvature of a surface of area 1 that is taken for rounding
STRIPES = np.array([0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 30.0])  # degrees, each a part of a full turn


@dataclass(frozen=True, slots=True, eq=False)
class _Scene:
    """The parameters under each pixel, (h, w, 2), nan beside the surface, and where that is.

    The rows of `upright` are the longest way of the surface, across it, and its mean normal; those of `axes`, turned a
    little out of them, point to the right, up and towards us. `box` is left, right, bottom, top, in the scan's unit.
    """

    uv: Floats
    upright: Floats
    box: tuple[float, float, float, float]
    area: float

    @property
    def seen(self) -> UV:
        """Parameters of the pixels on the surface, (k, 2)."""
        return np.asarray(self.uv[np.isfinite(self.uv[:, :, 0])])

    @property
    def axes(self) -> Floats:
        """Directions right, up and towards us."""
        return np.asarray(OBLIQUE @ self.upright)

    def thinned(self, step: int) -> Self:
        """Return the same picture with fewer pixels."""
        return replace(self, uv=self.uv[::step, ::step])

    def painted(self, colors: Floats) -> Floats:
        """Return the picture of the surface on paper, (h, w, 3), by colours of the pixels on it, (k, 3)."""
        from matplotlib.colors import to_rgb

        image = np.full((*self.uv.shape[:2], 3), to_rgb(PAPER))
        image[np.isfinite(self.uv[:, :, 0])] = np.clip(colors, 0.0, 1.0)
        return image


def draw_deviation(
    path: Path,
    surface: Surface,
    loops: Sequence[ArrayLike],
    points: Points,
    deviation: Deviation,
    tolerance: float,
    *,
    outliers: float = 0.0,
) -> None:
    """Draw the deviation of a surface from its scan, its histogram and its figures into a PNG.

    Each place of the surface has the colour of the scan point nearest to it, and that of stone where none is near. A
    ring is around the point that deviates most.

    Parameters
    ----------
    path : Path
    surface : Surface
    loops : sequence of (b, 2) arrays
        Its boundary in the parameter plane, as for `tessellate`.
    points : (n, 3) array
        The scan.
    deviation : Deviation
    tolerance : float
        Absolute deviation that is allowed, more than 0.
    outliers : float
        Share of the points that the second figure leaves out.

    Raises
    ------
    InputError
        If the tolerance is not more than 0, or there is not one deviation for each point.
    """
    if not 0.0 < tolerance < np.inf:
        raise InputError(f"the tolerance is {tolerance}; give a length more than 0, in the unit of the scan")
    if len(points) != len(deviation.signed):
        raise InputError(f"{len(points)} points have {len(deviation.signed)} deviations; measure them on these points")
    scene = _look_at(surface, loops)
    facing = normals(surface, scene.seen)
    scale = _diverging(max(1.25 * tolerance, min(deviation.percentile(99.9), 4.0 * tolerance)))
    figure, panels = _panels([["view", "bars"], ["view", "figures"]], width_ratios=[1.9, 1.0])
    colors = _nearest_colors(evaluate(surface, scene.seen), points, scale.to_rgba(deviation.signed)[:, :3], scene.area)
    _show(panels["view"], scene, _lit(facing @ scene.axes.T, ambient=0.62)[:, None] * colors)
    if deviation.largest() > 0.0:
        _ring(panels["view"], scene.axes @ points[np.argmax(np.abs(deviation.signed))])
    panels["view"].set_title(f"deviation of {len(points):,} points from the surface", color=INK, fontsize=13)
    bar = _color_bar(panels["view"], scale, "in the unit of the scan, positive on the side of the normal")
    bar.set_ticks([-tolerance, 0.0, tolerance], labels=_marks(tolerance))
    _histogram(panels["bars"], deviation, tolerance, scale)
    _write_figures(panels["figures"], _figures(surface, deviation, tolerance, outliers))
    _save(figure, path)


def draw_reflections(path: Path, surface: Surface, loops: Sequence[ArrayLike]) -> None:
    """Draw how a surface reflects parallel lines of light, and its Gaussian and mean curvature, into a PNG.

    Lines of light are smooth where the surface has continuous curvature, have corners where only its normal is
    continuous, and break where that is not.

    Parameters
    ----------
    path : Path
    surface : Surface
    loops : sequence of (b, 2) arrays
        Its boundary in the parameter plane, as for `tessellate`.
    """
    scene = _look_at(surface, loops)
    figure, panels = _panels([["lines", "gauss"], ["lines", "mean"]], width_ratios=[1.5, 1.0])
    facing = normals(surface, scene.seen)
    angles = reflection_angles(facing, scene.upright[2], _least_turning(facing, scene.upright[2]))
    period = _period(angles)
    gray = 0.5 + np.clip(1.6 * np.cos(2.0 * np.pi * angles / np.deg2rad(period)), -0.5, 0.5)
    _show(panels["lines"], scene, _lit(facing @ scene.axes.T, ambient=0.8)[:, None] * _between(gray))
    panels["lines"].set_title(f"reflection lines, {period:g}° apart", color=INK, fontsize=13)
    small = scene.thinned(2)
    gauss, mean = curvatures(surface, small.seen)
    shade = _lit(normals(surface, small.seen) @ small.axes.T, ambient=0.8)
    _map(panels["gauss"], small, shade, gauss, FLAT / scene.area, "Gaussian curvature, in 1 / unit²")
    _map(panels["mean"], small, shade, mean, FLAT / np.sqrt(scene.area), "mean curvature, in 1 / unit")
    _save(figure, path)


def reflection_angles(facing: Floats, eye: ArrayLike, lines: ArrayLike) -> Floats:
    r"""Return the angle, about the direction of lines of light, at which places of a surface reflect the view.

    The lines are parallel and far away, as is the eye; what it sees in a place of normal n comes from the direction

    .. math:: r = 2 (n \cdot e) n - e

    where e points towards the eye. The angle is 0 there and grows anticlockwise about the lines; places of one angle
    reflect the same line.

    Parameters
    ----------
    facing : (n, 3) array
        Unit normals.
    eye : (3,) array
        Direction towards the eye.
    lines : (3,) array
        Direction of the lines of light, another than that of the eye.

    Returns
    -------
    (n,) float64 array, from -pi to pi; nan where there is no normal.

    Examples
    --------
    >>> half_way = np.array([[0.0, -np.sqrt(0.5), np.sqrt(0.5)]])
    >>> np.rad2deg(reflection_angles(half_way, [0, 0, 1], [1, 0, 0])).round(9)
    array([90.])
    """
    towards, along = np.asarray(eye, np.float64), np.asarray(lines, np.float64)
    reflected = 2.0 * (facing @ towards)[:, None] * facing - towards
    across = np.cross(along, towards)
    return np.asarray(np.arctan2(reflected @ across, reflected @ np.cross(across, along)))


def _look_at(surface: Surface, loops: Sequence[ArrayLike]) -> _Scene:
    """Find what is seen of a surface at each pixel."""
    points, triangles, uv = tessellate(surface, loops, GRID)
    upright = _upright(points, triangles)
    turned = points @ (OBLIQUE @ upright).T
    low, high = turned[:, :2].min(axis=0), turned[:, :2].max(axis=0)
    pixel = float(np.sqrt((high - low).prod() / PIXELS))
    width, height = np.ceil((high - low) / pixel + 2.0 * MARGIN).astype(int).tolist()
    low = low - MARGIN * pixel
    back_to_front = np.argsort(turned[triangles, 2].mean(axis=1))
    seen = _rasterize((turned[:, :2] - low) / pixel, triangles[back_to_front], uv, (height, width))
    box = (low[0], low[0] + width * pixel, low[1], low[1] + height * pixel)
    return _Scene(seen, upright, box, float(np.linalg.norm(area_vectors(points, triangles), axis=1).sum()))


def _upright(points: Points, triangles: Triangles) -> Floats:
    """Return the longest way of a mesh, the way across it that is up, and its mean normal."""
    vectors = area_vectors(points, triangles)
    normal, centred = vectors.sum(axis=0), points - points.mean(axis=0)
    if np.linalg.norm(normal) < 0.1 * np.linalg.norm(vectors, axis=1).sum():
        normal = np.linalg.svd(centred, full_matrices=False)[2][2]
    normal = normal / np.linalg.norm(normal)
    longest = np.linalg.svd(centred - np.outer(centred @ normal, normal), full_matrices=False)[2][0]
    longest = longest if np.cross(normal, longest).sum() >= 0.0 else -longest
    return np.stack([longest, np.cross(normal, longest), normal])


def _rasterize(place: Floats, triangles: Triangles, uv: UV, shape: tuple[int, int]) -> Floats:
    """Interpolate parameters at the middle of each pixel, later triangles over earlier ones; nan beside them."""
    image = np.full((*shape, 2), np.nan)
    for part in np.array_split(triangles, len(triangles) // CHUNK + 1):
        low, high = np.rint(place[part].min(axis=1)).astype(int), np.rint(place[part].max(axis=1)).astype(int)
        width, height = (high - low).T
        which = np.repeat(np.arange(len(part)), width * height)
        step = np.arange(len(which)) - np.repeat(np.cumsum(width * height) - width * height, width * height)
        column, row = low[which, 0] + step % width[which], low[which, 1] + step // width[which]
        # The shares of the corners are the doubled areas opposite to them, seen from the middle of the pixel.
        x, y = (place[part[which]] - np.stack([column + 0.5, row + 0.5], axis=1)[:, None]).transpose(2, 0, 1)
        share = np.roll(x, -1, axis=1) * np.roll(y, 1, axis=1) - np.roll(x, 1, axis=1) * np.roll(y, -1, axis=1)
        total = share.sum(axis=1)
        inside = (share * np.sign(total)[:, None] >= 0.0).all(axis=1) & (total != 0.0)
        weights = share[inside] / total[inside, None]
        image[row[inside], column[inside]] = np.einsum("ij,ijk->ik", weights, uv[part[which[inside]]])
    return image


def _lit(turned: Floats, *, ambient: float) -> Floats:
    """Return the brightness of places by their normals, lit from the upper left; the back is darker."""
    shade = ambient + (1.0 - ambient) * np.clip(turned @ LIGHT, 0.0, 1.0) / LIGHT[2]
    return np.asarray(np.where(turned[:, 2] < 0.0, 0.6, 1.0) * np.nan_to_num(shade, nan=ambient))


def _nearest_colors(places: Points, points: Points, colors: Floats, area: float) -> Floats:
    """Give places the colour of the nearest point, and that of stone beyond three times the mean spacing."""
    distance, nearest = cKDTree(points).query(
        places, distance_upper_bound=3.0 * float(np.sqrt(area / len(points))), workers=-1
    )
    return np.asarray(np.vstack([colors, STONE])[np.where(np.isinf(distance), len(points), nearest)])


def _least_turning(facing: Floats, eye: Floats) -> Floats:
    """Return the direction across the view in which normals vary least: lines of light along it are met most often."""
    sideways = np.nan_to_num(facing - np.outer(facing @ eye, eye))
    return np.asarray(np.linalg.eigh(np.cov(sideways, rowvar=False) + np.outer(eye, eye) * 4.0)[1][:, 0])


def _period(angles: Floats) -> float:
    """Choose the distance of the lines, in degrees, so that one or two dozen are seen; that of a plane is the least."""
    low, high = np.rad2deg(np.nanpercentile(angles, [2.0, 98.0]))
    return float(STRIPES[np.argmin(np.abs(np.log(STRIPES) - np.log(max((high - low) / 18.0, 1e-3))))])


def _between(gray: Floats) -> Floats:
    """Mix ink, 0, and paper, 1."""
    from matplotlib.colors import to_rgb

    share = np.nan_to_num(gray, nan=0.5)[:, None]
    return np.asarray((1.0 - share) * np.array(to_rgb(INK)) + share * np.array(to_rgb(PAPER)))


def _diverging(reach: float) -> Any:
    """Return a map from numbers to colours, symmetric about 0."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LinearSegmentedColormap, Normalize

    colors = LinearSegmentedColormap.from_list("below and above", BELOW_AND_ABOVE)
    return ScalarMappable(Normalize(-reach, reach), colors)


def _panels(layout: Any, *, width_ratios: list[float]) -> tuple[Any, dict[str, Any]]:
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    figure = Figure(figsize=(15.0, 7.4), facecolor=PAPER, layout=ConstrainedLayoutEngine(w_pad=0.15, h_pad=0.15))
    return figure, figure.subplot_mosaic(layout, width_ratios=width_ratios)


def _map(axes: Any, scene: _Scene, shade: Floats, values: Floats, least: float, title: str) -> None:
    """Draw numbers as colours, which reach over all but the largest two per cent, and to `least` at least."""
    scale = _diverging(max(least, float(np.nanpercentile(np.abs(values), 98.0))))
    _show(axes, scene, shade[:, None] * scale.to_rgba(values)[:, :3])
    axes.set_title(title, color=INK, fontsize=13)
    _color_bar(axes, scale)


def _show(axes: Any, scene: _Scene, colors: Floats) -> None:
    image = scene.painted(colors)
    axes.imshow(image, extent=scene.box, origin="lower", interpolation="hanning", interpolation_stage="rgba")
    axes.set_axis_off()


def _ring(axes: Any, place: Floats) -> None:
    from matplotlib.patheffects import Normal, Stroke

    glow = [Stroke(linewidth=4.0, foreground=PAPER), Normal()]
    axes.plot(*place[:2], "o", ms=15, mfc="none", mec=INK, mew=1.6, clip_on=False, path_effects=glow)
    axes.annotate("max", place[:2], (13, 9), textcoords="offset points", color=INK, fontsize=11, path_effects=glow)


def _color_bar(axes: Any, scale: Any, label: str = "") -> Any:
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    bar = axes.figure.colorbar(scale, ax=axes, location="bottom", shrink=0.7, aspect=45, pad=0.02, extend="both")
    bar.locator, bar.formatter = MaxNLocator(4, prune="both"), FuncFormatter(lambda x, _: _number(x))
    bar.set_label(label, color=INK, fontsize=11)
    bar.ax.tick_params(colors=INK, labelsize=11)
    bar.outline.set_visible(False)
    return bar


def _histogram(axes: Any, deviation: Deviation, tolerance: float, scale: Any) -> None:
    """Draw how many points have which deviation, those beyond the colours in the outermost bars."""
    low, high = scale.get_clim()
    counts, edges = np.histogram(np.clip(deviation.signed, low, high), bins=61, range=(low, high))
    middles = (edges[1:] + edges[:-1]) / 2
    axes.bar(middles, counts, width=np.diff(edges), color=scale.to_rgba(middles), edgecolor=INK, linewidth=0.3)
    for mark in (-tolerance, tolerance):
        axes.axvline(mark, color=INK, linewidth=1.2, linestyle=(0, (4, 3)))
    axes.set_title("points by deviation", color=INK, fontsize=13)
    axes.set(facecolor=PAPER, xlim=(low, high), yticks=[])
    axes.set_xticks([-tolerance, 0.0, tolerance], labels=_marks(tolerance))
    axes.tick_params(colors=INK, labelsize=11)
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
    axes.spines["bottom"].set_color(INK)


def _figures(surface: Surface, deviation: Deviation, tolerance: float, outliers: float) -> list[tuple[str, str]]:
    """Return the rows of the table: the figures of the deviation, and how few numbers hold the scan."""
    *lengths, (within, share) = deviation_table(deviation, outliers, tolerance=tolerance)
    rows = [(name, _number(figure)) for name, figure in lengths if outliers or not name.startswith("max but")]
    rows.append((within, f"{100.0 * share:.2f} %"))
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
    return [_number(-tolerance), "0", f"+{_number(tolerance)}"]


def _number(x: float) -> str:
    return f"{x:.3g}".replace("-", "\N{MINUS SIGN}")


def _save(figure: Any, path: Path) -> None:
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=110, format="png")
