"""Simulated scans, and a layout, that several test files ask for."""

import numpy as np

from pointchart import chord_length_steps, on_square, shapes, sharpest_places

SIMULATED = {
    "relief": lambda: shapes.relief(600, seed=2),
    "hemisphere": lambda: shapes.hemisphere(500),
    "sculpture": lambda: shapes.sculpture(1000),
}
SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
SMOOTH = {
    "disc": lambda: shapes.disc(800, seed=1),
    "hemisphere": lambda: shapes.hemisphere(900),
    "cap of 150 degrees": lambda: shapes.hemisphere(900, angle=150),
    "tube": lambda: shapes.tube(5, n_around=24),
    "relief": lambda: shapes.relief(1000, seed=2),
    "density falling tenfold": lambda: shapes.raise_bumps(shapes.grade(shapes.disc(1000), ratio=10)),
    "density falling fortyfold": lambda: shapes.raise_bumps(shapes.grade(shapes.disc(2000), ratio=40)),
}
SHEET = shapes.grid(12, 9)
RIM = SHEET.boundary
NO_FACES = np.empty((0, 3), np.int64)
FAR = shapes.grid(6, 5).points + np.array([0, 0, 50])


def lampshade(seed=0):
    """Return a wide cone cut off at the top, in any order, with its narrow and its wide rim."""
    ring = shapes.shuffle(shapes.annulus(), seed=seed)
    radius = np.linalg.norm(ring.points, axis=1)
    narrow, wide = sorted(ring.loops, key=lambda loop: radius[loop[0]])
    return ring.points - radius[:, None] * [0, 0, 1], narrow, wide


def square_layout(points, loop):
    return on_square(chord_length_steps(points, loop), sharpest_places(points, loop))


def texts(points):
    return "\n".join(" ".join(map(repr, row)) for row in points.tolist()) + "\n"
