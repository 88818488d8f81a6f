"""Flat points that a mesh in space folds over."""

from contextlib import suppress

import numpy as np
import pytest

from pointchart import PointchartError, SolveError, certify, reconstruct, shapes
from pointchart.errors import Remedy
from pointchart.heights.height_field import reconstruct_heights
from pointchart.proof.folded import FOLDED, check_not_folded


def town(seed):
    """Roofs of boxes over flat ground, and points on few walls: a height field with cliffs."""
    draw = np.random.default_rng(seed)
    flat = draw.uniform(0, 60, (4000, 2))
    block = np.floor(flat / 6).astype(int)
    height = draw.integers(0, 2, (10, 10)) * draw.uniform(3, 8, (10, 10))
    return np.column_stack([flat, height[block[:, 0], block[:, 1]] + draw.normal(0, 0.05, 4000)])


@pytest.mark.parametrize("shape", [shapes.hemisphere(600), shapes.relief(600, seed=2), shapes.fold(2)])
def test_surfaces_pass(shape):
    check_not_folded(shape.points, certify(shape.points, shape.triangles))


def test_a_flat_mesh_that_folds_all_over_is_refused_with_the_remedy():
    sheet = shapes.grid(31, 31)
    jagged = sheet.points.copy()
    jagged[::2, 2] += 9.0  # every other point, so that edges turn back at each of them
    folded = certify(jagged, sheet.triangles)
    assert folded.folds > FOLDED * folded.n_triangles
    with pytest.raises(SolveError, match=f"folds back at {folded.folds} edges, one for every") as refused:
        check_not_folded(sheet.points, folded)
    assert refused.value.remedies == (Remedy.take_heights,)
    ball = shapes.sphere(961)
    check_not_folded(ball.points, folded)


@pytest.mark.parametrize("seed", range(3))
def test_a_town_is_refused_or_hardly_folds_and_is_a_height_field(seed):
    points = town(seed)
    with suppress(PointchartError):
        proof = reconstruct(points).certificate
        assert proof.folds <= FOLDED * proof.n_triangles
    assert reconstruct_heights(points).certificate.is_one_to_one
