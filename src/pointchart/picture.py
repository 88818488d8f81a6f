"""Pictures of a run: the cloud with its boundary, the parameter plane with its triangulation, the mesh."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .io import replacing
from .typing import UV, Floats, Loop, Points, Triangles

PAPER, FAINT, INK, ACCENT = "#fbfaf7", "#ccd6d8", "#22303c", "#c8553d"
STONE = np.array([0.83, 0.77, 0.68])


def draw_run(
    path: Path, points: Points, triangles: Triangles, uv: UV, loop: Loop, *, view: tuple[float, float] = (0.0, 0.0)
) -> None:
    """Draw the cloud, its parameters and its mesh side by side into a PNG.

    Parameters
    ----------
    path : Path
    points : (n, 3) array
    triangles : (m, 3) int array
    uv : (n, 2) array
    loop : (b,) int array
    view : (float, float)
        Turn about the vertical and the horizontal axis of the picture, in degrees; (0, 0) looks down the z axis.
    """
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    turned = points @ _rotation(*view).T
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(15.0, 5.4), facecolor=PAPER, layout="constrained")
    _scatter(left, turned)
    left.set_title(f"{len(points):,} points", color=INK)
    _wires(middle, uv, triangles, loop)
    middle.set_title("parameters u, v: one-to-one", color=INK)
    _shade(right, turned, triangles)
    right.set_title(f"{len(triangles):,} triangles: a certified disc", color=INK)
    for axes in (left, middle, right):
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.autoscale_view()
    try:
        with replacing(path) as temporary:
            figure.savefig(temporary, dpi=110, format="png")
    finally:
        plt.close(figure)


def draw_boundary(path: Path, points: Points, scores: Floats, loops: Sequence[Loop]) -> None:
    """Draw a cloud coloured by its scores, and the loops through it, into a PNG.

    Left the view onto the plane of the boundary, which shows its order; right the same turned by a right angle. The
    boundary begins at the dot and runs the way of the arrow; every tenth of its points is named by its place in it.

    Parameters
    ----------
    path : Path
    points : (n, 3) array
    scores : (n,) array
        From 0 to 1.
    loops : sequence of (b,) int arrays
        The boundary first, then the gaps.
    """
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    scale = mpl.colors.LinearSegmentedColormap.from_list("score", [FAINT, "#3a8fb7", INK])
    figure, panels = plt.subplots(1, 2, figsize=(15.0, 7.4), facecolor=PAPER, layout="constrained")
    facing = (points - points[loops[0]].mean(axis=0)) @ _plane_axes(points[loops[0]]).T
    for axes, turned in zip(panels, (facing, facing[:, [0, 2, 1]] * [1, 1, -1]), strict=True):
        order = np.argsort(turned[:, 2])
        x, y = turned[order, :2].T
        size = np.clip(3e4 / len(points), 1.0, 9.0)
        drawn = axes.scatter(x, y, c=scores[order], s=size, cmap=scale, vmin=0.0, vmax=1.0, linewidths=0)
        for number, loop in enumerate(loops):
            _trace(axes, turned[loop], is_boundary=number == 0)
        _fit(axes, turned)
    panels[0].set_title(f"the boundary: {len(loops[0])} points", color=INK)
    panels[1].set_title(f"from the side; {len(loops) - 1} other loops", color=INK)
    figure.colorbar(drawn, ax=panels, shrink=0.6, label="score: 0 inside, 1 boundary")
    try:
        with replacing(path) as temporary:
            figure.savefig(temporary, dpi=110, format="png")
    finally:
        plt.close(figure)


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


def _wires(axes: Any, uv: UV, triangles: Triangles, loop: Loop) -> None:
    axes.triplot(uv[:, 0], uv[:, 1], triangles, color=INK, linewidth=0.12)
    rim = uv[np.append(loop, loop[0])]
    axes.plot(rim[:, 0], rim[:, 1], color=ACCENT, linewidth=1.2)


def _shade(axes: Any, turned: Points, triangles: Triangles) -> None:
    """Paint triangles from back to front, lit from the upper left."""
    from matplotlib.collections import PolyCollection

    corner = turned[triangles]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    light = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])
    shade = 0.28 + 0.72 * np.clip(normal @ light, 0.0, 1.0)
    shade[normal[:, 2] < 0.0] *= 0.6
    order = np.argsort(corner[:, :, 2].mean(axis=1))
    colors = np.clip(shade[order, None] * STONE, 0.0, 1.0)
    axes.add_collection(
        PolyCollection(list(corner[order][:, :, :2]), facecolors=colors, edgecolors=colors, linewidths=0.15)
    )


def _rotation(about_vertical: float, about_horizontal: float) -> Floats:
    a, b = np.deg2rad(about_vertical), np.deg2rad(about_horizontal)
    turn = np.array([[np.cos(a), 0.0, np.sin(a)], [0.0, 1.0, 0.0], [-np.sin(a), 0.0, np.cos(a)]])
    tilt = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(b), -np.sin(b)], [0.0, np.sin(b), np.cos(b)]])
    return np.asarray(tilt @ turn)
