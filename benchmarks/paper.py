"""Repeat the experiments of Floater and Reimers 2001, section 5, and print ours beside the printed numbers.

    python benchmarks/paper.py [--data DIR] [--rotations 24] [--write docs/paper.md]

The scans lie beside the checkout, in ../shared/data; where they are missing, simulated scans take their place and only
the form of the tables can be compared.
"""

import argparse
import os
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

# One thread: Bi-CGSTAB's dot products then round alike on every run, and so do its counts.
os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
import scipy.sparse as sp
from paper_scans import DATA, METHODS, PAPER, TOLERANCE, Run, Scan, from_truth, load_scans, run, stars
from scipy.spatial import cKDTree

from pointchart.boundary.layout import on_circle
from pointchart.boundary.steps import chord_length_steps
from pointchart.mesh.connectivity import half_edges
from pointchart.mesh.delaunay_swaps import swap_to_delaunay
from pointchart.mesh.distortion import least_distance
from pointchart.mesh.planar_delaunay import triangulate
from pointchart.points.neighbors import ball, spacing
from pointchart.proof.certificate import certify
from pointchart.shapes import Shape, add_noise
from pointchart.solve.krylov import bicgstab
from pointchart.solve.solver import Solved
from pointchart.solve.systems import solve_fixed
from pointchart.typing import UV, Floats, Indices, Loop, Points, Triangles

COINCIDENT = 1e-14  # parameters nearer than this differ by rounding only


@dataclass(frozen=True, slots=True, eq=False)
class Study:
    """All scans, all runs by scan and method, and how many starting angles the counts are spread over."""

    scans: dict[str, Scan]
    runs: dict[tuple[str, str], Run]
    rotations: int


def table_1(study: Study) -> str:
    rows = []
    for label, scan in study.scans.items():
        printed = PAPER[label]
        sides = " x ".join(f"{side:.3g}" for side in printed.dimensions)
        rows.append((label, "paper", printed.n_points, sides, f"{printed.radius:g}", ""))
        sides = " x ".join(f"{side:.3g}" for side in np.ptp(scan.points, axis=0))
        in_spacings = scan.radius / np.median(spacing(scan.points))
        rows.append(("", scan.name, len(scan.points), sides, f"{scan.radius:.3g}", f"{in_spacings:.2f}"))
    return markdown(("Data set", "", "N", "dimensions", "r", "r / median spacing"), rows)


def table_2(study: Study) -> str:
    return table_of_method("2", study)


def table_3(study: Study) -> str:
    return table_of_method("3", study)


def other_methods(study: Study) -> str:
    uniform_balls, on_stars = (table_of_method(method, study) for method in ("1", "reciprocal on Delaunay"))
    return f"Method 1:\n\n{uniform_balls}\n\nReciprocal distance on Delaunay neighbourhoods:\n\n{on_stars}"


def table_of_method(method: str, study: Study) -> str:
    rows: list[tuple[object, ...]] = []
    for label, scan in study.scans.items():
        printed, found = PAPER[label], study.runs[label, method]
        if method in printed.iterations:
            low, high = printed.sizes[method]
            counts, seconds = printed.iterations[method], printed.seconds[method]
            rows.append((label, "paper", low, high, "", both(counts, "d"), both(seconds, ".2f")))
        inner = found.inner_sizes
        every = f"{found.sizes.min()}..{found.sizes.max()}"
        first = "" if method in printed.iterations else label
        counted, timed = both(found.iterations, "d"), both(found.seconds, ".2f")
        rows.append((first, scan.name, inner.min(), inner.max(), every, counted, timed))
    head = ("Data set", "", "min N_i", "max N_i", "of all points", "iterations", "seconds")
    return markdown(head, rows)


def distinct_points(study: Study) -> str:
    rows = []
    for label, scan in study.scans.items():
        printed = PAPER[label]
        for method in METHODS:
            uv = study.runs[label, method].uv
            merged = equal_neighborhoods(scan) if method == "1" else ""
            order = printed.least_distance if method in ("2", "3") else ""
            theirs = f"{printed.distinct[method]} of {printed.n_points}" if method in printed.distinct else ""
            ours = f"{distinct(uv)} of {len(uv)}"
            rows.append((label, method, theirs, ours, merged, order, f"{least_distance(uv):.1e}"))
    head = (
        "Data set",
        "method",
        "distinct, paper",
        "distinct",
        "merged by Prop. 4.1",
        "least distance, paper",
        "least",
    )
    return markdown(head, rows)


