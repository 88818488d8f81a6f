"""Draw the figures of Floater and Reimers 2001 from our own runs: Figures 1 to 8.

    python benchmarks/figures.py OUT_DIR [--data DIR] [--only 5 8]

The scans lie beside the checkout, in ../shared/data; where they are missing, only Figures 1 to 3 are drawn.
Stanford's terms keep pictures of its bunny (Figure 7) from being sold, so they are drawn on the reader's machine only.
"""

import argparse
from collections.abc import Callable
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from paper_scans import DATA, Scan, load_scans, run
from PIL import Image

from pointchart.boundary import chord_length_steps, on_circle, order_by_halves
from pointchart.mesh import half_edges
from pointchart.neighbors import Neighborhoods, ball
from pointchart.parameterize import parameterize
from pointchart.quality import area_vectors, edge_lengths
from pointchart.shapes import Shape, add_noise, disc
from pointchart.stars import delaunay_star
from pointchart.swaps import swap_to_delaunay
from pointchart.triangulate import triangulate
from pointchart.typing import UV, Floats, Points, Triangles
from pointchart.weights import reciprocal_distance

INK, GREY, PALE = "#1f2a37", "#a3adb8", "#dfe9f1"
BLUE, ORANGE = "#2f6f9f", "#d1703c"  # what a picture is about, and what it is compared with
FRONT, BACK = np.array([0.80, 0.88, 0.94]), np.array([0.90, 0.66, 0.50])
LIGHT = np.array([-0.40, 0.45, 0.80]) / np.linalg.norm([-0.40, 0.45, 0.80])
DPI = 150
LAST_WITHOUT_SCANS = 3  # the captions of later figures name real scans

# The direction towards the eye, and the one that is upwards in the picture.
VIEWS = {
    "Foot": ((1.0, -0.9, 0.8), (0.0, 0.0, 1.0)),
    "Spock": ((0.45, 0.1, 1.0), (0.0, 1.0, 0.0)),
    "Bunny": ((-0.1, 0.15, 1.0), (0.0, 1.0, 0.0)),
}
EARS = ((0.02, 0.58), (0.55, 1.02))  # of the picture's width and height


def camera(label: str) -> Floats:
    """Return the rows right, up and towards the eye."""
    eye, up = (np.array(vector) for vector in VIEWS[label])
    eye = eye / np.linalg.norm(eye)
    right = np.cross(up, eye)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(eye, right), eye])


def draw_mesh(ax: Axes, points: Points, triangles: Triangles, label: str, line_width: float = 0.2) -> None:
    """Shade a mesh, the far triangles first; backs have another colour."""
    seen = points @ camera(label).T
    normal = area_vectors(seen, triangles)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    is_front = normal[:, 2] > 0.0
    toward = np.where(is_front[:, None], normal, -normal)
    shade = 0.30 + 0.70 * np.clip(toward @ LIGHT, 0.0, 1.0)
    color = np.where(is_front[:, None], FRONT, BACK) * shade[:, None]
    order = np.argsort(seen[triangles, 2].mean(axis=1))
    corners = seen[triangles[order], :2]
    edge = 0.55 * color[order]
    ax.add_collection(PolyCollection(corners, facecolors=color[order], edgecolors=edge, linewidths=line_width))
    frame(ax, seen[:, :2])


def draw_parameters(ax: Axes, uv: UV, triangles: Triangles, line_width: float = 0.15) -> None:
    """Draw the triangulation of the parameters."""
    ends = edge_lengths(np.c_[uv, np.zeros(len(uv))], half_edges(triangles, len(uv)))[0]
    ax.add_collection(LineCollection(uv[ends], colors=INK, linewidths=line_width))
    frame(ax, uv)


def frame(ax: Axes, seen: UV) -> None:
    low, high = seen.min(axis=0), seen.max(axis=0)
    margin = 0.02 * (high - low).max()
    ax.set(
        xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin), aspect="equal", anchor="N"
    )
    ax.axis("off")


