"""Draw the pictures of the pages on the stages, from simulated scans: ``python docs/pictures.py docs/figures``."""

import sys
from functools import cache
from pathlib import Path

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection, PolyCollection

import pointchart as pc
from pointchart import shapes
from pointchart.agreement.agreed_surface import collect_agreed
from pointchart.boundary.bounded import survey_scan
from pointchart.look.camera import rotation
from pointchart.look.color_scales import LITTLE_TO_MUCH, color_map
from pointchart.look.paint import ACCENT, FAINT, INK, LIGHT, PAPER, STEEL, STONE
from pointchart.mesh.assembly import assemble as assembled
from pointchart.mesh.connectivity import half_edges as pair
from pointchart.mesh.quality import unit_normals

SCALE = color_map(LITTLE_TO_MUCH)
COPPER = mpl.colors.LinearSegmentedColormap.from_list("height", ["#3b2a20", "#a8693f", "#efd9bd"])
SIGNED = mpl.colors.LinearSegmentedColormap.from_list("signed", [STEEL, PAPER, ACCENT])


def panels(count, *titles, width=10.0, height=None):
    """Return a figure with framed-off panels side by side, each with its title."""
    figure, axes = plt.subplots(
        1, count, figsize=(width, height or width / count + 0.3), facecolor=PAPER, layout="constrained", squeeze=False
    )
    for panel, title in zip(axes[0], titles, strict=True):
        panel.set_title(title, color=INK, fontsize=11)
        panel.set_aspect("equal")
        panel.set_axis_off()
    return figure, axes[0]


def wires(axes, places, triangles, *, color=INK, width=0.35):
    """Draw a mesh by its edges."""
    axes.triplot(places[:, 0], places[:, 1], triangles, color=color, linewidth=width)


def ring(axes, places, *, color=ACCENT, width=1.6):
    """Draw a closed polygon."""
    axes.plot(*np.vstack([places, places[:1]])[:, :2].T, color=color, linewidth=width)


def shaded(axes, points, triangles):
    """Paint a mesh from back to front, lit from the upper left."""
    corner, normal = points[triangles], unit_normals(points, triangles)
    shade = (0.3 + 0.7 * np.clip(np.abs(normal @ LIGHT), 0.0, 1.0))[:, None] * STONE
    order = np.argsort(corner[:, :, 2].mean(axis=1))
    axes.add_collection(
        PolyCollection(corner[order][:, :, :2], facecolors=shade[order], edgecolors=shade[order], linewidths=0.2)
    )
    axes.autoscale_view()


def turned(points, about_y=0.0, about_x=0.0):
    """Turn points about the vertical and the horizontal axis of the picture, in degrees."""
    return points @ rotation(about_y, about_x).T


@cache
def face():
    """Return a scan of a face and its mesh."""
    points = shapes.sculpture(2200).points
    return points, pc.reconstruct(points)


def prepare():
    """Draw the order of the file against that along the curve."""
    scan = shapes.shuffle(shapes.disc(700, seed=3), seed=1).points
    cloud = pc.prepare(scan)
    figure, (left, right) = panels(2, "rows of the file, joined in their order", "the same points, sorted", width=9.0)
    for axes, places in ((left, scan), (right, cloud.points)):
        axes.plot(*places[:, :2].T, color=FAINT if axes is left else STEEL, linewidth=0.5 if axes is left else 0.9)
        axes.scatter(*places[:, :2].T, s=5, c=np.arange(len(places)), cmap=COPPER, zorder=2)
    return figure


def neighborhoods():
    """Draw a ball, the nearest and a Delaunay star of the same point, on a track-like scan."""
    rng = np.random.default_rng(5)
    points = np.array([[x + 0.25 * rng.uniform(), 2.6 * y, 0.0] for y in range(9) for x in range(23)])
    points += 0.12 * rng.uniform(-1, 1, points.shape)
    points[:, 2] = 0.0
    middle = 4 * 23 + 11
    found = (
        pc.ball(points, 3.0),
        pc.nearest(points, 12),
        pc.nearest_star(points, pc.nearest(points, 20)),
    )
    figure, axes = panels(3, "ball of radius 3", "12 nearest", "Delaunay star", width=10.5, height=3.7)
    for panel, around in zip(axes, found, strict=True):
        mine = around.indices[around.indptr[middle] : around.indptr[middle + 1]]
        panel.scatter(*points[:, :2].T, s=7, c="#9fb0b5")
        lines = [[points[middle, :2], points[j, :2]] for j in mine]
        panel.add_collection(LineCollection(lines, colors=ACCENT, linewidths=1.3))
        panel.scatter(*points[mine, :2].T, s=22, c=INK, zorder=3)
        panel.scatter(*points[middle, :2], s=48, c=ACCENT, zorder=4)
        panel.set(xlim=(6.0, 16.5), ylim=(5.2, 15.7))
    axes[0].add_patch(plt.Circle(points[middle, :2], 3.0, fill=False, color=STEEL, linewidth=1.2))
    return figure


