"""The paper's three data sets, or what is nearest to them, its printed numbers, and its methods run on them."""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import numpy as np
import scipy.sparse as sp

from pointchart.boundary.layout import on_circle
from pointchart.boundary.steps import chord_length_steps
from pointchart.errors import InputError
from pointchart.io import read_loop, read_scan
from pointchart.map.convex_combination import parameterize
from pointchart.map.weights import WeightScheme, reciprocal_distance, shape_preserving, uniform
from pointchart.points.neighborhoods import Neighborhoods
from pointchart.points.neighbors import ball
from pointchart.points.stars import delaunay_star
from pointchart.shapes import hemisphere, sculpture, tube
from pointchart.solve.krylov import bicgstab
from pointchart.solve.reach import cut_points
from pointchart.solve.solver import Solved, Solver
from pointchart.typing import UV, Floats, Indices, Loop, Points, Triangles

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
TOLERANCE = 1e-10  # the paper does not print its own


@dataclass(frozen=True, slots=True)
class Printed:
    """One data set's rows of the paper's tables; `iterations`, `seconds` and `sizes` by method."""

    n_points: int
    dimensions: tuple[float, float, float]
    radius: float
    sizes: dict[str, tuple[int, int]]
    iterations: dict[str, tuple[int, int]]
    seconds: dict[str, tuple[float, float]]
    distinct: dict[str, int]
    least_distance: str


PAPER = {
    "Foot": Printed(
        5092,
        (98.7, 245, 203),
        9.0,
        {"2": (6, 27), "3": (3, 9)},
        {"2": (137, 150), "3": (230, 240)},
        {"2": (2.08, 2.30), "3": (0.84, 0.87)},
        {"1": 5091, "2": 5092, "3": 5092},
        "1e-5",
    ),
    "Spock": Printed(
        9508,
        (0.69, 0.80, 0.68),
        0.03,
        {"2": (3, 29), "3": (3, 9)},
        {"2": (180, 170), "3": (303, 286)},
        {"2": (6.81, 6.36), "3": (4.52, 4.45)},
        {"1": 9508, "2": 9508, "3": 9508},
        "1e-4",
    ),
    "Bunny": Printed(
        30571,
        (0.16, 0.15, 0.12),
        0.003,
        {"2": (4, 24), "3": (3, 9)},
        {"2": (466, 406), "3": (635, 589)},
        {"2": (52.71, 45.92), "3": (40.44, 37.57)},
        {"1": 30568, "2": 30571, "3": 30571},
        "1e-7",
    ),
}
SOURCES = {"Foot": "foot5k", "Spock": "demosthenes", "Bunny": "bunny30571"}


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """A data set with its boundary, the ball's radius and the true mesh."""

    label: str
    name: str
    points: Points
    loop: Loop
    radius: float
    truth: Triangles


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """What one method did to one scan."""

    sizes: Indices
    inner_sizes: Indices
    iterations: tuple[int, ...]
    seconds: tuple[float, ...]
    uv: UV


def stars(points: Points, radius: float) -> Neighborhoods:
    return delaunay_star(points, ball(points, radius))


METHODS: dict[str, tuple[Callable[[Points, float], Neighborhoods], WeightScheme]] = {
    "1": (ball, uniform),
    "2": (ball, reciprocal_distance),
    "3": (stars, shape_preserving),
    "reciprocal on Delaunay": (stars, reciprocal_distance),
}


def load_scans(data: Path) -> dict[str, Scan]:
    """Read the paper's three data sets, or what is nearest to them."""
    if (data / SOURCES["Bunny"]).is_dir():
        return {label: read_one(data, name, label) for label, name in SOURCES.items()}
    print(f"{data} holds no scans: simulated ones take their place\n", file=sys.stderr)
    shapes = {"Foot": tube(16, n_around=40), "Spock": sculpture(9508), "Bunny": hemisphere(30571, angle=150)}
    return {
        label: from_truth(label, "simulated", s.points, s.boundary, s.triangles, 2.1 * s.spacing)
        for label, s in shapes.items()
    }


def read_one(data: Path, name: str, label: str) -> Scan:
    """Read one scan; its radius is the paper's in proportion to the longest side, for the same bunny the paper's."""
    points = read_scan(data / name / "points.ply").points
    loop = read_loop(data / name / "boundary.txt")
    printed = PAPER[label]
    scale = 1.0 if label == "Bunny" else np.ptp(points, axis=0).max() / max(printed.dimensions)
    truth = read_scan(data / name / "reference.ply").triangles
    return from_truth(label, name, points, loop, truth, scale * printed.radius)


def from_truth(label: str, name: str, points: Points, loop: Loop, truth: Triangles, radius: float) -> Scan:
    """Grow the radius by tenths until every interior point reaches the boundary, and not through one point alone."""
    while hangs(points, loop, radius):
        radius *= 1.1
        print(f"{label}: points hang or are alone; the radius grows to {radius:.4g}", file=sys.stderr)
    return Scan(label, name, points, loop, radius, truth)


def hangs(points: Points, loop: Loop, radius: float) -> bool:
    try:
        around = ball(points, radius)
    except InputError:
        return True
    return bool((cut_points(around, loop) != -1).any() or (cut_points(delaunay_star(points, around), loop) != -1).any())


def run(scan: Scan, method: str) -> Run:
    """Parameterize over the unit circle, by chord length, with the plain Bi-CGSTAB of the paper."""
    gather, weights = METHODS[method]
    around = gather(scan.points, scan.radius)
    is_inner = np.ones(len(scan.points), bool)
    is_inner[scan.loop] = False
    seconds: list[float] = []
    layout = on_circle(chord_length_steps(scan.points, scan.loop))
    found = parameterize(scan.points, scan.loop, layout, around, weights=weights, solver=timed_bicgstab(seconds))
    return Run(around.sizes, around.sizes[is_inner], found.solution.iterations, tuple(seconds), found.uv)


def timed_bicgstab(seconds: list[float]) -> Solver:
    """Solve as the paper does, and note the time of each right side."""

    def solver(left: sp.csr_array, right: Floats) -> Solved:
        columns, counts = [], []
        for column in right.T:
            start = perf_counter()
            solution, count = bicgstab(left, column[:, None], tolerance=TOLERANCE)
            seconds.append(perf_counter() - start)
            columns.append(solution)
            counts.extend(count)
        return np.hstack(columns), tuple(counts)

    return solver
