"""Draw the figures of Floater and Reimers 2001 from our own runs: Figures 1 to 8.

    python benchmarks/figures.py OUT_DIR [--data DIR] [--only 5 8]

The scans lie beside the checkout, in ../shared/data; where they are missing, only Figures 1 to 3 and 7 are drawn.
Stanford's terms keep pictures of its bunny from being sold, so Figure 7 shows a simulated rabbit.
"""

import argparse
from collections.abc import Callable
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from paper_scans import DATA, Scan, from_truth, load_scans, run
from PIL import Image
from rabbit import rabbit

from pointchart.boundary import chord_length_steps, on_circle, order_by_halves
from pointchart.look.camera import camera
from pointchart.look.paint import ACCENT, INK, STONE, paint_loop, paint_triangles, paint_wires
from pointchart.map.convex_combination import parameterize
from pointchart.map.weights import reciprocal_distance
from pointchart.mesh.delaunay_swaps import swap_to_delaunay
from pointchart.mesh.planar_delaunay import triangulate
from pointchart.points.neighborhoods import Neighborhoods
from pointchart.points.neighbors import ball
from pointchart.points.stars import delaunay_star
from pointchart.shapes import Shape, add_noise, disc
from pointchart.typing import UV, Loop, Points, Triangles

GREY, PALE, BLUE = "#a3adb8", "#dfe9f1", "#2f6f9f"
DPI, FINER, COLORS = 130, 3, 88
WITHOUT_SCANS = (1, 2, 3, 7)  # the captions of the others name real scans

# How far we walk around a scan and look down on it, in degrees, and the axis that is upwards.
VIEWS: dict[str, tuple[tuple[float, float], str]] = {
    "Foot": ((48.0, 31.0), "z"),
    "Spock": ((24.0, 5.0), "y"),
    "Rabbit": ((25.0, 12.0), "y"),
}
EARS = ((0.05, 0.75), (0.56, 1.01))  # of the picture's width and height


def draw_mesh(ax: Axes, points: Points, triangles: Triangles, label: str, line_width: float = 0.15) -> None:
    """Shade a mesh with its edges."""
    view, up = VIEWS[label]
    seen = points @ camera(points, triangles, view=view, up=up).T
    paint_triangles(ax, seen, triangles, STONE, line_width=line_width, line_tint=0.55)
    frame(ax, seen[:, :2])


def draw_parameters(ax: Axes, uv: UV, triangles: Triangles, loop: Loop, line_width: float = 0.15) -> None:
    """Draw the triangulation of the parameters, its boundary in colour."""
    paint_wires(ax, uv, triangles, line_width=line_width)
    paint_loop(ax, uv[loop], line_width=1.2)
    frame(ax, uv)


def frame(ax: Axes, seen: UV) -> None:
    low, high = seen.min(axis=0), seen.max(axis=0)
    margin = 0.02 * (high - low).max()
    ax.set(
        xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin), aspect="equal", anchor="N"
    )
    ax.axis("off")


def panels(rows: int, columns: int, side: float, *, height: float = 1.0) -> tuple[Figure, list[Axes]]:
    figure, axes = plt.subplots(
        rows, columns, figsize=(columns * side, rows * side * height), layout="constrained", squeeze=False
    )
    return figure, list(axes.flat)


def figure_1(scans: dict[str, Scan]) -> Figure:
    figure, (ax,) = panels(1, 1, 6.0)
    points, center, radius = flat_scatter(), np.zeros(2), 0.27
    draw_balls(ax, points, [int(np.argmin(np.linalg.norm(points - center, axis=1)))], radius)
    return figure


def figure_2(scans: dict[str, Scan]) -> Figure:
    """Draw two balls: with different points, and with the same ones once those in only one of them are taken away."""
    figure, axes = panels(1, 2, 4.0)
    points, radius = flat_scatter(), 0.27
    inner = np.flatnonzero(np.linalg.norm(points, axis=1) < 0.25)
    apart = np.linalg.norm(points[inner, None] - points[inner], axis=2) + np.eye(len(inner))
    pair = inner[list(np.unravel_index(apart.argmin(), apart.shape))]
    distance = np.linalg.norm(points[:, None] - points[pair], axis=2)
    in_one = (distance < radius).sum(axis=1) == 1
    kept = np.append(pair, np.setdiff1d(np.flatnonzero(~in_one), pair))
    for ax, cloud, centers, title in (
        (axes[0], points, pair.tolist(), "different neighbourhoods"),
        (axes[1], points[kept], [0, 1], "coinciding neighbourhoods"),
    ):
        draw_balls(ax, cloud, centers, radius)
        ax.set_title(title, color=INK)
    return figure


