"""Compare the edge swaps on surfaces with and without creases: which mesh is the nearest to it.

    python benchmarks/creases.py [--points 4000] [--seeds 1 2 3]

Three surfaces with sharp creases (a folded sheet, a stepped pyramid, a roof with a curved ridge) and three smooth ones
(a wave, a dome, a saddle) are sampled without a pattern, creases either by points on them or not at all, without noise
and with noise of 0.1 spacings in each coordinate. Distance and normal error are roots of mean squares over the area of
the mesh; the distance is in spacings. A fold is an edge at which the mesh turns back by more than 150 degrees. Times
are ratios to the Delaunay swaps alone, which come first in all but the first row.
"""

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from pointchart import (
    certify,
    keep_edges,
    radius_ratios,
    shapes,
    swap_to_delaunay,
    swap_to_least_curvature,
    swap_to_least_gaussian_curvature,
    swap_to_least_mean_curvature,
    swap_to_least_turn,
)
from pointchart.mesh.quality import area_vectors
from pointchart.shapes import Shape
from pointchart.shapes.planar import delaunay
from pointchart.typing import UV, Floats, Triangles

Field = Callable[[Floats, Floats], Floats]
TURN = 0.3  # of the creases against the axes, in radians
SWAPS = {
    "none": keep_edges,
    "delaunay": swap_to_delaunay,
    "normals": swap_to_least_turn,
    "mean-curvature": swap_to_least_mean_curvature,
    "gaussian-curvature": swap_to_least_gaussian_curvature,
    "curvature": swap_to_least_curvature,
}
STEP = 1e-6  # of differences
STEEP = np.tan(np.deg2rad(60.0))
SAMPLES = np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4], [2, 2, 2]]) / 6.0  # places in a triangle


@dataclass(frozen=True)
class Surface:
    """A height over the unit disc, and functions that are zero on its creases."""

    height: Field
    creases: tuple[Field, ...] = ()


def turned(field: Field) -> Field:
    """Turn a function of the plane, so that no crease runs along an axis."""
    return lambda x, y: field(np.cos(TURN) * x + np.sin(TURN) * y, np.cos(TURN) * y - np.sin(TURN) * x)


def sawtooth(x: Floats) -> Floats:
    """Return the signed distance to the nearest fold, 0.4 apart."""
    return np.asarray((x + 0.2) % 0.4 - 0.2)


def square(x: Floats, y: Floats) -> Floats:
    """Return the radius of the square about the origin that a place lies on."""
    return np.maximum(np.abs(x), np.abs(y))


def steps(x: Floats, y: Floats) -> Floats:
    """Return the height of two steps up to a square platform."""
    r = square(x, y)
    return np.asarray(-STEEP * (np.clip(r, 0.2, 0.3) + np.clip(r, 0.5, 0.6)))


def ridge(x: Floats, y: Floats) -> Floats:
    """Return the distance along x to a curve."""
    return np.asarray(x - 0.3 * np.sin(2.0 * y))


CREASED = (
    Surface(turned(lambda x, y: -np.abs(sawtooth(x))), (turned(lambda x, y: sawtooth(x)),)),
    Surface(turned(steps), tuple(turned(lambda x, y, r=r: square(x, y) - r) for r in (0.2, 0.3, 0.5, 0.6))),
    Surface(turned(lambda x, y: -np.abs(ridge(x, y))), (turned(ridge),)),
)
SMOOTH = (
    Surface(turned(lambda x, y: 0.1 * np.sin(5.0 * x) * np.cos(4.0 * y))),
    Surface(lambda x, y: np.sqrt(1.5 - x * x - y * y)),
    Surface(turned(lambda x, y: 0.5 * (x * x - y * y))),
)
KINDS = {
    "creased, points on the creases": (CREASED, True),
    "creased, no points on them": (CREASED, False),
    "smooth": (SMOOTH, False),
}


def slope(field: Field, uv: UV) -> Floats:
    """Return the gradient of a function of the plane, (n, 2)."""
    x, y = uv.T
    along_x, along_y = field(x + STEP, y) - field(x - STEP, y), field(x, y + STEP) - field(x, y - STEP)
    return np.asarray(np.column_stack([along_x, along_y]) / (2.0 * STEP))


