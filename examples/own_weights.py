"""Map a scan with weights of one's own: any positive ones that sum to one around each point."""

import numpy as np

from pointchart import nearest, parameterize_scan, shapes


def gaussian(points, around):
    """Weigh neighbours by a bell of their distance, in units of the nearest."""
    offset = np.linalg.norm(points[around.indices] - points[around.rows], axis=1)
    weights = np.exp(-((offset / np.minimum.reduceat(offset, around.indptr[:-1])[around.rows]) ** 2))
    return weights / np.bincount(around.rows, weights)[around.rows]


def main() -> float:
    """Return the largest distance of a parameter point from the middle: all lie in the unit disc."""
    _, mapped = parameterize_scan(shapes.relief(800).points, connect=lambda p: nearest(p, 12), weights=gaussian)
    farthest = float(np.linalg.norm(mapped.uv, axis=1).max())
    print(f"{len(mapped.uv)} points mapped into the disc of radius {farthest:.6f}")
    return farthest


if __name__ == "__main__":
    main()
