"""Arguments for every kernel of the room `boundary`."""

import numpy as np

from kernel_cases.samples import AROUND, NORMALS, SHAPE, N

CASES = {
    "sides.survey_sides": lambda: (
        SHAPE.points,
        NORMALS,
        *AROUND.table,
        0.8,
        0,
        N,
        np.zeros(N),
        np.zeros(N),
    ),
}
