"""Find the boundary the paper's way (section 5), and mesh the scan with it."""

import numpy as np

from pointchart import delaunay_star, hull_test, nearest, order_by_halves, reconstruct, shapes


def main() -> float:
    """Return the length of the boundary: that of the unit circle, nearly."""
    points = shapes.hemisphere(800).points
    members = np.flatnonzero(hull_test(delaunay_star(points, nearest(points, 20))))
    loop = order_by_halves(points, members)
    disc = reconstruct(points, loop)
    rim = points[disc.loop]
    length = float(np.linalg.norm(rim - np.roll(rim, 1, axis=0), axis=1).sum())
    print(f"{len(loop)} boundary points, {length:.3f} long; a disc: {disc.certificate.is_disc}")
    return length


if __name__ == "__main__":
    main()