def distinct(uv: UV) -> int:
    """Count the parameter points that differ by more than rounding."""
    pairs = cKDTree(uv).query_pairs(COINCIDENT, output_type="ndarray")
    graph = sp.coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(uv), len(uv)))
    return int(sp.csgraph.connected_components(graph, directed=False)[0])


def equal_neighborhoods(scan: Scan) -> int:
    """Count the interior points whose ball holds exactly the points of another one's (4.3)."""
    around = ball(scan.points, scan.radius)
    name = np.random.default_rng(0).integers(1 << 62, size=len(scan.points))
    held = name.copy()
    np.add.at(held, around.rows, name[around.indices])
    inner = np.setdiff1d(np.arange(len(scan.points)), scan.loop)
    return len(inner) - len(np.unique(held[inner]))


def spread(study: Study) -> str:
    """Count iterations on the bunny over the choices that the paper leaves open."""
    rows = []
    for method in ("2", "3"):
        for choice, counted in open_choices(study.scans["Bunny"], method, study.rotations):
            counts = np.fromiter(counted, np.int64)
            low, middle, high = counts.min(), np.median(counts), counts.max()
            below = " / ".join(f"{np.mean(counts < theirs):.0%}" for theirs in PAPER["Bunny"].iterations[method])
            rows.append((method, choice, len(counts), low, f"{middle:g}", high, below))
    printed = [both(PAPER["Bunny"].iterations[method], "d") for method in ("2", "3")]
    last = f"share below the paper's ({printed[0]}; {printed[1]})"
    return markdown(("method", "varied", "systems", "min", "median", "max", last), rows)


