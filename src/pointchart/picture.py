"""Pictures of a run: the cloud, the parameter plane with its triangulation, the mesh."""

from pathlib import Path
from typing import Any

import numpy as np

from .io import replacing
from .typing import UV, Floats, Loop, Points, Triangles

PAPER, INK, ACCENT = "#fbfaf7", "#22303c", "#c8553d"
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
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=110, format="png")
    plt.close(figure)


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
