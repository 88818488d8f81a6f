import numpy as np
import pytest
from kernel_cases.samples import SHAPE, N, bools, ints

from pointchart._kernels.points import inversion
from pointchart.points.neighbors import nearest
from pointchart.points.planes import normals


@pytest.mark.parametrize("k", [4, 6, 9])
def test_a_star_is_short_exactly_if_it_is_closed_and_a_circle_reaches_beyond_the_last_candidate(k):
    around = nearest(SHAPE.points, k)
    star, local, count = np.zeros(k * N, np.uint32), np.zeros((k * N, 2)), ints(N)
    is_open, is_short, (width, angle, offset) = bools(N), bools(N), np.zeros((3, N))
    where = SHAPE.points, normals(SHAPE.points, around), *around.table, 0.8, 0, N
    inversion.delaunay_stars(*where, star, local, count, is_open, is_short, width, angle, offset)
    last = SHAPE.points[around.indices[around.indptr[1:] - 1]]
    reach = np.linalg.norm(last - SHAPE.points, axis=1)
    assert np.array_equal(np.isinf(width), is_open)
    assert np.array_equal(is_short, ~is_open & (2 * width > reach))
    assert is_short.any()
