"""Find the boundaries of simulated scans whose truth is known: precision, recall and nearness of each method.

    python benchmarks/boundaries.py [--seeds 1 2]

Ten surfaces (reliefs, rolled sheets, caps beyond the half sphere, tubes, necks, scan lines, close sheets) with noise of
0 to half a spacing in each coordinate, densities of 1:1 to 1:10 (graded smoothly, to 1:40) and gaps, and closed
surfaces, rings, handles and one-sided strips, which have to be refused. A surface is wrong if more than 0.2% of its
edges join points that lie more than six mean edges apart on the true surface, or if its boundary is near the true one
for less than 80% of its length.
"""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from multiprocessing import Pool
from pathlib import Path

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from pointchart import (
    PointchartError,
    angular_gaps,
    delaunay_star,
    explore,
    find_boundary,
    hull_test,
    nearest,
    reconstruct,
    shapes,
)
from pointchart.gaps.rules import SECOND_BOUNDARY
from pointchart.look.run_pictures import draw_boundary
from pointchart.shapes import Shape
from pointchart.typing import Floats, Indices, Loop, Mask, Points, Triangles

N = 4000
FAR = 6.0  # mean edges
METHODS = ("hull test", "angular gap", "half disc", "scores", "loop")


def wave(s: Floats, t: Floats) -> Points:
    """Return a gentle wave over the unit square."""
    return np.stack([s, t, 0.1 * np.sin(5 * s) * np.cos(4 * t)], axis=-1)


SURFACES: dict[str, Callable[[int, int], Shape]] = {
    "relief": lambda n, seed: shapes.relief(n, seed=seed),
    "rolled disc": lambda n, seed: shapes.roll(shapes.disc(n, seed=seed), 270),
    "cap of 150 degrees": lambda n, seed: shapes.hemisphere(n, angle=150),
    "tube": lambda n, seed: shapes.tube(5, n_around=round((1.1 * n) ** 0.5)),
    "neck of 8 spacings": lambda n, seed: shapes.raise_bumps(shapes.dumbbell(n, neck=8), seed=seed),
    "neck of 5 spacings, rolled": lambda n, seed: shapes.roll(shapes.dumbbell(n, neck=5), 200),
    "face": lambda n, seed: shapes.laser_scan(shapes.sculpted_face, lines=round(n**0.5), seed=seed),
    "lines 3 steps apart": lambda n, seed: shapes.laser_scan(
        wave, lines=round((n / 3) ** 0.5), anisotropy=3, noise=0, seed=seed
    ),
    "lines 5 steps apart": lambda n, seed: shapes.laser_scan(
        shapes.sculpted_face, lines=round((n / 5) ** 0.5), anisotropy=5, noise=0, seed=seed
    ),
    "sheets 6 spacings apart": lambda n, seed: shapes.fold(6, nx=round(1.6 * n**0.5), ny=round(n**0.5 / 1.6)),
}
NO_DISCS: dict[str, Callable[[], Shape]] = {
    "sphere": lambda: shapes.sphere(N),
    "torus": shapes.torus,
    "torus with a gap": lambda: shapes.pierce(shapes.torus(), n_gaps=1),
    "ring": shapes.annulus,
    "Moebius strip": shapes.moebius,
    "wide Moebius strip": lambda: shapes.moebius(200, 24, width=0.7),
}


@dataclass(frozen=True)
class Case:
    """A simulated scan: what was done to which surface."""

    surface: str
    seed: int
    noise: float = 0.0
    density: float = 1.0
    n_gaps: int = 0
    grade: float = 1.0

    @property
    def row(self) -> str:
        """The row of the table that the case belongs to."""
        if self.surface in NO_DISCS:
            return "no disc"
        if self.grade > 1:
            return "density graded 1:3 to 1:40"
        parts = [f"density 1:{self.density:g}"] if self.density > 1 else []
        parts += ["gaps"] if self.n_gaps else []
        return ", ".join([*parts, f"noise {self.noise:g}"])

    def make(self) -> tuple[Shape, Shape]:
        """Return the true surface without noise, and the scan of it."""
        if self.surface in NO_DISCS:
            clean = NO_DISCS[self.surface]()
        elif self.grade > 1:
            flat = shapes.dumbbell(N) if self.surface == "neck" else shapes.disc(N, seed=self.seed)
            clean = shapes.raise_bumps(shapes.grade(flat, ratio=self.grade), seed=self.seed)
        else:
            clean = SURFACES[self.surface](2 * N if self.density > 1 else N, self.seed)
        if self.density > 1:
            clean = shapes.thin(clean, ratio=self.density, seed=self.seed)
        if self.n_gaps:
            radius = 4.0 + self.seed % 3
            clean = shapes.pierce(clean, n_gaps=self.n_gaps, radius_in_spacings=radius, seed=self.seed)
        clean = shapes.shuffle(clean, seed=self.seed)
        return clean, shapes.add_noise(clean, sigma_in_spacings=self.noise, seed=self.seed)


