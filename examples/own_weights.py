"""
Weights of one's own
====================

Any positive weights that sum to one around each point map a scan into its domain.
"""

import numpy as np
from matplotlib import pyplot as plt

from pointchart import nearest, parameterize_scan, shapes


def gaussian(points, around):
    """Weigh neighbours by a bell of their distance, in units of the nearest."""
    offset = np.linalg.norm(points[around.indices] - points[around.rows], axis=1)
    weights = np.exp(-((offset / np.minimum.reduceat(offset, around.indptr[:-1])[around.rows]) ** 2))
    return weights / np.bincount(around.rows, weights)[around.rows]


def draw(survey, mapped):
    """Draw the points and their parameters, coloured by height."""
    panels = plt.subplots(1, 2, figsize=(9, 4.4), layout="constrained")[1]
    for axes, places, title in zip(panels, (survey.points, mapped.uv), ("points", "parameters"), strict=True):
        axes.scatter(*places[:, :2].T, s=8, c=survey.points[:, 2], cmap="copper")
        axes.set(title=title, aspect="equal")
        axes.set_axis_off()


def main() -> float:
    """Return the largest distance of a parameter point from the middle: all lie in the unit disc."""
    survey, mapped = parameterize_scan(shapes.relief(800).points, connect=lambda p: nearest(p, 12), weights=gaussian)
    farthest = float(np.linalg.norm(mapped.uv, axis=1).max())
    print(f"{len(mapped.uv)} points mapped into the disc of radius {farthest:.6f}")
    draw(survey, mapped)
    return farthest


if __name__ == "__main__":
    main()
    plt.show()