def boundary():
    """Draw triangles on which stars agree, the scores, and the loops."""
    points = shapes.pierce(shapes.relief(2500, seed=4), n_gaps=2, seed=2).points
    survey = survey_scan(points)
    cloud, near = survey.cloud.points, survey.vicinity
    agreed = collect_agreed(near.smoothed, near.star, near.spacing).triangles
    figure, (left, middle, right) = panels(3, "triangles on which stars agree", "scores", "loops", width=11.0)
    wires(left, cloud, agreed, width=0.35)
    middle.scatter(*cloud[:, :2].T, s=6, c=survey.score().total, cmap=SCALE, vmin=0, vmax=1)
    right.scatter(*cloud[:, :2].T, s=2, c=FAINT)
    for number, candidate in enumerate(survey.candidates):
        ring(right, cloud[candidate.loop], color=INK if number else ACCENT, width=1.2 if number else 2.0)
    return figure


def map_():
    """Draw the boundary laid out on circle and square, and the interior solved for."""
    points, disc = face()
    circle = pc.chord_length_on_circle(points, disc.loop)
    star = pc.delaunay_star(points, pc.nearest(points, 20))
    mapped = pc.parameterize(points, disc.loop, circle, star)
    corners = pc.sharpest_places(points, disc.loop)
    square = pc.on_square(pc.chord_length_steps(points, disc.loop), corners)
    squared = pc.parameterize(points, disc.loop, square, star)
    figure, (left, middle, right) = panels(3, "points and boundary", "on the circle", "on the square", width=11.0)
    left.scatter(*points[:, :2].T, s=4, c=points[:, 2], cmap=COPPER)
    ring(left, points[disc.loop])
    for axes, uv in ((middle, mapped.uv), (right, squared.uv)):
        axes.scatter(*uv.T, s=4, c=points[:, 2], cmap=COPPER)
        ring(axes, uv[disc.loop])
    return figure


def assemble():
    """Draw where stars agree on a noisy scan, the pockets that they leave, and the disc."""
    survey = survey_scan(
        shapes.add_noise(shapes.pierce(shapes.relief(900, seed=6), n_gaps=1), sigma_in_spacings=0.3, seed=2).points
    )
    points = survey.cloud.points
    surface = survey.draw_tight()
    agreed = surface.triangles[surface.largest]
    triangles = assembled(points, surface, survey.loop).triangles
    held = {frozenset(t) for t in agreed.tolist()}
    caps = np.array([t for t in triangles.tolist() if frozenset(t) not in held])
    kept = np.array([t for t in triangles.tolist() if frozenset(t) in held])
    figure, (left, right) = panels(2, "triangles on which stars agree", "pockets closed: a disc", width=10.0)
    filled(left, points, agreed, "#e7ecec", INK)
    filled(right, points, kept, "#e7ecec", INK)
    filled(right, points, caps, "#eebfb4", ACCENT)
    return figure


def filled(axes, places, triangles, fill, edge):
    """Draw triangles filled."""
    corners = places[triangles][:, :, :2]
    axes.add_collection(PolyCollection(corners, facecolors=fill, edgecolors=edge, linewidths=0.6))
    axes.autoscale_view()


