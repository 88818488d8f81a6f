"""Arguments for every kernel of the room `plane`."""

import numpy as np

from kernel_cases.samples import CUBICS, SHAPE, ints

PENTAGRAM = np.array([[np.cos(t), np.sin(t)] for t in np.arange(5) * 0.8 * np.pi])
X_ENDS = np.column_stack([PENTAGRAM[:, 0], np.roll(PENTAGRAM[:, 0], -1)])
SWEEP = (np.argsort(X_ENDS.min(axis=1)), X_ENDS.min(axis=1), X_ENDS.max(axis=1))


CASES = {
    "crossings.find_crossing": lambda: (PENTAGRAM, *SWEEP, ints((320, 2))),
    "crossings.sure_signs": lambda: (
        np.array([[0.0, 0], [1, 1], [3, 3], [0.5, 0.6]]),
        np.array([[0, 1, 2], [0, 2, 3], [0, 3, 2]]),
        1e-15,
        1e-300,
        0,
        3,
        np.zeros(3, np.int8),
    ),
    "crossings.turn": lambda: (0.0, 0.0, 1.0, 0.0, 0.5, 1e-300),
    "locate.depth": lambda: (SHAPE.uv, SHAPE.triangles[5], 0.1, 0.2),
    "locate.doubled_area": lambda: (SHAPE.uv, 0, 1, 0.1, 0.2),
    "locate.find_triangle": lambda: (CUBICS.uv, CUBICS.triangles, CUBICS.boxes, 0.1, 0.2, 1e-15),
    "locate.holds": lambda: (CUBICS.boxes, 1, 0.1, 0.2, 0.0),
    "locate.next_box": lambda: (11,),
}
