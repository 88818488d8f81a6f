import numpy as np
import pytest

from pointchart._kernels.boundary import sides


@pytest.mark.parametrize("k", [3, 4, 6, 12])
def test_neighbours_on_a_regular_polygon_leave_equal_angles_and_no_offset(k):
    turn = 2 * np.pi * np.arange(k) / k + 0.1
    points = np.r_[[[0.0, 0, 0]], np.c_[np.cos(turn), np.sin(turn), 0 * turn]]
    angle, offset = np.empty(1), np.empty(1)
    up = np.array([[0.0, 0, 1]])
    sides.survey_sides(points, up, np.array([0, k]), np.arange(1, k + 1), 0.8, 0, 1, angle, offset)
    assert angle[0] == pytest.approx(2 * np.pi / k)
    assert offset[0] == pytest.approx(0, abs=1e-15)


def free_angle(radius, turn):
    """Return the widest gap that neighbours in the plane z = 0 leave at the origin."""
    points = np.r_[[[0.0, 0, 0]], np.c_[radius * np.cos(turn), radius * np.sin(turn), 0 * turn]]
    angle, offset, up = np.empty(1), np.empty(1), np.array([[0.0, 0, 1]])
    sides.survey_sides(points, up, np.array([0, len(turn)]), np.arange(1, len(turn) + 1), 0.8, 0, 1, angle, offset)
    return angle[0]


@pytest.mark.parametrize("k", [3, 5, 8])
def test_neighbours_behind_each_other_leave_no_gap_between_them(k):
    radius, turn = 1 + np.arange(3 * k) // k, 2 * np.pi * np.arange(3 * k) / k
    for first in np.linspace(0, 2 * np.pi, 100):
        assert free_angle(radius, turn + first) == pytest.approx(2 * np.pi / k)


@pytest.mark.parametrize("n", [1, 2, 5])
def test_neighbours_in_one_direction_leave_all_others_free(n):
    for turn in np.linspace(0, 2 * np.pi, 100):
        assert free_angle(1.0 + np.arange(n), np.full(n, turn)) == pytest.approx(2 * np.pi)


def test_a_point_that_has_no_flat_neighbour_is_free_all_round():
    points = np.array([[0.0, 0, 0], [0, 0, 1], [0.1, 0, -1]])
    angle, offset = np.empty(1), np.empty(1)
    up = np.array([[0.0, 0, 1]])
    sides.survey_sides(points, up, np.array([0, 2]), np.array([1, 2]), 0.8, 0, 1, angle, offset)
    assert (angle[0], offset[0]) == (2 * np.pi, 1.0)