def swaps():
    """Draw the triangulation of the parameters on the scan, and after swaps."""
    points, disc = face()
    star = pc.nearest(points, 20)
    circle = pc.chord_length_on_circle(points, disc.loop)
    first = pc.parameterize(points, disc.loop, circle, star, weights=pc.reciprocal_distance)
    before = pc.triangulate(first.uv, disc.loop)
    after = pc.swap_to_delaunay(points, before)
    places = turned(points, 24, -8)
    edges = [{tuple(sorted((t[k], t[k - 1]))) for t in m.tolist() for k in range(3)} for m in (before, after.triangles)]
    figure, axes = panels(2, "Delaunay in the plane", f"{after.n_swaps} edges swapped in space", width=9.6)
    for panel, mine, other, color in zip(axes, edges, edges[::-1], (ACCENT, STEEL), strict=True):
        for some, shade, width in ((mine & other, "#9fb0b5", 0.4), (mine - other, color, 1.1)):
            panel.add_collection(LineCollection(places[np.array(sorted(some)), :2], colors=shade, linewidths=width))
        panel.set(xlim=(-0.5, 0.62), ylim=(-0.75, 0.37))
    return figure


def chart():
    """Draw the three one-to-one charts of a cap beyond the half sphere."""
    points = shapes.hemisphere(1600, angle=140).points
    names = ("scan", "mesh", "low-stretch", "free")
    rules = (pc.uv_on_mesh, pc.uv_low_stretch, pc.uv_free_boundary)
    figure, axes = panels(4, *names, width=12.0)
    tilted = turned(points, 0, -65)
    discs = [pc.reconstruct(points, chart=rule) for rule in rules]
    shaded(axes[0], tilted, discs[0].triangles)
    for panel, disc in zip(axes[1:], discs, strict=True):
        wires(panel, disc.uv, disc.triangles, width=0.3)
        ring(panel, disc.uv[disc.loop])
    return figure


def certificate():
    """Draw a disc, and what is none: a pinch, a hole, a fold of the parameters."""
    square = np.array([[x, y] for y in range(5) for x in range(5)], float)
    cells = [(x + 5 * y, x + 1 + 5 * y, x + 6 + 5 * y, x + 5 + 5 * y) for y in range(4) for x in range(4)]
    whole = np.array([t for a, b, c, d in cells for t in ((a, b, c), (a, c, d))])
    holed = np.array([t for t in whole.tolist() if 12 not in t])
    corners = [cells[k] for k in (0, 1, 4, 5, 10, 11, 14, 15)]
    pinched = np.array([t for a, b, c, d in corners for t in ((a, b, c), (a, c, d))])
    folded = square.copy()
    folded[12] = [3.35, 2.6]
    titles = ("a disc", "Euler characteristic 0", "a pinch: two fans", "folded in the plane")
    figure, axes = panels(4, *titles, width=11.0)
    meshes = (square, whole), (square, holed), (square, pinched), (folded, whole)
    for panel, (places, triangles) in zip(axes, meshes, strict=True):
        filled(panel, places, triangles, "#e7ecec", INK)
        panel.set(xlim=(-0.2, 4.2), ylim=(-0.2, 4.2))
    ring(axes[1], square[[6, 7, 13, 18, 17, 11]], width=2)
    axes[2].plot(*square[12], "o", color=ACCENT, markersize=9)
    one, other = folded[whole[:, 1]] - folded[whole[:, 0]], folded[whole[:, 2]] - folded[whole[:, 0]]
    turned_over = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0] <= 0
    filled(axes[3], folded, whole[turned_over], "#eebfb4cc", ACCENT)
    return figure


def surface():
    """Draw a noisy scan, the surface with its knots, and the deviations."""
    scan = shapes.add_noise(shapes.pierce(shapes.relief(3000, seed=5), n_gaps=1, seed=3), sigma_in_spacings=0.1, seed=1)
    fitted = pc.fit_scan(scan.points, tolerance=0.012, gaps=pc.leave_gaps_open)
    fit, points = fitted.fit, scan.points[fitted.reconstruction.rows]
    figure, (left, middle, right) = panels(3, "scan", "knots and trimming loops", "deviations", width=11.0)
    shaded(left, turned(points, 0, -35), fitted.reconstruction.triangles)
    (low_u, low_v), (high_u, high_v) = fit.surface.domain
    for knots, low, high, is_u in (
        (fit.surface.knots_u, low_v, high_v, True),
        (fit.surface.knots_v, low_u, high_u, False),
    ):
        for knot in np.unique(knots):
            ends = ([knot, knot], [low, high]) if is_u else ([low, high], [knot, knot])
            middle.plot(*ends, color="#9fb0b5", linewidth=0.5)
    for number, loop in enumerate(fitted.loops):
        ring(middle, loop, color=INK if number else ACCENT)
    most = float(np.abs(fitted.deviation.signed).max())
    drawn = right.scatter(*fit.uv.T, s=5, c=fitted.deviation.signed, cmap=SIGNED, vmin=-most, vmax=most)
    bar = figure.colorbar(drawn, ax=right, shrink=0.7)
    bar.ax.tick_params(labelsize=7, colors=INK)
    bar.outline.set_visible(False)
    return figure


