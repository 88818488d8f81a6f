"""Mesh the real scans beside the checkout and compare with their true surfaces.

    python benchmarks/scans.py [--data DIR]

For each scan, with its true boundary and without any: whether the mesh is a certified disc with one-to-one
parameters, the F1 score of its edges against the true surface's (whose diagonals are Delaunay in space), the longest
edge in local spacings, and the seconds of the reconstruction alone. Scans named x_ are no disc: the answer is the
refusal.
"""

import argparse
import time
from pathlib import Path

import numpy as np
from paper_scans import DATA

from pointchart import PointchartError, read_loop, read_scan, reconstruct
from pointchart.typing import Loop, Points, Triangles


def edge_set(triangles: Triangles) -> set[tuple[int, int]]:
    """Return the edges of a mesh as pairs of point indices, the smaller first."""
    pairs = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return set(map(tuple, pairs.tolist()))


def f1(found: set[tuple[int, int]], true: set[tuple[int, int]]) -> float:
    """Return the harmonic mean of precision and recall."""
    return 2 * len(found & true) / (len(found) + len(true))


def result(points: Points, loop: Loop | None, truth: Triangles | None) -> str:
    """Reconstruct a scan and return the cells of its row."""
    start = time.perf_counter()
    try:
        mesh = reconstruct(points, loop)
    except PointchartError as refusal:
        return f"refused: {str(refusal).split(':')[0].split(',')[0]} | | |"
    seconds = time.perf_counter() - start
    edges = "" if truth is None else f"{f1(edge_set(mesh.rows[mesh.triangles]), edge_set(truth)):.4f}"
    proof = mesh.certificate
    kind = "disc, uv one-to-one" if proof.is_disc and proof.is_one_to_one else "not proved"
    return f"{kind} | {edges} | {proof.longest_edge_over_spacing:.1f} | {seconds:.2f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=DATA, help="folder of the scans")
    folders = sorted(path.parent for path in parser.parse_args().data.glob("*/points.ply"))
    if not folders:
        parser.error("no scans there: each is a folder with points.ply, and reference.ply and boundary.txt where known")
    for with_boundary in (True, False):
        print(f"\n{'With the true boundary' if with_boundary else 'Without a boundary'}:\n")
        print("| scan | points | result | edges F1 | longest edge | seconds |\n|---|---|---|---|---|---|")
        for folder in folders:
            known = (folder / "boundary.txt").exists()
            if with_boundary and (not known or folder.name.startswith("x_")):
                continue
            points = read_scan(folder / "points.ply").points
            truth = (
                read_scan(folder / "reference.ply").triangles if not folder.name.startswith(("x_", "dup_")) else None
            )
            loop = read_loop(folder / "boundary.txt") if with_boundary else None
            print(f"| {folder.name} | {len(points):,} | {result(points, loop, truth)} |", flush=True)


if __name__ == "__main__":
    main()