def panels(rows: int, columns: int, side: float) -> tuple[Figure, list[Axes]]:
    figure, axes = plt.subplots(
        rows, columns, figsize=(columns * side, rows * side), layout="constrained", squeeze=False
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
    for center, color in zip(centers, (BLUE, ORANGE), strict=False):
        if fill:
            ax.add_patch(Circle(points[center], radius, facecolor=color, alpha=0.12, linewidth=0.0))
        ax.add_patch(Circle(points[center], radius, fill=False, edgecolor=color, linewidth=1.4, linestyle="--"))
    ax.scatter(*points.T, s=30, color=GREY, zorder=3)
    ax.scatter(*points[held].T, s=42, color=INK, zorder=4)
    ax.scatter(*points[centers].T, s=95, c=[BLUE, ORANGE][: len(centers)], edgecolors="white", zorder=5)
    frame(ax, points)


def figure_4(scans: dict[str, Scan]) -> Figure:
    """Draw the boundary of the foot, cut by a plane, each half in the order of its univariate parameters."""
    scan = scans["Foot"]
    figure, (ax,) = panels(1, 1, 6.0)
    members = np.random.default_rng(0).permutation(scan.loop)
    ordered = scan.points[order_by_halves(scan.points, members)]
    centred = ordered - ordered.mean(axis=0)
    axes = np.linalg.svd(centred, full_matrices=False)[2]
    flat = centred @ axes[:2].T
    is_upper = flat[:, 0] >= 0.0
    is_upper = is_upper if is_upper[0] else ~is_upper
    for half, color in ((flat[is_upper], BLUE), (flat[~is_upper], ORANGE)):
        ax.plot(*half.T, color=color, linewidth=1.6)
        ax.scatter(*half.T, s=26, color=color, zorder=3)
        for place in (0, len(half) - 1):
            ax.annotate(str(place + 1), half[place], textcoords="offset points", xytext=(8, 6), color=color)
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
        draw_parameters(axes[2 * k], uv, triangles)
        draw_mesh(axes[2 * k + 1], scan.points, triangles, scan.label)
        axes[2 * k].set_title(f"parameterization, method {method}", color=INK)
        axes[2 * k + 1].set_title("3D triangulation", color=INK)
    return figure


def figure_7(scans: dict[str, Scan]) -> Figure:
    """Draw the bunny by method 2, and the triangles of its ears."""
    scan = scans["Bunny"]
    figure, axes = panels(1, 3, 4.0)
    uv = run(scan, "2").uv
    triangles = triangulate(uv, scan.loop)
    draw_parameters(axes[0], uv, triangles, line_width=0.08)
    draw_mesh(axes[1], scan.points, triangles, scan.label, line_width=0.08)
    draw_mesh(axes[2], scan.points, triangles, scan.label)
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
    """Write a picture in 128 colours, a third of its size."""
    figure.savefig(path, dpi=DPI, facecolor="white")
    plt.close(figure)
    with Image.open(path) as picture:
        few = picture.convert("RGB").quantize(128)
    few.save(path, optimize=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path, help="folder of the pictures")
    parser.add_argument("--data", type=Path, default=DATA, help="folder of the scans")
    parser.add_argument("--only", type=int, nargs="+", choices=FIGURES, default=list(FIGURES), help="figures to draw")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    scans = load_scans(options.data)
    drawn = (
        options.only if options.data.exists() else [number for number in options.only if number <= LAST_WITHOUT_SCANS]
    )
    if len(drawn) < len(options.only):
        print(f"no scans in {options.data}: figures after {LAST_WITHOUT_SCANS} are left as they are")
    for number in drawn:
        figure = FIGURES[number](scans)
        path = options.out / f"figure{number}.png"
        save(figure, path)
        print(path)


if __name__ == "__main__":
    main()
