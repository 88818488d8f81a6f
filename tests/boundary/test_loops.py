import numpy as np
import pytest
from comparisons import either_way
from hypothesis import given, settings
from strategies import planar_discs, seeds

from pointchart import shapes
from pointchart.agreement.agreed_surface import patchwork
from pointchart.boundary import rims
from pointchart.boundary.loops import tightened


def test_the_rims_of_a_disc_are_its_boundary(any_disc):
    (rim,) = rims(patchwork(any_disc.triangles, len(any_disc.points)))
    assert either_way(rim) == either_way(any_disc.boundary)


def test_a_surface_with_two_boundaries_has_two_rims():
    ring = shapes.annulus(30, 5)
    found = rims(patchwork(ring.triangles, len(ring.points)))
    assert sorted(map(either_way, found)) == sorted(map(either_way, ring.loops))


def test_a_closed_surface_has_no_rim():
    ball = shapes.sphere(100)
    assert rims(patchwork(ball.triangles, 100)) == []


@given(seeds)
def test_rims_are_simple_however_many_triangles_are_missing(seed):
    shape = shapes.disc(60)
    rng = np.random.default_rng(seed)
    for rim in rims(patchwork(shape.triangles[rng.random(len(shape.triangles)) < rng.random()], 60)):
        assert len(rim) >= 3
        assert len(set(rim.tolist())) == len(rim)


def euler_of(triangles):
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    return len(np.unique(triangles)) - len(edges) + len(triangles)


def some_of(shape, rng):
    """Return some triangles of a shape as a surface, and some points."""
    kept = rng.random(len(shape.triangles)) < rng.uniform(0.7, 1)
    return patchwork(shape.triangles[kept], len(shape.points)), rng.random(len(shape.points)) < rng.random()


@given(planar_discs(), seeds)
@settings(max_examples=30)
def test_tightening_changes_no_topology_and_loses_no_point(shape, seed):
    surface, is_boundary = some_of(shape, np.random.default_rng(seed))
    tight = tightened(shape.points, surface, is_boundary)
    assert np.array_equal(np.unique(tight.triangles), np.unique(surface.triangles))
    assert euler_of(tight.triangles) == euler_of(surface.triangles)
    assert len(rims(tight)) == len(rims(surface))


@given(planar_discs(), seeds)
@settings(max_examples=30)
def test_tightening_brings_boundary_points_onto_the_rims_and_takes_none_off(shape, seed):
    surface, is_boundary = some_of(shape, np.random.default_rng(seed))
    tight = tightened(shape.points, surface, is_boundary)
    before, after = (set(np.concatenate([*rims(patches), []]).tolist()) for patches in (surface, tight))
    assert before <= after
    assert len(after - before) == len(surface.triangles) - len(tight.triangles)
    assert is_boundary[np.array(sorted(after - before), dtype=int)].all()
    assert set(map(tuple, tight.triangles.tolist())) <= set(map(tuple, surface.triangles.tolist()))
    again = tightened(shape.points, tight, is_boundary)
    assert np.array_equal(again.triangles, tight.triangles)


def test_without_boundary_points_nothing_is_tightened(any_disc):
    surface = patchwork(any_disc.triangles, len(any_disc.points))
    assert tightened(any_disc.points, surface, np.zeros(len(any_disc.points), bool)) is surface


@pytest.mark.parametrize(("angle", "n_left"), [(89, 5), (91, 4)])
def test_a_rim_is_drawn_to_a_point_that_sees_it_under_more_than_a_right_angle(angle, n_left):
    half = np.deg2rad(angle / 2)
    turn = np.r_[0, np.linspace(half, 2 * np.pi - half, 5)]
    points = np.c_[np.cos(turn), np.sin(turn), 0 * turn] * (np.arange(6) > 0)[:, None]
    fan = patchwork([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1]], 6)
    assert len(tightened(points, fan, np.ones(6, bool)).triangles) == n_left


def test_tightening_finds_the_teeth_of_a_ragged_edge():
    teeth = shapes.grid(12, 6)
    is_tooth = (teeth.uv[:, 1] == 0) & (teeth.uv[:, 0] % 2 == 1)
    points = teeth.points - 0.6 * np.eye(3)[1] * is_tooth[:, None]
    hull = np.array([[i, i + 2, i + 1] for i in range(1, 10, 2)])
    (loop,) = rims(tightened(points, patchwork(np.r_[teeth.triangles, hull], 72), np.ones(72, bool)))
    assert set(range(12)) <= set(loop.tolist())