def figure_3(scans: dict[str, Scan]) -> Figure:
    """Draw a Delaunay neighbourhood among the points of a ball."""
    figure, (ax,) = panels(1, 1, 6.0)
    points, radius = flat_scatter(), 0.36
    space = np.c_[points, np.zeros(len(points))]
    center = int(np.argmin(np.linalg.norm(points, axis=1)))
    star = row(delaunay_star(space, ball(space, radius)), center)
    ax.add_patch(plt.Polygon(points[star], facecolor=PALE, edgecolor=BLUE, linewidth=1.6, zorder=1))
    spokes = [(points[center], points[j]) for j in star]
    ax.add_collection(LineCollection(spokes, colors=BLUE, linewidths=1.6, zorder=2))
    draw_balls(ax, points, [center], radius, fill=False, chosen=star)
    return figure


def flat_scatter() -> UV:
    """Scatter points unevenly, seen from above."""
    flat = disc(220, jitter=0.9, seed=4).points[:, :2]
    return flat[np.abs(flat).max(axis=1) < 0.58]


def row(around: Neighborhoods, point: int) -> list[int]:
    return around.indices[around.indptr[point] : around.indptr[point + 1]].tolist()


def draw_balls(
    ax: Axes, points: UV, centers: list[int], radius: float, *, fill: bool = True, chosen: list[int] | None = None
) -> None:
    """Draw points, the balls around some of them, and which points they hold."""
    around = ball(np.c_[points, np.zeros(len(points))], radius)
    held = sorted({j for center in centers for j in row(around, center)} - set(centers)) if chosen is None else chosen
    for center, color in zip(centers, (BLUE, ACCENT), strict=False):
        if fill:
            ax.add_patch(Circle(points[center], radius, facecolor=color, alpha=0.12, linewidth=0.0))
        ax.add_patch(Circle(points[center], radius, fill=False, edgecolor=color, linewidth=1.4, linestyle="--"))
    ax.scatter(*points.T, s=30, color=GREY, zorder=3)
    ax.scatter(*points[held].T, s=42, color=INK, zorder=4)
    ax.scatter(*points[centers].T, s=95, c=[BLUE, ACCENT][: len(centers)], edgecolors="white", zorder=5)
    frame(ax, points)


def figure_4(scans: dict[str, Scan]) -> Figure:
    """Draw the boundary of the foot, cut by a plane, each half in the order of its univariate parameters."""
    scan = scans["Foot"]
    figure, (ax,) = panels(1, 1, 6.0, height=0.82)
    members = np.random.default_rng(0).permutation(scan.loop)
    ordered = scan.points[order_by_halves(scan.points, members)]
    centred = ordered - ordered.mean(axis=0)
    axes = np.linalg.svd(centred, full_matrices=False)[2]
    flat = centred @ axes[:2].T
    is_upper = flat[:, 0] >= 0.0
    start = int(np.flatnonzero(is_upper & ~np.roll(is_upper, 1))[0])
    flat, is_upper = np.roll(flat, -start, axis=0), np.roll(is_upper, -start)
    for half, color in ((flat[is_upper], BLUE), (flat[~is_upper], ACCENT)):
        ax.plot(*half.T, color=color, linewidth=1.6)
        ax.scatter(*half.T, s=26, color=color, zorder=3)
        for place in (0, len(half) - 1):
            outwards = (-16 if color == ACCENT else 6, 6 if half[place][1] > 0.0 else -14)
            ax.annotate(str(place + 1), half[place], textcoords="offset points", xytext=outwards, color=color)
    ax.axvline(0.0, color=GREY, linewidth=1.0, linestyle="--")
    frame(ax, flat)
    return figure


def figure_5(scans: dict[str, Scan]) -> Figure:
    return methods_2_and_3(scans["Foot"])


def figure_6(scans: dict[str, Scan]) -> Figure:
    return methods_2_and_3(scans["Spock"])


