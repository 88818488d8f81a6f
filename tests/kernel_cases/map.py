"""Arguments for every kernel of the room `map`."""

import numpy as np

from kernel_cases.samples import SHAPE, STAR, N

CASES = {
    "mean_value_weights.half_angle_tangent": lambda: (SHAPE.points, 0, 1, 2),
    "mean_value_weights.mean_value": lambda: (
        SHAPE.points,
        STAR.indptr,
        STAR.indices,
        STAR.is_open,
        0.3,
        0,
        N,
        np.zeros(len(STAR.indices)),
    ),
    "shape_preserving_weights.shape_preserving": lambda: (
        STAR.local,
        STAR.indptr,
        STAR.is_open,
        0,
        N,
        np.zeros(len(STAR.indices)),
    ),
}
