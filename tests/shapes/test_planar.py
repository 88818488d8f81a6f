import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from measures import euler_characteristic, has_one_fan_a_point

from pointchart.shapes import Shape
from pointchart.shapes.planar import ragged_delaunay


@given(seed=st.integers(0, 999), limit=st.floats(1, 5))
@settings(max_examples=50, deadline=None)
def test_peeling_leaves_a_disc_with_every_point(seed, limit):
    uv = np.random.default_rng(seed).random((60, 2))
    shape = Shape(np.c_[uv, np.zeros(60)], ragged_delaunay(uv, limit=limit), uv)
    assert euler_characteristic(shape) == 1
    assert has_one_fan_a_point(shape)
    assert len(np.unique(shape.triangles)) == 60
    assert len(shape.loops) == 1