def methods_2_and_3(scan: Scan) -> Figure:
    """Draw the parameters on the left and the surface on the right, method 2 above method 3."""
    figure, axes = panels(2, 2, 4.0)
    for k, method in enumerate(("2", "3")):
        uv = run(scan, method).uv
        triangles = triangulate(uv, scan.loop)
        draw_parameters(axes[2 * k], uv, triangles, scan.loop)
        draw_mesh(axes[2 * k + 1], scan.points, triangles, scan.label)
        axes[2 * k].set_title(f"parameterization, method {method}", color=INK)
        axes[2 * k + 1].set_title("3D triangulation", color=INK)
    return figure


def figure_7(scans: dict[str, Scan]) -> Figure:
    """Draw a rabbit by method 2, and the triangles of its ears."""
    spacing = 0.016
    points, loop = rabbit(spacing)
    scan = from_truth("Rabbit", "rabbit", points, loop, np.empty((0, 3), np.int64), 2.6 * spacing)
    figure, axes = panels(1, 3, 4.0, height=1.15)
    uv = run(scan, "2").uv
    triangles = triangulate(uv, scan.loop)
    draw_parameters(axes[0], uv, triangles, scan.loop, line_width=0.15)
    draw_mesh(axes[1], scan.points, triangles, scan.label, line_width=0.12)
    draw_mesh(axes[2], scan.points, triangles, scan.label, line_width=0.3)
    low, high = np.array(axes[1].viewLim.min), np.array(axes[1].viewLim.max)
    across, along = (low[k] + (high - low)[k] * np.array(EARS[k]) for k in range(2))
    axes[2].set(xlim=across, ylim=along)
    for ax, title in zip(axes, ("parameterization, method 2", "3D triangulation", "close-up"), strict=True):
        ax.set_title(title, color=INK)
    return figure


def figure_8(scans: dict[str, Scan]) -> Figure:
    """Draw the head with noise of a tenth and a quarter of the spacing, by method 2 and after the swaps."""
    head = scans["Spock"]
    figure, axes = panels(2, 2, 4.0)
    for k, sigma in enumerate((0.1, 0.25)):
        clean = Shape(head.points, head.truth, np.zeros((len(head.points), 2)))
        points = add_noise(clean, sigma_in_spacings=sigma).points
        layout = on_circle(chord_length_steps(points, head.loop))
        uv = parameterize(points, head.loop, layout, ball(points, head.radius), weights=reciprocal_distance).uv
        triangles = triangulate(uv, head.loop)
        draw_mesh(axes[2 * k], points, triangles, head.label)
        draw_mesh(axes[2 * k + 1], points, swap_to_delaunay(points, triangles).triangles, head.label)
        axes[2 * k].set_title(f"noise of {sigma:g} spacings, method 2", color=INK)
        axes[2 * k + 1].set_title("after edge swaps", color=INK)
    return figure


FIGURES: dict[int, Callable[[dict[str, Scan]], Figure]] = {
    1: figure_1,
    2: figure_2,
    3: figure_3,
    4: figure_4,
    5: figure_5,
    6: figure_6,
    7: figure_7,
    8: figure_8,
}


def save(figure: Figure, path: Path) -> None:
    """Write a picture in few colours, a third of its size, drawn finer, so that nothing behind shows at edges."""
    figure.savefig(path, dpi=FINER * DPI, facecolor="white")
    plt.close(figure)
    with Image.open(path) as picture:
        few = picture.convert("RGB").reduce(FINER).quantize(COLORS)
    few.save(path, optimize=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path, help="folder of the pictures")
    parser.add_argument("--data", type=Path, default=DATA, help="folder of the scans")
    parser.add_argument("--only", type=int, nargs="+", choices=FIGURES, default=list(FIGURES), help="figures to draw")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    scans = load_scans(options.data)
    drawn = [number for number in options.only if options.data.exists() or number in WITHOUT_SCANS]
    if len(drawn) < len(options.only):
        print(f"no scans in {options.data}: figures but {WITHOUT_SCANS} are left as they are")
    for number in drawn:
        path = options.out / f"figure{number}.png"
        save(FIGURES[number](scans), path)
        print(path)


if __name__ == "__main__":
    main()
