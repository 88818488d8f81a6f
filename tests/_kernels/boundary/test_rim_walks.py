import numpy as np
from kernel_cases.agreement import CASES
from kernel_cases.samples import RAGGED, N

from pointchart._kernels.boundary import rim_walks


def test_drawing_tight_takes_each_triangle_with_an_obtuse_corner_off_the_rim():
    arguments = CASES["rim_walks.draw_tight"]()
    on_rim, removed = arguments[6], arguments[8]
    was_on_rim = np.zeros(N, bool)
    was_on_rim[RAGGED.ends[(RAGGED.sides[:, 0] >= 0) & (RAGGED.sides[:, 1] < 0)]] = True
    rim_walks.draw_tight(*arguments)
    assert removed.sum() == (on_rim & ~was_on_rim).sum() > 0
