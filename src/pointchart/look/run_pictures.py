"""Pictures of a run: the cloud with its boundary, the parameter plane with its triangulation, the mesh."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..io import check_output
from ..typing import UV, Floats, Loop, Points, Triangles
from .camera import rotation
from .color_scales import LITTLE_TO_MUCH, color_map
from .paint import (
    ACCENT,
    INK,
    MOST_SHAPES,
    PAPER,
    PICTURE_SUFFIXES,
    STONE,
    paint_loop,
    paint_triangles,
    paint_wires,
    save,
)

DOTS = 3e4, 1.0, 9.0  # area of all dots of a boundary's cloud in points squared; that of one at least and at most
FRAME = 0.05  # of the longer side: room around a cloud for the names of its points
NAMED = 10  # points along a boundary that are named, about
AHEAD = 40  # of the points of a boundary, that part after which its arrow ends: long enough to be seen


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
    from matplotlib.figure import Figure

    check_output(path, suffixes=PICTURE_SUFFIXES)
    figure = Figure(figsize=(15.0, 7.4), facecolor=PAPER, layout="constrained")
    panels = figure.subplots(1, 2)
    facing = (points - points[loops[0]].mean(axis=0)) @ _plane_axes(points[loops[0]]).T
    for axes, turned in zip(panels, (facing, facing[:, [0, 2, 1]] * [1, 1, -1]), strict=True):
        drawn = _score(axes, turned, scores)
        for number, loop in enumerate(loops):
            _trace(axes, turned[loop], is_boundary=number == 0)
        _fit(axes, turned)
    panels[0].set_title(f"the boundary: {len(loops[0])} points", color=INK)
    panels[1].set_title(f"from the side; {len(loops) - 1} other loops", color=INK)
    figure.colorbar(drawn, ax=panels, shrink=0.6, label="score: 0 inside, 1 boundary")
    save(figure, path)


def _score(axes: Any, turned: Points, scores: Floats) -> Any:
    """Draw a cloud from back to front by its scores."""
    all_dots, least, most = DOTS
    order = np.argsort(turned[:, 2])
    size, in_colors = np.clip(all_dots / len(turned), least, most), color_map(LITTLE_TO_MUCH)
    drawn = axes.scatter(
        *turned[order, :2].T, c=scores[order], s=size, cmap=in_colors, vmin=0.0, vmax=1.0, linewidths=0
    )
    drawn.set_rasterized(len(turned) > MOST_SHAPES)
    return drawn


def _fit(axes: Any, seen: Floats) -> None:
    """Frame what is drawn with a margin, however flat it is."""
    low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
    margin = FRAME * float((high - low).max())
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
    if not is_boundary:
        paint_loop(axes, places, line_width=1.0, color=INK)
        return
    paint_loop(axes, places, line_width=1.6)
    axes.plot(*places[0, :2], "o", color=ACCENT, markersize=8)
    ahead = places[max(1, len(places) // AHEAD)]
    arrow = {"arrowstyle": "-|>", "color": ACCENT, "linewidth": 1.6, "mutation_scale": 18}
    axes.annotate("", xy=ahead[:2], xytext=places[0, :2], arrowprops=arrow)
    step = max(1, len(places) // NAMED)
    for k in range(0, len(places) - step // 2, step):
        axes.annotate(str(k), places[k, :2], color=INK, fontsize=8, xytext=(4, 4), textcoords="offset points")


def _scatter(axes: Any, turned: Points) -> None:
    near = (turned[:, 2] - turned[:, 2].min()) / max(np.ptp(turned[:, 2]), 1e-300)
    order = np.argsort(turned[:, 2])
    axes.scatter(turned[order, 0], turned[order, 1], c=near[order], s=1.1, cmap="copper", linewidths=0)