def cases(seeds: list[int]) -> Iterator[Case]:
    """Yield all cases."""
    for seed in seeds:
        for surface in SURFACES:
            yield from (Case(surface, seed, noise=noise) for noise in (0.0, 0.125, 0.25, 0.5))
            yield Case(surface, seed, n_gaps=3)
            yield Case(surface, seed, n_gaps=3, noise=0.25)
            # Thinned lines 5 steps apart, and close sheets thinned 1:10, are no sampling of their surfaces any more.
            if surface != "lines 5 steps apart":
                yield Case(surface, seed, density=3.0)
            if surface not in ("lines 5 steps apart", "sheets 6 spacings apart"):
                yield Case(surface, seed, density=10.0)
                yield Case(surface, seed, density=10.0, n_gaps=3, noise=0.125)
        for kind in ("disc", "neck"):
            yield from (Case(kind, seed, grade=ratio) for ratio in (3.0, 10.0, 40.0))
        for surface in NO_DISCS:
            yield from (Case(surface, seed, noise=noise) for noise in (0.0, 0.125, 0.25, 0.5))


def spacing_of(shape: Shape) -> Floats:
    """Return the mean length of the true edges at each point."""
    ends = shape.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    length = np.linalg.norm(shape.points[ends[:, 1]] - shape.points[ends[:, 0]], axis=1)
    n = len(shape.points)
    return np.asarray(np.bincount(ends.ravel(), np.repeat(length, 2), n) / np.bincount(ends.ravel(), minlength=n))


