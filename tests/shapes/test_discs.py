from math import radians, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from measures import edge_lengths, euler_characteristic, normals_of, signed_areas

from pointchart import shapes


def test_the_grid_is_exact():
    shape = shapes.grid(4, 3)
    assert shape.points.tolist() == [[i, j, 0] for j in range(3) for i in range(4)]
    assert shape.boundary.tolist() == [0, 1, 2, 3, 7, 11, 10, 9, 8, 4]
    assert signed_areas(shape.uv, shape.triangles).tolist() == [0.5] * 12
    assert shape.spacing == 1


def test_the_rim_of_the_disc_is_the_unit_circle():
    shape = shapes.disc(1000)
    norm = np.linalg.norm(shape.points, axis=1)
    on_rim = np.isin(np.arange(1000), shape.boundary)
    assert np.allclose(norm[on_rim], 1, rtol=0, atol=1e-15)
    assert norm[~on_rim].max() < 1 - 0.3 * shape.spacing


@given(n=st.integers(8, 600), jitter=st.floats(0, 0.3), seed=st.integers(0, 99))
@settings(max_examples=40, deadline=None)
def test_points_of_the_disc_stay_apart(n, jitter, seed):
    shape = shapes.disc(n, jitter=jitter, seed=seed)
    assert edge_lengths(shape).min() > 0.1 * shape.spacing
    assert euler_characteristic(shape) == 1


@pytest.mark.parametrize("angle", [90, 180, 270])
def test_the_bent_sheet_is_rolled_around_a_cylinder(angle):
    shape = shapes.bent_sheet(angle, nx=41, ny=5)
    x, _, z = shape.points.T
    radius = 40 / radians(angle)
    assert np.allclose(np.hypot(x, z), radius)
    assert np.ptp(x[:41]) == pytest.approx(2 * radius * (sin(radians(angle / 2)) if angle < 180 else 1), rel=1e-3)
    assert np.all(np.sum(normals_of(shape)[:, [0, 2]] * np.c_[x, z][shape.triangles[:, 0]], axis=1) > 0)


@pytest.mark.parametrize("gap", [2, 3, 8])
def test_the_sheets_of_the_fold_keep_their_gap(gap):
    shape = shapes.fold(gap, nx=61, ny=5)
    x, _, z = shape.points.T
    sheets = x < 0
    assert np.array_equal(np.abs(z[sheets]), np.full(sheets.sum(), gap / 2))
    assert np.allclose(np.hypot(x, z)[~sheets], gap / 2)
    steps = np.linalg.norm(np.diff(shape.points.reshape(5, 61, 3), axis=1), axis=2)
    assert steps.max() == pytest.approx(1)
    outward = np.c_[np.maximum(x, 0), z][shape.triangles[:, 0]]
    assert np.all(np.sum(normals_of(shape)[:, [0, 2]] * outward, axis=1) > 0)


@given(seed=st.integers(0, 99))
@settings(max_examples=10, deadline=None)
def test_the_relief_is_a_height_field(seed):
    shape = shapes.relief(300, seed=seed)
    assert normals_of(shape)[:, 2].min() > 0
    assert np.array_equal(shape.points[:, :2], shape.uv)


@pytest.mark.parametrize("n", [1000, 3000])
@pytest.mark.parametrize("neck", [2, 5, 8])
def test_the_neck_of_a_dumbbell_has_the_width_asked_for_and_its_lobes_the_rest(n, neck):
    flat = shapes.dumbbell(n, neck=neck)
    x, y, z = flat.points.T
    assert len(flat.points) == pytest.approx(n, rel=0.12)
    assert np.array_equal(z, np.zeros(len(z)))
    assert np.ptp(y[np.abs(x) < 0.15]) == pytest.approx(neck * flat.spacing, abs=0.7 * flat.spacing)
    away = np.hypot(np.abs(x) - 0.6, y)
    assert (away <= 0.4)[np.abs(x) > 0.6].all()
    assert 1 - flat.spacing < np.abs(x).max() <= 1
