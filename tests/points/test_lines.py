"""Profiles of a scanner, and points that lie in no lines."""

import numpy as np
import pytest

from pointchart import InputError, shapes
from pointchart.errors import Remedy, SolveError
from pointchart.points.lines import density_along, lines_told


def profiles(ratio, seed=1):
    """A wavy sheet in lines, a little off them, in any order."""
    draw = np.random.default_rng(seed)
    x, y = np.meshgrid(np.arange(30 * ratio) / ratio, np.arange(30.0))
    flat = np.column_stack([x.ravel(), y.ravel()]) + draw.normal(0, 0.02 / ratio, (x.size, 2))
    return draw.permutation(np.column_stack([flat, np.sin(flat[:, 0] / 4) * np.cos(flat[:, 1] / 5)]))


@pytest.mark.parametrize("ratio", [5, 8, 12])
def test_the_density_along_lines_is_measured(ratio):
    assert density_along(profiles(ratio)) == pytest.approx(ratio, rel=0.15)


@pytest.mark.parametrize(
    "points", [profiles(1), profiles(2), shapes.relief(900, seed=2).points, shapes.hemisphere(40).points]
)
def test_points_of_surfaces_lie_in_no_lines(points):
    assert density_along(points) is None


def test_lines_are_named_as_the_cause_and_other_errors_stay():
    with (
        pytest.raises(SolveError, match="lie in lines, 8 times denser along them than across") as told,
        lines_told(profiles(8)),
    ):
        raise InputError("anything")
    assert told.value.remedies == (Remedy.take_heights,)
    with pytest.raises(InputError, match="anything"), lines_told(profiles(1)):
        raise InputError("anything")
