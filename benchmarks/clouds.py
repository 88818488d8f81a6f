"""Clouds of growing size on one surface: the simulated face, and real scans subdivided by Loop's scheme."""

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from trimesh.remesh import subdivide_loop

from pointchart import read_scan
from pointchart.shapes import sculpture
from pointchart.typing import Points


@dataclass(frozen=True, slots=True)
class Cloud:
    """Points of a surface in a file (.npy), in no order."""

    surface: str
    n_points: int
    file: Path


def store(surface: str, points: Points, folder: Path) -> Cloud:
    """Write points in an order drawn from a fixed seed."""
    file = folder / f"{surface}_{len(points)}.npy"
    np.save(file, np.random.default_rng(7).permutation(points))
    return Cloud(surface, len(points), file)


def simulated(sizes: list[int], folder: Path) -> Iterator[Cloud]:
    """Sample the sculpted face without noise."""
    for n in sizes:
        yield store("simulated face", sculpture(n).points, folder)


def subdivided(names: list[str], rounds: int, data: Path, folder: Path) -> Iterator[Cloud]:
    """Refine the true surfaces of real scans: each round has four times the points, on nearly the same surface."""
    for name in names:
        file = data / name / "reference.ply"
        if not file.exists():
            print(f"{file} is not there: {name} is left out", file=sys.stderr)
            continue
        scan = read_scan(file)
        points, triangles = scan.points, scan.triangles
        yield store(name, points, folder)
        for _ in range(rounds):
            points, triangles = subdivide_loop(points, triangles, iterations=1)
            yield store(name, points, folder)
