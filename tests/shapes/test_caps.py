from math import cos, radians

import numpy as np
import pytest
from measures import edge_lengths, normals_of

from pointchart import shapes


@pytest.mark.parametrize("angle", [30, 90, 150])
def test_the_cap_is_a_part_of_the_unit_sphere(angle):
    shape = shapes.hemisphere(800, angle=angle)
    assert np.allclose(np.linalg.norm(shape.points, axis=1), 1, rtol=0, atol=1e-14)
    assert np.allclose(shape.points[shape.boundary, 2], cos(radians(angle)), rtol=0, atol=1e-14)
    assert shape.points[:, 2].min() >= cos(radians(angle)) - 1e-14
    assert np.all(np.sum(normals_of(shape) * shape.points[shape.triangles[:, 0]], axis=1) > 0)


@pytest.mark.parametrize("angle", [30, 90, 150])
def test_the_cap_is_evenly_covered(angle):
    lengths = edge_lengths(shapes.hemisphere(2000, angle=angle))
    assert lengths.max() / lengths.min() < 3.5


@pytest.mark.parametrize("length", [0.5, 5, 35])
def test_the_tube_has_radius_one_and_a_round_end(length):
    shape = shapes.tube(length, n_around=24)
    x, y, z = shape.points.T
    above = z > length
    assert np.allclose(np.hypot(x, y)[~above], 1, rtol=0, atol=1e-14)
    assert np.allclose(np.hypot(np.hypot(x, y), z - length)[above], 1, rtol=0, atol=1e-13)
    assert np.allclose(z[shape.boundary], 0, rtol=0, atol=1e-13)
    lengths = edge_lengths(shape)
    assert lengths.max() / lengths.min() < 3.5
    outward = np.c_[x, y, np.maximum(z - length, 0)][shape.triangles[:, 0]]
    assert np.all(np.sum(normals_of(shape) * outward, axis=1) > 0)
