"""Pictures of a run: the cloud with its boundary, the parameter plane with its triangulation, the mesh."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..io import check_output, replacing
from ..mesh.quality import area_vectors
from ..typing import UV, Floats, Loop, Points, Triangles

PAPER, FAINT, INK, ACCENT = "#fbfaf7", "#ccd6d8", "#22303c", "#c8553d"  # ground, thin lines, text, what stands out
STONE, INSIDE = np.array([0.83, 0.77, 0.68]), np.array([0.78, 0.49, 0.40])  # a surface, and what shows its back
SEQUENTIAL = [FAINT, "#3a8fb7", INK]  # from none to much
BRIGHTEST = 0.85  # cosine of the angle to the light within which places have their full colour
LIGHT = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])  # from the upper left, as maps are lit
MOST_SHAPES = 20_000  # points or triangles of a drawing; more become an image in it, so that files stay small
# What makes a file the same on each run: by itself, matplotlib writes when it was made.
UNDATED: dict[str, dict[str, None]] = {".png": {}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
PICTURE_SUFFIXES = tuple(UNDATED)


def draw_run(
    path: Path, points: Points, triangles: Triangles, uv: UV, loop: Loop, *, view: tuple[float, float] = (0.0, 0.0)
) -> None:
    """Draw the cloud, its parameters and its mesh side by side.

    Parameters
    ----------
    path : Path
        A file of one of `PICTURE_SUFFIXES`.
    points : (n, 3) array
    triangles : (m, 3) int array
    uv : (n, 2) array
    loop : (b,) int array
    view : (float, float)
        Turn about the vertical and the horizontal axis of the picture, in degrees; (0, 0) looks down the z axis.
    """
    from matplotlib.figure import Figure

    check_output(path, suffixes=PICTURE_SUFFIXES)
    turned = points @ rotation(*view).T
    figure = Figure(figsize=(15.0, 5.4), facecolor=PAPER, layout="constrained")
    left, middle, right = figure.subplots(1, 3)
    _scatter(left, turned)
    left.set_title(f"{len(points):,} points", color=INK)
    paint_wires(middle, uv, triangles, line_width=0.12)
    paint_loop(middle, uv[loop], line_width=1.2)
    middle.set_title("parameters u, v: one-to-one", color=INK)
    paint_triangles(right, turned, triangles, STONE, line_width=0.15)
    right.set_title(f"{len(triangles):,} triangles: a certified disc", color=INK)
    for axes in (left, middle, right):
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.autoscale_view()
    save(figure, path)


def draw_boundary(path: Path, points: Points, scores: Floats, loops: Sequence[Loop]) -> None:
    """Draw a cloud coloured by its scores, and the loops through it.

    Left the view onto the plane of the boundary, which shows its order; right the same turned by a right angle. The
    boundary begins at the dot and runs the way of the arrow; every tenth of its points is named by its place in it.

    Parameters
    ----------
    path : Path
        A file of one of `PICTURE_SUFFIXES`.
    points : (n, 3) array
    scores : (n,) array
        From 0 to 1.
    loops : sequence of (b,) int arrays
        The boundary first, then the gaps.
    """
    from matplotlib.colors import LinearSegmentedColormap
    from matplotlib.figure import Figure

    check_output(path, suffixes=PICTURE_SUFFIXES)
    scale = LinearSegmentedColormap.from_list("score", SEQUENTIAL)
    figure = Figure(figsize=(15.0, 7.4), facecolor=PAPER, layout="constrained")
    panels = figure.subplots(1, 2)
    facing = (points - points[loops[0]].mean(axis=0)) @ _plane_axes(points[loops[0]]).T
    for axes, turned in zip(panels, (facing, facing[:, [0, 2, 1]] * [1, 1, -1]), strict=True):
        order = np.argsort(turned[:, 2])
        x, y = turned[order, :2].T
        size = np.clip(3e4 / len(points), 1.0, 9.0)
        drawn = axes.scatter(x, y, c=scores[order], s=size, cmap=scale, vmin=0.0, vmax=1.0, linewidths=0)
        drawn.set_rasterized(len(points) > MOST_SHAPES)
        for number, loop in enumerate(loops):
            _trace(axes, turned[loop], is_boundary=number == 0)
        _fit(axes, turned)
    panels[0].set_title(f"the boundary: {len(loops[0])} points", color=INK)
    panels[1].set_title(f"from the side; {len(loops) - 1} other loops", color=INK)
    figure.colorbar(drawn, ax=panels, shrink=0.6, label="score: 0 inside, 1 boundary")
    save(figure, path)


def save(figure: Any, path: Path, *, dpi: float = 110.0) -> None:
    """Write a picture, whole or not at all, in the format of the suffix; text stays text, and bytes are the same twice.

    Parameters
    ----------
    figure : Figure
    path : Path
        A file of one of `PICTURE_SUFFIXES`.
    dpi : float
        Pixels an inch of a PNG, and of the images in the other formats.
    """
    from matplotlib import rc_context

    kind = path.suffix.lower()
    with (
        replacing(path) as temporary,
        rc_context({"svg.hashsalt": "pointchart", "svg.fonttype": "none", "pdf.fonttype": 42}),
    ):
        figure.savefig(temporary, dpi=dpi, format=kind.removeprefix("."), metadata=UNDATED[kind])


def paint_wires(axes: Any, uv: UV, triangles: Triangles, *, line_width: float) -> None:
    """Draw the edges of a triangulation of the plane."""
    lines, _ = axes.triplot(*uv.T, triangles, color=INK, linewidth=line_width, solid_capstyle="butt")
    lines.set_rasterized(len(triangles) > MOST_SHAPES)


def paint_loop(axes: Any, corners: UV, *, line_width: float) -> None:
    """Draw a closed polygon of the plane in the accent colour."""
    closed = np.append(corners, corners[:1], axis=0)
    axes.plot(closed[:, 0], closed[:, 1], color=ACCENT, linewidth=line_width)


def paint_triangles(
    axes: Any, turned: Points, triangles: Triangles, colors: Floats, *, line_width: float, line_tint: float = 1.0
) -> None:
    """Paint triangles from back to front, of one colour or each of its own; edges are darker by `line_tint`."""
    from matplotlib.collections import PolyCollection

    order = np.argsort(turned[triangles, 2].mean(axis=1))
    corner = turned[triangles[order]]
    faces = shaded(unit_normals(turned, triangles[order]), colors[order] if colors.ndim == 2 else colors)
    painted = PolyCollection(
        list(corner[:, :, :2]), facecolors=faces, edgecolors=line_tint * faces, linewidths=line_width
    )
    painted.set_rasterized(len(triangles) > MOST_SHAPES)
    axes.add_collection(painted)


def unit_normals(points: Points, triangles: Triangles) -> Points:
    """Return the unit normal of each triangle, (m, 3); zero where one is flat."""
    vectors = area_vectors(points, triangles)
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1), 1e-300)[:, None])


def shaded(turned: Points, colors: Floats) -> Floats:
    """Return colours as they are lit on places of given normals, (k, 3); what turns its back to us is `INSIDE`.

    Colours that differ, (k, 3), mean something, so that they are shaded less than one for all places, (3,).
    """
    is_back = turned[:, 2:] < 0.0
    brightness = lit(np.where(is_back, -turned, turned), ambient=0.62 if colors.ndim == 2 else 0.4)
    return np.asarray(np.where(is_back, INSIDE, colors) * brightness[:, None])


def lit(turned: Floats, *, ambient: float) -> Floats:
    """Return the brightness of places by their normals, lit from the upper left; the back is darker."""
    shade = ambient + (1.0 - ambient) * np.clip(turned @ LIGHT / BRIGHTEST, 0.0, 1.0)
    return np.asarray(np.where(turned[:, 2] < 0.0, 0.6, 1.0) * np.nan_to_num(shade, nan=ambient))


def paint_image(axes: Any, image: Floats, box: tuple[float, float, float, float]) -> None:
    """Show an image, (h, w, 4), its first row below, in a box: left, right, bottom and top."""
    axes.imshow(image, extent=box, origin="lower", interpolation="hanning", interpolation_stage="rgba")
    axes.set_axis_off()


def style_bar(bar: Any, label: str, *, size: float) -> None:
    """Give a colour bar few ticks, a label and no frame; its colours are one image, not hundreds of boxes."""
    bar.set_label(label, color=INK, fontsize=size)
    for axis in (bar.ax.xaxis, bar.ax.yaxis):  # names of files' properties are no TeX
        axis.label.set_parse_math(False)
    bar.ax.tick_params(colors=INK, labelsize=size)
    bar.outline.set_visible(False)
    bar.solids.set_rasterized(True)


def number(x: float) -> str:
    """Write a number in three digits."""
    return f"{x:{'.3g' if abs(x) < 1000.0 or abs(x) >= 1e6 else ',.0f'}}".replace("-", "\N{MINUS SIGN}")


def _fit(axes: Any, seen: Floats) -> None:
    """Frame what is drawn with a margin, however flat it is."""
    low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
    margin = 0.05 * float((high - low).max())
    axes.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin), aspect="equal")
    axes.set_axis_off()


def _plane_axes(corners: Points) -> Floats:
    """Return two axes of the plane of a loop and its normal, towards which it runs anticlockwise."""
    centred = corners - corners.mean(axis=0)
    normal = np.cross(centred, np.roll(centred, -1, axis=0)).sum(axis=0)
    normal /= max(float(np.linalg.norm(normal)), 1e-300)
    longest = np.linalg.svd(centred - np.outer(centred @ normal, normal), full_matrices=False)[2][0]
    return np.stack([longest, np.cross(normal, longest), normal])


def _trace(axes: Any, places: Points, *, is_boundary: bool) -> None:
    closed = np.append(places, places[:1], axis=0)
    axes.plot(closed[:, 0], closed[:, 1], color=ACCENT if is_boundary else INK, linewidth=1.6 if is_boundary else 1.0)
    if not is_boundary:
        return
    axes.plot(*places[0, :2], "o", color=ACCENT, markersize=8)
    ahead = places[max(1, len(places) // 40)]
    arrow = {"arrowstyle": "-|>", "color": ACCENT, "linewidth": 1.6, "mutation_scale": 18}
    axes.annotate("", xy=ahead[:2], xytext=places[0, :2], arrowprops=arrow)
    step = max(1, len(places) // 10)
    for k in range(0, len(places) - step // 2, step):
        axes.annotate(str(k), places[k, :2], color=INK, fontsize=8, xytext=(4, 4), textcoords="offset points")


def _scatter(axes: Any, turned: Points) -> None:
    near = (turned[:, 2] - turned[:, 2].min()) / max(np.ptp(turned[:, 2]), 1e-300)
    order = np.argsort(turned[:, 2])
    axes.scatter(turned[order, 0], turned[order, 1], c=near[order], s=1.1, cmap="copper", linewidths=0)


def rotation(about_vertical: float, about_horizontal: float) -> Floats:
    """Return the matrix that turns a picture about its vertical axis, then about its horizontal one, in degrees."""
    a, b = np.deg2rad(about_vertical), np.deg2rad(about_horizontal)
    turn = np.array([[np.cos(a), 0.0, np.sin(a)], [0.0, 1.0, 0.0], [-np.sin(a), 0.0, np.cos(a)]])
    tilt = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(b), -np.sin(b)], [0.0, np.sin(b), np.cos(b)]])
    return np.asarray(tilt @ turn)
