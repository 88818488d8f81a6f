"""
A boundary of one's own
=======================

The boundary is found and ordered the paper's way (section 5), and the scan meshed with it.
"""

import numpy as np
from matplotlib import pyplot as plt

from pointchart import delaunay_star, hull_test, nearest, order_by_halves, reconstruct, shapes


def draw(points, members, loop):
    """Draw the points of the boundary as they are found, and in order."""
    panels = plt.subplots(1, 2, figsize=(9, 4.4), layout="constrained")[1]
    for axes, title in zip(panels, ("points on the hull of their star", "in order"), strict=True):
        axes.scatter(*points[:, :2].T, s=3, c="#ccd6d8")
        axes.set(title=title, aspect="equal")
        axes.set_axis_off()
    panels[0].scatter(*points[members, :2].T, s=8, c="#c8553d")
    panels[1].plot(*points[np.append(loop, loop[0]), :2].T, c="#c8553d")


def main() -> float:
    """Return the length of the boundary: that of the unit circle, nearly."""
    points = shapes.hemisphere(800).points
    members = np.flatnonzero(hull_test(delaunay_star(points, nearest(points, 20))))
    loop = order_by_halves(points, members)
    disc = reconstruct(points, loop)
    rim = points[disc.loop]
    length = float(np.linalg.norm(rim - np.roll(rim, 1, axis=0), axis=1).sum())
    print(f"{len(loop)} boundary points, {length:.3f} long; a disc: {disc.certificate.is_disc}")
    draw(points, members, loop)
    return length


if __name__ == "__main__":
    main()
    plt.show()