def nearness(points: Points, spacing: Floats, found: Loop, true: Loop) -> float:
    """Return the harmonic mean of the shares of each loop's length that lie within two spacings of the other loop."""

    def samples(loop: Loop) -> tuple[Points, Floats, Floats]:
        start, end = points[loop], points[np.roll(loop, -1)]
        length = np.linalg.norm(end - start, axis=1)
        count = np.ceil(4.0 * length / spacing[loop]).astype(np.int64).clip(1, 400)
        edge = np.repeat(np.arange(len(loop)), count)
        place = (np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[edge]
        return start[edge] + place[:, None] * (end - start)[edge], (length / count)[edge], spacing[loop][edge]

    (p, p_length, p_step), (q, q_length, q_step) = samples(found), samples(true)
    precision = p_length[cKDTree(q).query(p)[0] <= 2.0 * p_step].sum() / p_length.sum()
    recall = q_length[cKDTree(p).query(q)[0] <= 2.0 * q_step].sum() / q_length.sum()
    return float(2.0 * precision * recall / max(precision + recall, 1e-12))


def share_of_far_edges(clean: Shape, triangles: Triangles) -> float:
    """Return the share of a mesh's edges whose ends are far apart on the true surface, but for those round gaps."""
    n, spacing = len(clean.points), spacing_of(clean)
    true = clean.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    length = np.linalg.norm(clean.points[true[:, 1]] - clean.points[true[:, 0]], axis=1)
    graph = sp.coo_array((length, (true[:, 0], true[:, 1])), shape=(n, n)).tocsr()
    graph = graph.maximum(graph.T).tocsr()
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    by_gap = np.zeros(n)
    for rim in clean.loops[1:]:
        by_gap[rim] = 1.0
    by_gap = by_gap + (graph > 0) @ by_gap
    steps = ((graph > 0) + sp.eye_array(n, format="csr")).astype(np.float64)
    near = steps @ steps @ steps
    suspects = edges[np.asarray(near[edges[:, 0], edges[:, 1]]).ravel() == 0]
    suspects = suspects[(by_gap[suspects] == 0).any(axis=1)]
    if len(suspects) == 0:
        return 0.0
    origins, place = np.unique(suspects[:, 0], return_inverse=True)
    apart = sp.csgraph.dijkstra(graph, directed=False, indices=origins)[place.ravel(), suspects[:, 1]]
    return float((apart > FAR * spacing[suspects].max(axis=1)).sum() / len(edges))


def precision_and_recall(found: Mask, true: Mask) -> tuple[float, float]:
    """Return the shares of the points found that are true, and of the true ones that are found."""
    return float((found & true).sum() / max(found.sum(), 1)), float((found & true).sum() / max(true.sum(), 1))


def marked(indices: Indices, n: int) -> Mask:
    """Return a mask of the points named."""
    mask = np.zeros(n, np.bool_)
    mask[indices] = True
    return mask


def detect(shape: Shape) -> list[tuple[float, float]]:
    """Return precision and recall of each method."""
    points, n = shape.points, len(shape.points)
    every, outer = marked(np.concatenate(shape.loops), n), marked(shape.loops[0], n)
    vicinity = explore(points)
    try:
        found = find_boundary(points, vicinity=vicinity)
    except PointchartError:
        return [(0.0, 0.0)] * len(METHODS)
    masks = (
        hull_test(delaunay_star(points, vicinity.around)),
        angular_gaps(points, nearest(points, 30)) > np.pi / 2,
        found.scores.half_disc >= 0.5,
        found.scores.is_boundary,
    )
    return [*(precision_and_recall(mask, every) for mask in masks), precision_and_recall(marked(found.loop, n), outer)]


def run(case: Case) -> tuple[Case, str, float, list[tuple[float, float]]]:
    """Reconstruct a case; return it with a verdict, its nearness and what the methods detect."""
    clean, scan = case.make()
    detected = detect(scan) if case.surface not in NO_DISCS else []
    try:
        result = reconstruct(scan.points)
    except PointchartError as refusal:
        print(f"{case}: {refusal}", flush=True)
        lengths = [np.linalg.norm(np.diff(clean.points[np.append(r, r[0])], axis=0), axis=1).sum() for r in clean.loops]
        has_second = len(lengths) > 1 and max(lengths[1:]) >= SECOND_BOUNDARY * lengths[0]
        is_right = case.surface in NO_DISCS or (has_second and "second boundary" in str(refusal))
        return case, "refused, rightly" if is_right else "refused", 0.0, detected
    if case.surface in NO_DISCS:
        print(f"{case}: ACCEPTED", flush=True)
        return case, "wrong", 0.0, []
    near = nearness(scan.points, spacing_of(clean), result.loop, clean.loops[0])
    far = share_of_far_edges(clean, result.triangles)
    if near < 0.95 or far > 0:
        print(f"{case}: near {near:.3f}, far edges {far:.4f}", flush=True)
    return case, "wrong" if near < 0.8 or far > 0.002 else "disc", near, detected


def draw_one(path: Path) -> None:
    """Draw what is found on a face with gaps."""
    points = Case("face", seed=3, noise=0.125, n_gaps=3).make()[1].points
    found = find_boundary(points)
    draw_boundary(path, points, found.scores.total, [candidate.loop for candidate in found.candidates])
    print(path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2], help="of the simulations")
    parser.add_argument("--picture", type=Path, help="only draw the boundary and the gaps of one of them")
    options = parser.parse_args()
    if options.picture is not None:
        draw_one(options.picture)
        return
    with Pool(2) as pool:
        results = pool.map(run, list(cases(options.seeds)), chunksize=4)
    rows = list(dict.fromkeys(case.row for case, *_ in results))
    print(f"\n{len(results)} cases\n")
    print("| what | cases | disc | refused, rightly | refused | wrong | near, mean | near, least |")
    print("|---|---|---|---|---|---|---|---|")
    for row in [*rows, "all"]:
        of_it = [r for r in results if row in (r[0].row, "all")]
        near = [r[2] for r in of_it if r[1] in ("disc", "wrong") and r[0].surface not in NO_DISCS]
        counts = [sum(r[1] == verdict for r in of_it) for verdict in ("disc", "refused, rightly", "refused", "wrong")]
        means = f"{np.mean(near):.3f} | {min(near):.3f}" if near else " | "
        print(f"| {row} | {len(of_it)} | {' | '.join(map(str, counts))} | {means} |")
    print(f"\n| precision / recall | {' | '.join(METHODS)} |\n|---|{'---|' * len(METHODS)}")
    for row in [*rows, "all"]:
        of_it = [r[3] for r in results if row in (r[0].row, "all") and r[3]]
        if of_it:
            print(f"| {row} | {' | '.join(f'{p:.2f} / {r:.2f}' for p, r in np.mean(of_it, axis=0))} |")


if __name__ == "__main__":
    main()
