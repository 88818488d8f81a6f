import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kernel_cases.samples import SHAPE
from strategies import integer_sets, seeds

from pointchart.points.neighbors import BoxTree


def check_nearest(points, k, queries=None):
    """Compare distances with those of all points, as points at the same distance may come in any order."""
    found = BoxTree(points).nearest(k, queries)
    asked = np.arange(len(points)) if queries is None else queries
    square = ((points[:, None] - points[None]) ** 2).sum(axis=2)
    np.fill_diagonal(square, np.inf)
    assert found.shape == (len(asked), min(k, len(points) - 1))
    assert all(len(set(row)) == len(row) for row in found.tolist())
    far = np.take_along_axis(square[asked], found, axis=1)
    assert np.allclose(far, np.sort(square[asked], axis=1)[:, : found.shape[1]], rtol=1e-12, atol=0)


@settings(max_examples=40)
@given(st.integers(2, 70), st.integers(1, 80), seeds)
def test_the_nearest_are_found_where_each_point_is_far_from_the_one_before(n, k, seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(n, 3)) * 10.0 ** rng.uniform(-3, 3, (n, 1))
    check_nearest(points, k)
    check_nearest(points, k, rng.integers(0, n, 2 * n))


@settings(max_examples=40)
@given(integer_sets(), st.integers(1, 30), seeds)
def test_the_nearest_are_found_where_many_are_at_one_distance(cells, k, seed):
    rng = np.random.default_rng(seed)
    check_nearest(np.c_[rng.permutation(cells), np.zeros(len(cells))], k, rng.integers(0, len(cells), 40))


@settings(max_examples=40)
@given(st.integers(1, 20), st.integers(1, 20), st.integers(1, 25), st.floats(2, 9), seeds)
def test_the_nearest_are_found_in_clusters_far_apart(n_here, n_there, k, exponent, seed):
    rng = np.random.default_rng(seed)
    here, there = rng.random((n_here, 3)), rng.random((n_there, 3)) + 10.0**exponent
    points = np.r_[here, there]
    for cloud in (points, rng.permutation(points)):
        check_nearest(cloud, k)
        check_nearest(cloud, k, rng.permutation(len(cloud)))


@pytest.mark.parametrize("k", [1, 2, 5, 40])
def test_points_that_coincide_are_the_nearest_of_each_other_though_asked_for_in_turn(k):
    check_nearest(np.repeat(SHAPE.points[:12], 3, axis=0), k)
    check_nearest(SHAPE.points[:12], k, np.repeat(np.arange(12), 2))
