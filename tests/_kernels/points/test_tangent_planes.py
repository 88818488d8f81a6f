import numpy as np
import pytest
from kernel_cases.samples import AROUND, SHAPE, N

from pointchart._kernels.points import tangent_planes


@pytest.mark.parametrize("fading", [0.0, 0.5, 0.8])
def test_fitted_planes_are_those_of_the_last_singular_vectors_of_the_weighted_neighbours(fading):
    normals, offsets = np.empty((N, 3)), np.empty(N)
    tangent_planes.fit_planes(SHAPE.points, *AROUND.table, fading, 0, N, normals, offsets)
    for i in range(N):
        near = SHAPE.points[np.r_[i, AROUND.indices[AROUND.indptr[i] : AROUND.indptr[i + 1]]]]
        square = ((near - near[0]) ** 2).sum(axis=1)
        weight = (1 - fading * square / square.max()) ** 2
        middle = weight @ near / weight.sum()
        expected = np.linalg.svd(np.sqrt(weight)[:, None] * (near - middle))[2][2]
        assert abs(normals[i] @ expected) == pytest.approx(1, abs=1e-12)
        assert offsets[i] == pytest.approx((middle - near[0]) @ normals[i], abs=1e-12)