def open_choices(scan: Scan, method: str, rotations: int) -> Iterable[tuple[str, Iterable[int]]]:
    """Name each choice that the paper leaves open, with the counts over it; every one also turns the boundary."""
    gather, weights = METHODS[method]
    around = gather(scan.points, scan.radius)
    points, rim, n, few = scan.points, scan.loop, len(scan.points), max(1, rotations // 4)
    matrix = sp.csr_array((weights(points, around), around.indices, around.indptr), shape=(n, n))
    yield "the angle at which the boundary starts", iterations(matrix, points, rim, rotations)
    rng = np.random.default_rng(0)
    shuffles, axes = [rng.permutation(n) for _ in range(3)], [np.argsort(points[:, k]) for k in range(3)]
    yield "points shuffled", reordered(matrix, points, rim, max(1, few // 3), shuffles)
    yield "points sorted along x, y, z", reordered(matrix, points, rim, max(1, few // 3), axes)
    start = rng.uniform(-1.0, 1.0, n - len(rim))
    yield "started at random in the square", iterations(matrix, points, rim, few, start=start)
    yield "started at (1, 1)", iterations(matrix, points, rim, few, start=np.ones_like(start))
    found = rim[stars(points, scan.radius).is_open[rim]]
    if len(found) >= 3:
        yield f"boundary of the {len(found)} points that the hull test finds", iterations(matrix, points, found, few)
    for tolerance in (1e-8, 1e-9, 1e-11, 1e-12):
        yield (
            f"residual {tolerance:.0e}".replace("e-0", "e-"),
            iterations(matrix, points, rim, few, tolerance=tolerance),
        )


def iterations(
    matrix: sp.csr_array,
    points: Points,
    loop: Loop,
    rotations: int,
    *,
    tolerance: float = TOLERANCE,
    start: Floats | None = None,
) -> tuple[int, ...]:
    """Count Bi-CGSTAB's steps for both coordinates, the boundary turned through a quarter circle."""
    circle = on_circle(chord_length_steps(points, loop))
    turns = np.arange(rotations) * (0.5 * np.pi / rotations)
    layouts = [circle @ np.array([[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]]) for t in turns]

    def solver(left: sp.csr_array, right: Floats) -> Solved:
        starts = None if start is None else np.repeat(start[:, None], right.shape[1], axis=1)
        return bicgstab(left, right, tolerance=tolerance, start=starts)

    return solve_fixed(matrix, loop, np.hstack(layouts), solver=solver).iterations


def reordered(matrix: sp.csr_array, points: Points, loop: Loop, rotations: int, orders: list[Indices]) -> Iterable[int]:
    for order in orders:
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        yield from iterations(matrix[order][:, order], points[order], place[loop], rotations)


def noise(study: Study) -> str:
    """Add noise to the head, mesh it by method 2, and compare with the true mesh swapped on the same noisy points."""
    head, rows = study.scans["Spock"], []
    for sigma in (0.0, 0.1, 0.25, 0.5):
        clean = Shape(head.points, head.truth, np.zeros((len(head.points), 2)))
        noisy = add_noise(clean, sigma_in_spacings=sigma).points
        best = swap_to_delaunay(noisy, head.truth).triangles
        scan = from_truth(head.label, head.name, noisy, head.loop, best, head.radius)
        rows.append((f"{sigma:g}", *mesh_by_method_2(scan)))
    columns = ("noise / spacing", "iterations", "Delaunay: true edges", "swapped: true edges", "disc", "longest edge")
    return markdown((*columns, "folds"), rows)


def mesh_by_method_2(scan: Scan) -> tuple[object, ...]:
    found = run(scan, "2")
    triangles = triangulate(found.uv, scan.loop)
    swapped = swap_to_delaunay(scan.points, triangles).triangles
    proof = certify(scan.points, swapped, loop=scan.loop)
    share = (f"{shared_edges(t, scan.truth, len(scan.points)):.3f}" for t in (triangles, swapped))
    longest = f"{proof.longest_edge_over_spacing:.1f} spacings"
    return (both(found.iterations, "d"), *share, "yes" if proof.is_disc else "no", longest, proof.folds)


def shared_edges(triangles: Triangles, truth: Triangles, n_points: int) -> float:
    """Measure which share of a mesh's edges another one has."""
    return float(np.isin(edge_names(triangles, n_points), edge_names(truth, n_points)).mean())


def edge_names(triangles: Triangles, n_points: int) -> Indices:
    edges = half_edges(triangles, n_points)
    low, high = np.minimum(edges.origins, edges.targets), np.maximum(edges.origins, edges.targets)
    return np.unique(low * n_points + high)


def both(pair: Iterable[float], form: str) -> str:
    return " / ".join(format(value, form) for value in pair)


def markdown(head: tuple[str, ...], rows: Iterable[tuple[object, ...]]) -> str:
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


QUESTIONS = {
    "Table 1": table_1,
    "Table 2": table_2,
    "Table 3": table_3,
    "Other methods": other_methods,
    "Distinct points": distinct_points,
    "Spread of the counts": spread,
    "Noise": noise,
}


def write_into(page: Path, answers: dict[str, str]) -> None:
    """Replace what stands between the marker comments of each table."""
    text = page.read_text(encoding="utf-8")
    for name, table in answers.items():
        begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
        before, _, rest = text.partition(begin)
        _, found, after = rest.partition(end)
        if not found:
            sys.exit(f"{page} has no markers '{begin}' ... '{end}'")
        text = f"{before}{begin}\n\n{table}\n\n{end}{after}"
    page.write_text(text, encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=DATA, help="folder of the scans")
    parser.add_argument("--rotations", type=int, default=24, help="starting angles over which iterations are counted")
    parser.add_argument("--write", type=Path, metavar="PAGE", help="replace the tables of this page")
    options = parser.parse_args()
    scans = load_scans(options.data)
    runs = {(label, method): run(scan, method) for label, scan in scans.items() for method in METHODS}
    study, answers = Study(scans, runs, options.rotations), {}
    for name, question in QUESTIONS.items():
        answers[name] = question(study)
        print(f"## {name}\n\n{answers[name]}\n", flush=True)
    if options.write:
        write_into(options.write, answers)


if __name__ == "__main__":
    main()
