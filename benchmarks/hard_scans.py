"""Mesh simulated scans that are hard: long tubes, close sheets, noise, scan lines, uneven density.

    python benchmarks/hard_scans.py [--seeds 20] [--no-boundary]

Each row of the table is one kind of scan of 1,000 to 3,000 points, with the true boundary given, in as many seeds of
its jitter, noise, numbering and rotation. *Edges* is the F1 measure of the edges of the certified meshes against those
of the true mesh after edge swaps on the points of the scan; *longest edge* is the worst of them, in local spacings.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import log, radians
from multiprocessing import Pool

import numpy as np
from scipy.spatial.transform import Rotation

from pointchart import PointchartError, reconstruct, shapes, swap_to_delaunay
from pointchart.shapes import Shape
from pointchart.typing import Floats, Indices, Points, Triangles

N = 2000
JITTER = 0.3  # largest share of the way to the far side of a triangle


@dataclass(frozen=True)
class Case:
    """A row of the table: how to make the surface of a seed, and the noise of the scan in spacings."""

    row: str
    make: Callable[[int], Shape]
    noise: float = 0.0

    def scan(self, seed: int) -> Shape:
        """Return the scan of a seed, turned and renumbered."""
        shape = self.make(seed)
        if self.noise:
            shape = shapes.add_noise(shape, sigma_in_spacings=self.noise, seed=seed)
        shape = shapes.shuffle(shape, seed=seed)
        turn = Rotation.random(random_state=seed).as_matrix()
        return Shape(shape.points @ turn.T, shape.triangles, shape.uv)


def jitter(shape: Shape, seed: int) -> Shape:
    """Move each inner point into one of its true triangles, so that it stays on the surface."""
    rng = np.random.default_rng(seed)
    corners = rng.permutation(shape.triangles)
    corners = np.concatenate([np.roll(corners, turn, axis=1) for turn in range(3)])
    points, moved = shape.points, shape.points.copy()
    share = JITTER * np.sqrt(rng.random((len(corners), 1)))
    place = rng.random((len(corners), 1))
    opposite = place * points[corners[:, 1]] + (1 - place) * points[corners[:, 2]]
    # Of the triangles of a point, the last one counts.
    moved[corners[:, 0]] += share * (opposite - points[corners[:, 0]])
    moved[shape.boundary] = points[shape.boundary]
    return Shape(moved, shape.triangles, shape.uv)


def tube(length: float, seed: int) -> Shape:
    # A tube of fewer than 16 points around is hardly sampled.
    return jitter(shapes.tube(length, n_around=max(16, round((5.5 * N / (1 + length)) ** 0.5))), seed)


def fold(gap: float, seed: int) -> Shape:
    return jitter(shapes.fold(gap), seed)


def crease(angle: float, seed: int) -> Shape:
    """Crease a grid sharply along its middle: the sheets meet at an angle in degrees."""
    flat, half = shapes.grid(61, 31), radians(angle / 2)
    along = flat.points[:, 0] - 30
    points = np.c_[np.abs(along) * np.cos(half), flat.points[:, 1], along * np.sin(half)]
    return jitter(Shape(points, flat.triangles, flat.uv), seed)


def relief(seed: int) -> Shape:
    return shapes.relief(N, seed=seed)


def hemisphere(seed: int) -> Shape:
    return jitter(shapes.hemisphere(N), seed)


def lines(ratio: float, seed: int) -> Shape:
    n_lines = round((N / ratio) ** 0.5)
    return shapes.laser_scan(wave, lines=n_lines, anisotropy=ratio, unevenness=1, noise=0, seed=seed)


def wave(s: Floats, t: Floats) -> Points:
    """Return a gentle wave over the unit square."""
    return np.stack([s, t, 0.1 * np.sin(5 * s) * np.cos(4 * t)], axis=-1)


def graded(ratio: float, seed: int) -> Shape:
    return shapes.raise_bumps(shapes.grade(shapes.disc(N, seed=seed), ratio=ratio), seed=seed)


def thinned(ratio: float, seed: int) -> Shape:
    n = round(N * log(ratio) / (1 - 1 / ratio))
    return shapes.thin(shapes.relief(n, seed=seed), ratio=ratio, seed=seed)


CASES = [
    *(Case(f"tube, {length} radii long", partial(tube, length)) for length in (1, 5, 10, 20, 40, 60)),
    *(Case(f"fold, sheets {gap} spacings apart", partial(fold, gap)) for gap in (0.5, 1, 2, 3, 4)),
    *(Case(f"crease of {angle} degrees", partial(crease, angle)) for angle in (60, 30, 15)),
    *(Case(f"relief, noise {noise}", relief, noise) for noise in (0, 0.1, 0.2, 0.3, 0.5)),
    *(Case(f"hemisphere, noise {noise}", hemisphere, noise) for noise in (0, 0.1, 0.2, 0.3, 0.5)),
    *(Case(f"fold of 2 spacings, noise {noise}", partial(fold, 2), noise) for noise in (0.1, 0.2, 0.3, 0.5)),
    *(Case(f"fold of 4 spacings, noise {noise}", partial(fold, 4), noise) for noise in (0.1, 0.2, 0.3, 0.5)),
    *(Case(f"scan lines, steps 1:{ratio}", partial(lines, ratio)) for ratio in (1, 2, 5, 10)),
    *(Case(f"density graded 1:{ratio}", partial(graded, ratio)) for ratio in (1, 5, 10, 20, 40)),
    *(Case(f"density thinned 1:{ratio}", partial(thinned, ratio)) for ratio in (5, 10, 20, 40)),
]


@dataclass(frozen=True)
class Outcome:
    """What became of a scan: its measures, or why it was refused."""

    edges: float = np.nan
    longest_edge: float = np.nan
    refusal: str = ""


def edge_names(triangles: Triangles) -> Indices:
    """Return every edge once, as the number 2^32 low + high."""
    ends = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return np.unique((ends[:, 0] << 32) + ends[:, 1])


def run(task: tuple[int, int, bool]) -> Outcome:
    """Mesh the scan of a case and a seed, with its boundary given or not."""
    number, seed, is_given = task
    scan = CASES[number].scan(seed)
    try:
        result = reconstruct(scan.points, scan.boundary if is_given else None)
    except PointchartError as refusal:
        return Outcome(refusal=str(refusal))
    found = edge_names(result.rows[result.triangles])
    true = edge_names(swap_to_delaunay(scan.points, scan.triangles).triangles)
    edges = 2 * len(np.intersect1d(found, true)) / (len(found) + len(true))
    return Outcome(edges, result.certificate.longest_edge_over_spacing)


def table_row(name: str, outcomes: list[Outcome]) -> str:
    """Write the row of a case."""
    certified = [outcome for outcome in outcomes if not outcome.refusal]
    share = len(certified) / len(outcomes)
    cells = [name, f"{share:.2f}", f"{1 - share:.2f}", "", "", ""]
    if certified:
        edges = [outcome.edges for outcome in certified]
        longest = max(outcome.longest_edge for outcome in certified)
        cells[3:] = f"{np.mean(edges):.4f}", f"{min(edges):.4f}", f"{longest:.1f}"
    return f"| {' | '.join(cells)} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=20, help="how many of the simulations of each case")
    parser.add_argument("--no-boundary", action="store_true", help="have the boundary found")
    parser.add_argument("--verbose", action="store_true", help="say why scans are refused")
    options = parser.parse_args()
    tasks = [(k, seed, not options.no_boundary) for k in range(len(CASES)) for seed in range(options.seeds)]
    print("| scan | certified | refused | edges, mean | edges, least | longest edge |\n|---|---|---|---|---|---|")
    with Pool(2) as pool:
        results = pool.imap(run, tasks, chunksize=2)
        for case in CASES:
            outcomes = [next(results) for _ in range(options.seeds)]
            print(table_row(case.row, outcomes), flush=True)
            if options.verbose:
                refused = [f"{case.row}, seed {seed}: {o.refusal}" for seed, o in enumerate(outcomes) if o.refusal]
                print(*refused, sep="\n", end="\n" if refused else "", flush=True)


if __name__ == "__main__":
    main()
