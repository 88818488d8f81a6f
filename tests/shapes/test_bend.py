from math import radians

import numpy as np
import pytest
from measures import edge_lengths

from pointchart import shapes


@pytest.mark.parametrize("angle", [30, 180, 350])
def test_rolling_is_an_isometry(angle):
    flat = shapes.disc(1000)
    rolled = shapes.roll(flat, angle)
    radius = np.ptp(flat.points[:, 0]) / radians(angle)
    assert np.allclose(np.hypot(rolled.points[:, 0], rolled.points[:, 2]), radius)
    assert np.array_equal(rolled.points[:, 1], flat.points[:, 1])
    assert np.array_equal(rolled.triangles, flat.triangles)
    # A chord of a cylinder is shorter than its arc by a share of (arc / radius)^2 / 24 at most.
    flat_lengths, lengths = edge_lengths(flat), edge_lengths(rolled)
    assert (lengths <= flat_lengths * (1 + 1e-12)).all()
    assert (lengths >= flat_lengths * (1 - (flat_lengths / radius) ** 2 / 24 - 1e-12)).all()


def test_a_bent_sheet_is_a_grid_rolled_up():
    rolled, bent = shapes.roll(shapes.grid(21, 9), 200), shapes.bent_sheet(200, nx=21, ny=9)
    assert np.array_equal(rolled.points, bent.points)


@pytest.mark.parametrize("height", [0.1, 0.5])
def test_bumps_move_points_up_and_down_only_and_in_proportion(height):
    flat = shapes.dumbbell(500)
    low, high = shapes.raise_bumps(flat, height=height, seed=3), shapes.raise_bumps(flat, height=2 * height, seed=3)
    assert np.array_equal(low.points[:, :2], flat.points[:, :2])
    assert np.allclose(2 * low.points[:, 2], high.points[:, 2])
    assert np.ptp(low.points[:, 2]) > 0
