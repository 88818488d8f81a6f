"""Arguments for every kernel of the room `plane`."""

import numpy as np

from kernel_cases.samples import CUBICS, SHAPE, bools
from pointchart._kernels.plane.exact_turns import N_DIGITS

PENTAGRAM = np.array([[np.cos(t), np.sin(t)] for t in np.arange(5) * 0.8 * np.pi])
X_ENDS = np.column_stack([PENTAGRAM[:, 0], np.roll(PENTAGRAM[:, 0], -1)])
DIGITS = np.arange(N_DIGITS) - 9
SWEEP = (np.argsort(X_ENDS.min(axis=1)), X_ENDS.min(axis=1), X_ENDS.max(axis=1))


CASES = {
    "areas.cross": lambda: (1.0, 2.0, 3.0, 4.0),
    "areas.doubled_area": lambda: (SHAPE.uv, 0, 1, 0.1, 0.2),
    "exact_turns.add_part": lambda: (DIGITS.copy(), -1, (1 << 53) - 1, 77),
    "exact_turns.add_product": lambda: (DIGITS.copy(), 0.1, -0.3),
    "exact_turns.long_turn": lambda: (0.1, 0.1, 0.2, 0.2, 0.3, 0.3),
    "exact_turns.measure_signs": lambda: (
        np.array([[0.0, 0], [1, 1], [3, 3], [0.5, 0.5 + 2.0**-53]]),
        np.array([[0, 1, 2], [0, 2, 3], [0, 3, 2]]),
        0,
        3,
        np.zeros(3, np.int8),
    ),
    "exact_turns.sign_of": lambda: (DIGITS.copy(),),
    "exact_turns.sure_turn": lambda: (0.0, 0.0, 1.0, 0.0, 0.5, 1e-300),
    "exact_turns.turn": lambda: (0.0, 0.0, 1.0, 0.0, 0.5, 1e-300),
    "locate.depth": lambda: (SHAPE.uv, SHAPE.triangles[5], 0.1, 0.2),
    "locate.find_triangle": lambda: (CUBICS.uv, CUBICS.triangles, CUBICS.boxes, 0.1, 0.2, 1e-15),
    "locate.holds": lambda: (CUBICS.boxes, 1, 0.1, 0.2, 0.0),
    "locate.next_box": lambda: (11,),
    "segments.do_meet": lambda: (PENTAGRAM, 0, 1, 2, 3),
    "segments.has_crossing": lambda: (PENTAGRAM, *SWEEP),
    "segments.measure_inside": lambda: (
        PENTAGRAM,
        np.roll(PENTAGRAM, -1, axis=0),
        np.array([[0.8, 0.0], [0.0, 0.0], [0.5, PENTAGRAM[1, 1]]]),
        0,
        3,
        bools(3),
    ),
    "segments.measure_meetings": lambda: (
        PENTAGRAM,
        np.roll(np.arange(5), -1),
        np.array([[0, 2], [0, 1]]),
        0,
        2,
        bools(2),
    ),
}