def onto_creases(uv: UV, creases: tuple[Field, ...], spacing: float) -> UV:
    """Move points near a crease onto it, and leave out those that then are too near to others."""
    for crease in creases:
        steepness = slope(crease, uv)
        square_of_it = (steepness**2).sum(axis=1)
        is_near = np.abs(crease(*uv.T)) < 0.5 * spacing * np.sqrt(square_of_it)
        for _ in range(3):
            uv = uv - (is_near * crease(*uv.T) / square_of_it)[:, None] * steepness
    crowded = cKDTree(uv).query_pairs(0.4 * spacing, output_type="ndarray")
    return np.delete(uv, crowded[:, 1], axis=0)


def sample(surface: Surface, n: int, *, is_on_creases: bool, noise: float, seed: int) -> Shape:
    """Scan a surface, with the Delaunay triangulation of the plan for its mesh."""
    flat = shapes.disc(n, seed=seed)
    uv = onto_creases(flat.uv, surface.creases, flat.spacing) if is_on_creases else flat.uv
    points = np.column_stack([uv, surface.height(*uv.T)])
    return shapes.add_noise(Shape(points, delaunay(uv), uv), sigma_in_spacings=noise, seed=seed)


def errors(surface: Surface, shape: Shape, triangles: Triangles) -> tuple[float, float]:
    """Return the distance to the surface in spacings and the error of the normals in degrees."""
    vectors = area_vectors(shape.points, triangles)
    area = np.linalg.norm(vectors, axis=1)
    distance = angle = 0.0
    for place in SAMPLES:
        x, y, z = np.einsum("k,tkj->jt", place, shape.points[triangles])
        upward = np.column_stack([-slope(surface.height, np.column_stack([x, y])), np.ones(len(x))])
        length = np.linalg.norm(upward, axis=1)
        cross = np.linalg.norm(np.cross(upward, vectors), axis=1)
        turn = np.arctan2(cross, np.einsum("ij,ij->i", upward, vectors))
        distance += area @ ((z - surface.height(x, y)) / length) ** 2
        angle += area @ turn**2
    whole = len(SAMPLES) * area.sum()
    return float(np.sqrt(distance / whole) / shape.spacing), float(np.rad2deg(np.sqrt(angle / whole)))


def seconds(call: Callable[[], object]) -> float:
    """Return the least time of five calls."""
    times = []
    for _ in range(5):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def measure(surface: Surface, shape: Shape) -> Floats:
    """Return the figures of all kinds of swaps on one scan, a row each."""
    unit = seconds(lambda: swap_to_delaunay(shape.points, shape.triangles))
    delaunay = swap_to_delaunay(shape.points, shape.triangles).triangles
    figures = []
    for swap in SWAPS.values():
        start = delaunay if swap not in (keep_edges, swap_to_delaunay) else shape.triangles
        triangles = swap(shape.points, start).triangles
        certificate = certify(shape.points, triangles)
        assert certificate.is_disc, certificate.faults
        duration = seconds(lambda swap=swap, start=start: swap(shape.points, start)) / unit
        ratio = radius_ratios(shape.points, triangles).mean()
        figures.append([*errors(surface, shape, triangles), certificate.folds, ratio, duration])
    return np.array(figures)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=4000)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3], help="of the simulations")
    options = parser.parse_args()
    print("| surfaces | noise | swaps | distance | normal error | folds | radius ratio | time |")
    print("|---|---|---|---|---|---|---|---|")
    for kind, (surfaces, is_on_creases) in KINDS.items():
        for noise in (0.0, 0.1):
            runs = [
                measure(surface, sample(surface, options.points, is_on_creases=is_on_creases, noise=noise, seed=seed))
                for surface in surfaces
                for seed in options.seeds
            ]
            for word, (distance, angle, folds, ratio, duration) in zip(SWAPS, np.mean(runs, axis=0), strict=True):
                figures = f"{distance:.4f} | {angle:.2f}° | {folds:.1f} | {ratio:.2f} | {duration:.1f}"
                print(f"| {kind} | {noise:g} | {word} | {figures} |", flush=True)


if __name__ == "__main__":
    main()