def half_edges():
    """Draw the half-edges of a small mesh by their numbers, and what one of them leads to."""
    places = np.array([[0, 0], [2, 0.1], [3.1, 1.7], [1.3, 1.5], [-0.3, 2.3], [2.3, 2.9]])
    triangles = np.array([[0, 1, 3], [1, 2, 3], [3, 2, 5], [3, 4, 0]])
    edges = pair(triangles, len(places))
    titles = "half-edge 3 t + k leaves corner k of triangle t", "what a half-edge h leads to"
    figure, (left, right) = panels(2, *titles, width=10.0, height=4.9)
    middles = places[triangles].mean(axis=1)
    for panel in (left, right):
        filled(panel, places, triangles, "#eef2f2", "#9fb0b5")
        panel.scatter(*places.T, s=260, c=PAPER, edgecolors=INK, linewidths=1.0, zorder=3)
        for v, place in enumerate(places):
            panel.text(*place, str(v), ha="center", va="center", color=INK, fontsize=10, zorder=4)
        panel.set(xlim=(-0.55, 3.4), ylim=(-0.3, 3.2))
    for t, middle in enumerate(middles):
        left.text(*middle, f"t = {t}", ha="center", va="center", color="#7b8790", fontsize=9)
    for h, twin in enumerate(edges.twins):
        _half_edge(left, places, middles, edges, h, INK if twin >= 0 else ACCENT, str(h))
    h = 5
    names = [(h, "h"), (3, "following(h)"), (4, "preceding(h)")]
    names += [(int(edges.twins[h]), "twins[h]"), (int(edges.twins[4]), "twins[preceding(h)]")]
    for number, words in names:
        _half_edge(right, places, middles, edges, number, ACCENT if number == h else INK, words)
    return figure


def _half_edge(axes, places, middles, edges, h, color, words):
    """Draw an arrow beside the edge, within the half-edge's triangle, and words beside the arrow."""
    middle = middles[h // 3]
    tail, head = (0.8 * places[ends[h]] + 0.2 * middle for ends in (edges.origins, edges.targets))
    tail, head = 0.85 * tail + 0.15 * head, 0.15 * tail + 0.85 * head
    axes.annotate("", head, tail, arrowprops={"arrowstyle": "-|>", "color": color, "shrinkA": 0, "shrinkB": 0})
    at = 0.5 * (tail + head)
    inwards = (middle - at) / np.linalg.norm(middle - at)
    angle = np.degrees(np.arctan2(*(head - tail)[::-1])) if len(words) > 2 else 0.0
    angle -= 180.0 * (abs(angle) > 90.0) * np.sign(angle)
    axes.text(*(at + 0.13 * inwards), words, ha="center", va="center", color=color, fontsize=9, rotation=angle)


PICTURES = {
    "prepare": prepare,
    "neighbourhoods": neighborhoods,
    "found": boundary,
    "map": map_,
    "assemble": assemble,
    "swaps": swaps,
    "chart": chart,
    "certificate": certificate,
    "surface": surface,
    "half_edges": half_edges,
}
NO_STAGES = {"half_edges"}


def main(folder: Path, *only: str) -> None:
    """Draw all pictures, or some, in 128 colours."""
    from PIL import Image

    for name in only or PICTURES:
        figure = PICTURES[name]()
        path = folder / (f"{name}.png" if name in NO_STAGES else f"stage_{name}.png")
        figure.savefig(path, dpi=120, facecolor=PAPER)
        plt.close(figure)
        Image.open(path).convert("RGB").quantize(128, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(
            path, optimize=True
        )
        print(path, f"{path.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]), *sys.argv[2:])
