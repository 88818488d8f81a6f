"""Arguments for every kernel of the room `points`."""

import numpy as np

from kernel_cases.samples import AROUND, NORMALS, SHAPE, STEP, N, bools, int32s, ints
from pointchart._kernels.points import box_tree, inversion

ROUND = np.arange(6) + 0.3
TURNS = np.array([inversion.pseudo_angle.py_func(np.cos(t), np.sin(t)) for t in ROUND])
RING_X, RING_Y = np.cos(ROUND) * [1, 2, 1, 1.5, 1, 1], np.sin(ROUND) * [1, 2, 1, 1.5, 1, 1]

LOW, HIGH = np.zeros((2, 16, 3))
box_tree.bound_boxes.py_func(SHAPE.points, LOW, HIGH)
CORNER, WIDTH = SHAPE.points.min(axis=0), float(np.ptp(SHAPE.points, axis=0).max())


CASES = {
    "morton_curve.morton_keys": lambda: (SHAPE.points, CORNER, (2**21 - 1) / WIDTH, 21, 3, N, ints(N)),
    "morton_curve.morton_keys in a plane": lambda: (
        SHAPE.uv,
        SHAPE.uv.min(axis=0),
        (2**31 - 1) / 2.0,
        31,
        0,
        N,
        ints(N),
    ),
    "forest.join": lambda: (np.array([0, 0, 1, 3, 3], dtype=np.int32), 4, 2),
    "forest.join_parts": lambda: (SHAPE.points, AROUND.indptr, AROUND.indices, STEP, 0.8, int32s(N)),
    "box_tree.bound_boxes": lambda: (SHAPE.points, np.zeros((16, 3)), np.zeros((16, 3))),
    "box_tree.find_nearest": lambda: (
        SHAPE.points,
        LOW,
        HIGH,
        np.arange(N, dtype=np.uint32)[::-1].copy(),
        np.zeros((N, 9), np.uint32),
        np.zeros((N, 9)),
    ),
    "box_tree.goes_first": lambda: (SHAPE.points, 3, 8),
    "box_tree.middle_distances": lambda: (SHAPE.points, *AROUND.table, 3, 4, 0, N, np.zeros(N)),
    "box_tree.square_to_box": lambda: (LOW, HIGH, 9, 0.1, -0.2, 2.0),
    "box_tree.take_in": lambda: (SHAPE.points, 9, 16, 24, np.arange(5, dtype=np.uint32), np.arange(5.0), 4, 5.0),
    "tangent_planes.smallest_eigenvector": lambda: (3.0, 0.2, 0.1, 2.0, -0.3, 1.0),
    "tangent_planes.tangent_frame": lambda: (0.48, 0.6, -0.64),
    "tangent_planes.fit_planes": lambda: (SHAPE.points, *AROUND.table, 0.8, 0, N, np.zeros((N, 3)), np.zeros(N)),
    "inversion.measure_sides": lambda: (2.0 * np.cos(ROUND), 2.0 * np.sin(ROUND), TURNS, 6),
    "inversion.measure_sides of more than half a turn": lambda: (np.cos(ROUND), np.sin(ROUND), TURNS, 3),
    "inversion.measure_sides of one neighbour": lambda: (np.cos(ROUND), np.sin(ROUND), TURNS, 1),
    "inversion.measure_sides of none": lambda: (np.cos(ROUND), np.sin(ROUND), TURNS, 0),
    "inversion.pseudo_angle": lambda: (-0.3, -2.0),
    "inversion.turns_left": lambda: (0.0, 0.0, 1.0, 0.0, 2.0, 0.5),
    "inversion.is_one_direction": lambda: (1.0, 2.0, 3.0, 6.0),
    "inversion.project": lambda: (
        SHAPE.points,
        NORMALS[4],
        4,
        AROUND.table[1][36:45],
        0.8,
        ints(9),
        np.zeros(9),
        np.zeros(9),
        np.zeros(9),
    ),
    "inversion.drop_hidden": lambda: (ints(4), np.array([1.0, 2, 0, 3]), np.array([0.0, 0, 1, 0]), 4),
    "inversion.gap_end": lambda: (RING_X[:3], RING_Y[:3], 3),
    "inversion.hull_of_inverses": lambda: (RING_X, RING_Y, 6, 1, False, np.zeros(6), np.zeros(6), ints(8)),
    "inversion.circumdiameter": lambda: (1.0, 0.2, -0.3, 1.0),
    "inversion.delaunay_stars": lambda: (
        SHAPE.points,
        NORMALS,
        *AROUND.table,
        0.8,
        0,
        N,
        np.zeros(9 * N, np.uint32),
        np.zeros((9 * N, 2)),
        ints(N),
        bools(N),
        bools(N),
        np.zeros(N),
        np.zeros(N),
        np.zeros(N),
    ),
    "tie_hash.hash_points": lambda: (SHAPE.points, SHAPE.points.view(np.uint64), 0, N, np.zeros(N, np.uint64)),
    "tie_hash.mixed": lambda: (np.uint64(2**63 + 7), 2),
    "tie_hash.move_points": lambda: (
        SHAPE.points,
        np.ones(N),
        np.arange(N, dtype=np.uint64) << np.uint64(50),
        0.1,
        0,
        N,
        np.zeros((N, 3)),
    ),
    "tie_hash.shift_points": lambda: (SHAPE.points, SHAPE.points[3], 0, N, np.zeros((N, 3)), np.zeros(3, bool)),
}
