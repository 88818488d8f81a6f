from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import clouds, seeds

from pointchart.boundary.layout import on_circle
from pointchart.boundary.steps import chord_length_steps
from pointchart.errors import InputError
from pointchart.map.convex_combination import parameterize
from pointchart.mesh.delaunay_swaps import swap_to_delaunay
from pointchart.mesh.planar_delaunay import triangulate
from pointchart.points.cloud import prepare
from pointchart.points.neighbors import nearest
from pointchart.points.stars import delaunay_star
from pointchart.proof.certificate import certify
from pointchart.shapes import relief, sculpture, shuffle


def mesh_of(points, loop):
    """Run the whole chain with a given boundary; triangles in the numbers of the scan."""
    cloud = prepare(points)
    place = np.empty(len(points), np.int64)
    place[cloud.rows] = np.arange(len(cloud.rows))
    rim = place[loop]
    star = delaunay_star(cloud.points, nearest(cloud.points, 20))
    uv = parameterize(cloud.points, rim, on_circle(chord_length_steps(cloud.points, rim)), star).uv
    return cloud.rows[swap_to_delaunay(cloud.points, triangulate(uv, rim)).triangles]


def as_set(triangles):
    return {frozenset(t) for t in triangles.tolist()}


@pytest.fixture(scope="module")
def bumps():
    return shuffle(relief(1000, seed=6))


@settings(max_examples=40)
@given(clouds(), st.floats(-9, 9), st.tuples(*[st.floats(-1e3, 1e3)] * 3))
def test_prepared_points_fill_a_box_about_the_origin(points, exponent, shift):
    unit = prepare(10.0**exponent * (points + shift)).points
    low, high = unit.min(axis=0), unit.max(axis=0)
    assert (((low <= 0) & (high >= 0)) | (high - low > np.abs(unit).max(axis=0) / 2)).all()
    assert 0.5 < np.abs(unit).max() <= 1


@settings(max_examples=40)
@given(clouds(), st.floats(-9, 9), st.tuples(*[st.sampled_from([0.0, 1.0, 5.4e6])] * 3))
def test_prepared_points_are_exactly_those_of_the_scan(points, exponent, shift):
    scan = 10.0**exponent * (points + shift)
    cloud = prepare(scan)
    assert cloud.n_repeated == 0
    for given_axis, axis in zip(scan[cloud.rows].T.tolist(), cloud.points.T.tolist(), strict=True):
        centers = {Fraction(x) - Fraction(cloud.scale) * Fraction(y) for x, y in zip(given_axis, axis, strict=True)}
        assert len(centers) == 1
        assert centers == {0} or centers <= set(map(Fraction, given_axis))


@settings(max_examples=40)
@given(clouds(), st.floats(-9, 9), st.sampled_from([2.0, -3.0, 5.4e6]))
def test_an_offset_over_twice_the_extent_is_always_removed(points, exponent, shift):
    scan = 10.0**exponent * (points + shift * np.ptp(points, axis=0).max() * np.ones(3))
    cloud = prepare(scan)
    assert (cloud.points == 0).all(axis=1).sum() == 1
    assert cloud.scale < 2 * np.ptp(scan, axis=0).max()


@settings(max_examples=40)
@given(clouds(), st.integers(-200, 200))
def test_a_scan_scaled_by_a_power_of_two_is_the_same_to_the_last_bit(points, exponent):
    one, other = prepare(points), prepare(np.ldexp(points, exponent))
    assert np.array_equal(one.points, other.points)
    assert np.array_equal(one.rows, other.rows)


@settings(max_examples=20)
@given(clouds(), st.integers(-(2**20), 2**20))
def test_a_shift_that_rounds_nothing_changes_nothing(points, shift):
    coarse = np.round(points * 2**20) / 2**20
    one, other = prepare(coarse), prepare(coarse + shift)
    assert np.array_equal(one.points, other.points)
    assert np.array_equal(one.rows, other.rows)


@settings(max_examples=40)
@given(clouds(), seeds)
def test_repeated_points_are_merged_to_the_first(points, seed):
    again = np.random.default_rng(seed).integers(0, len(points), 50)
    once, repeated = prepare(points), prepare(np.r_[points, points[again]])
    assert repeated.n_repeated == 50
    assert np.array_equal(once.rows, repeated.rows)
    assert np.array_equal(once.points, repeated.points)
    assert once.n_repeated == 0


