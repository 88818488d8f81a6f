"""The law of reflection."""

import numpy as np
from hypothesis import given
from strategies import rotations

from pointchart.look.reflections import reflection_angles
from pointchart.surface import BSplineSurface, normals

UNIT = np.array([0.0, 0, 1, 1])
FLAT = BSplineSurface(1, UNIT, UNIT, np.array([[[0.0, 0, 0], [0, 2, 0]], [[3, 0, 0], [3, 2, 0]]]))
FEET = np.random.default_rng(0).random((400, 2))
X, Y, Z = np.eye(3)


@given(rotations())
def test_the_angle_of_reflection_is_twice_that_of_the_normal(rotation):
    angles = np.linspace(-1.5, 1.5, 31)
    facing = np.stack([np.sin(angles), 0 * angles, np.cos(angles)], axis=1)
    along, eye = rotation[1], rotation[2]
    assert np.allclose(reflection_angles(facing @ rotation, eye, along), 2 * angles, rtol=0, atol=1e-12)


def test_normals_of_one_slope_reflect_one_line_and_mirrored_ones_the_opposite_line():
    lift = np.linspace(-0.6, 0.6, 13)
    facing = np.stack([0 * lift + 0.5, 0 * lift, 0 * lift + 0.8], axis=1) + np.outer(lift, Y)
    facing /= np.linalg.norm(facing, axis=1)[:, None]
    assert np.array_equal(reflection_angles(facing * [-1, 1, 1], Z, Y), -reflection_angles(facing, Z, Y))
    assert (np.diff(reflection_angles(facing, Z, Y)[:7]) < 0.0).all()


def test_a_plane_reflects_one_angle_and_a_singular_place_none():
    assert np.ptp(reflection_angles(normals(FLAT, FEET), Z, X)) == 0.0
    assert np.isnan(reflection_angles(np.full((1, 3), np.nan), Z, X)).all()