@settings(max_examples=40)
@given(clouds(), seeds)
def test_rows_name_the_first_of_equal_points_wherever_they_stand(points, seed):
    scan = points[np.random.default_rng(seed).integers(0, len(points) // 2, 2 * len(points))]
    rows = prepare(scan).rows
    first = {tuple(point): i for i, point in reversed(list(enumerate(scan.tolist())))}
    assert sorted(rows.tolist()) == sorted(first.values())


@settings(max_examples=40)
@given(clouds(), seeds, st.integers(-30, 30))
def test_every_row_of_the_scan_has_its_place_among_the_points(points, seed, exponent):
    scan = np.ldexp(points[np.random.default_rng(seed).integers(0, len(points), 2 * len(points))], exponent)
    cloud = prepare(scan)
    assert np.array_equal(scan[cloud.rows[cloud.places]], scan)
    assert np.array_equal(cloud.places[cloud.rows], np.arange(len(cloud.rows)))
    assert cloud.n_repeated == len(scan) - len(np.unique(scan, axis=0))
    back = cloud.points[cloud.places] * cloud.scale
    assert np.allclose(back - back[0], scan - scan[0], rtol=0, atol=1e-12 * cloud.scale)


def test_negative_zeros_repeat_positive_ones():
    points = np.array([[0.0, 0, 0], [-0.0, 0, -0.0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    assert prepare(points).rows.tolist().count(1) == 0


def test_points_an_ulp_apart_are_kept_apart():
    points = np.r_[relief(50).points, np.nextafter(relief(50).points[:1], 9)]
    cloud = prepare(points)
    assert cloud.n_repeated == 0
    assert len(np.unique(cloud.points, axis=0)) == 51


def test_the_curve_keeps_neighbours_together(bumps):
    cloud = prepare(bumps.points)
    step = np.linalg.norm(np.diff(cloud.points, axis=0), axis=1)
    mixed = np.linalg.norm(np.diff(np.random.default_rng(0).permutation(cloud.points), axis=0), axis=1)
    assert step.mean() < mixed.mean() / 5


@pytest.mark.parametrize("exponent", [-30, 1, 30])
def test_powers_of_two_give_the_same_mesh_to_the_last_bit(bumps, exponent):
    one, other = (mesh_of(points, bumps.boundary) for points in (bumps.points, np.ldexp(bumps.points, exponent)))
    assert np.array_equal(one, other)


@pytest.mark.parametrize("scale", [1e-9, 1e-3, 1e9])
@pytest.mark.parametrize("shift", [(0, 0, 0), (-3, 4, 5)])
def test_any_unit_and_offset_gives_the_same_mesh(bumps, scale, shift):
    moved = scale * (bumps.points + shift)
    assert as_set(mesh_of(moved, bumps.boundary)) == as_set(mesh_of(bumps.points, bumps.boundary))


def test_millimetres_in_universal_coordinates_give_the_mesh_of_the_rounded_points(bumps):
    corner = np.array([5e5, 5.4e6, 120])
    spaced = bumps.points * (1e-3 / bumps.spacing) + corner
    local = spaced - corner
    assert np.abs(local).max() < 0.1
    assert as_set(mesh_of(spaced, bumps.boundary)) == as_set(mesh_of(local, bumps.boundary))


def test_a_scan_with_repeated_points_gives_the_same_mesh_as_without(bumps):
    again = np.r_[bumps.points, bumps.points[::7]]
    assert as_set(mesh_of(again, bumps.boundary)) == as_set(mesh_of(bumps.points, bumps.boundary))


def test_the_chain_ends_in_a_certified_disc_on_a_face_with_overhangs():
    face = sculpture(2000)
    triangles = mesh_of(face.points, face.boundary)
    assert certify(face.points, triangles, loop=face.boundary).is_disc


def test_a_real_scan_with_repeated_points_is_meshed_like_the_scan_without(scan):
    foot = scan("foot")
    again = np.r_[foot.points, foot.points[:200]]
    assert prepare(again).n_repeated == 200
    triangles = mesh_of(again, foot.loop)
    assert certify(foot.points, triangles, loop=foot.loop).is_disc


def test_repetitions_of_too_few_points_are_refused():
    triangle = np.repeat([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], 4, axis=0)
    with pytest.raises(InputError, match="the scan has 3 points; a surface patch needs at least 4"):
        prepare(triangle)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.empty((0, 3)), "the scan has 0 points"),
        (np.full((9, 3), 2.0), "all 9 points are the same"),
        (np.outer(np.arange(9), [1, 2, 3]), "lie on one line"),
        (
            np.where(np.eye(9, 3) > 0, np.nan, np.arange(27).reshape(9, 3)),
            "3 points are NaN or infinite, the first at",
        ),
        (np.ones((9, 2)), r"points have shape \(9, 2\)"),
    ],
)
def test_scans_of_no_surface_are_refused(points, message):
    with pytest.raises(InputError, match=message):
        prepare(points)
