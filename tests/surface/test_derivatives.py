"""Feet, normals and curvatures: exact on planes, spheres, tori and paraboloids, and laws on any surface."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import rotations, seeds

from pointchart.surface import BSplineSurface, closest_parameters, curvatures, evaluate, normals

CUBIC = np.r_[[0.0] * 4, 0.25, 0.5, 0.5, [1.0] * 4]
THIRDS = np.array([0, 1, 2, 3]) / 3
BEZIER = np.array([0.0, 0, 0, 0, 1, 1, 1, 1])
UNIT = np.array([0.0, 0, 1, 1])


class Torus:
    """A torus in closed form; of a tube alone, a sphere: s = ((R + r cos v) cos u, (R + r cos v) sin u, r sin v)."""

    domain = np.array([[-3.0, -1.4], [3.0, 1.4]])

    def __init__(self, ring, tube):
        self.ring, self.tube = ring, tube

    def derivatives(self, uv, du=0, dv=0):
        u, v = uv[:, 0] + du * np.pi / 2, uv[:, 1] + dv * np.pi / 2
        radius = self.ring * (dv == 0) + self.tube * np.cos(v)
        return np.stack([radius * np.cos(u), radius * np.sin(u), self.tube * np.sin(v) * (du == 0)], axis=1)


SPHERE = Torus(0.0, 2.0)


def wavy(seed, amplitude=0.25):
    """Return a sheet over the unit square with random waves in all coordinates."""
    greville = np.convolve(CUBIC[1:-1], np.ones(3) / 3, mode="valid")
    flat = np.stack([*np.meshgrid(greville, greville, indexing="ij"), np.zeros((7, 7))], axis=-1)
    noise = np.random.default_rng(seed).uniform(-1, 1, flat.shape) * [0.2, 0.2, 1]
    return BSplineSurface(3, CUBIC, CUBIC, flat + amplitude * noise)


def paraboloid(a, b, c):
    """Return the bicubic patch of z = a x^2 / 2 + b x y + c y^2 / 2 over the unit square, exactly."""
    square = np.array([0.0, 0, 1 / 3, 1])  # the polar form of t^2
    x, y = np.meshgrid(THIRDS, THIRDS, indexing="ij")
    z = 0.5 * a * square[:, None] + b * np.outer(THIRDS, THIRDS) + 0.5 * c * square
    return BSplineSurface(3, BEZIER, BEZIER, np.stack([x, y, z], axis=-1))


def over(surface, heights, seed, least=0.1):
    """Return points over a surface at heights, and their feet, off the border by a share of the domain."""
    low, high = surface.domain
    room = least * (high - low)
    feet = np.random.default_rng(seed).uniform(low + room, high - room, (len(heights), 2))
    return evaluate(surface, feet) + np.asarray(heights)[:, None] * normals(surface, feet), feet


def distances(surface, points, uv):
    return np.linalg.norm(evaluate(surface, uv) - points, axis=1)


def moved(surface, rotation, shift=0.0):
    return BSplineSurface(surface.degree, surface.knots_u, surface.knots_v, surface.control @ rotation.T + shift)


def exchanged(surface):
    control = np.ascontiguousarray(surface.control.transpose(1, 0, 2))
    return BSplineSurface(surface.degree, surface.knots_v, surface.knots_u, control)


# Feet


@settings(max_examples=8)
@given(seeds, seeds, st.integers(0, 6), st.sampled_from([0.01, 1.0, 30.0]))
def test_the_distance_never_grows(seed, of_points, n_steps, size):
    surface, rng = wavy(seed, 1.0), np.random.default_rng(of_points)
    points, uv = size * rng.normal(size=(60, 3)), rng.random((60, 2))
    feet = closest_parameters(surface, points, uv, n_steps=n_steps)
    assert (distances(surface, points, feet) <= distances(surface, points, uv)).all()
    more = closest_parameters(surface, points, feet, n_steps=1)
    assert (distances(surface, points, more) <= distances(surface, points, feet)).all()


@settings(max_examples=8)
@given(seeds, seeds)
def test_feet_stay_in_the_domain_also_of_points_and_starts_far_off(seed, of_points):
    surface, rng = wavy(seed, 1.0), np.random.default_rng(of_points)
    feet = closest_parameters(surface, 9 * rng.normal(size=(60, 3)), rng.uniform(-3, 4, (60, 2)))
    assert (feet >= 0).all()
    assert (feet <= 1).all()


@settings(max_examples=8)
@given(seeds, rotations())
def test_the_foot_on_a_plane_is_the_orthogonal_projection_in_one_step(seed, rotation):
    rng = np.random.default_rng(seed)
    square = np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    plane = moved(BSplineSurface(1, UNIT, UNIT, square), rotation, 5.0)
    feet = rng.random((40, 2))
    points = np.c_[feet, rng.normal(size=40)] @ rotation.T + 5.0
    assert np.allclose(closest_parameters(plane, points, rng.random((40, 2)), n_steps=1), feet, rtol=0, atol=1e-12)


@settings(max_examples=8)
@given(seeds)
def test_the_foot_of_a_point_beside_a_plane_is_that_of_the_nearest_point_of_the_border(seed):
    square = np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    sheared = BSplineSurface(1, UNIT, UNIT, square)
    points = np.random.default_rng(seed).uniform(-2, 3, (60, 3))
    feet = closest_parameters(sheared, points, np.full((60, 2), 0.3))
    assert np.allclose(feet, np.clip(points[:, :2], 0, 1), rtol=0, atol=1e-12)


def test_the_foot_slides_along_the_border_of_a_sheared_plane():
    sheared = BSplineSurface(1, UNIT, UNIT, np.array([[[0.0, 0, 0], [1, 1, 0]], [[1, 0, 0], [2, 1, 0]]]))
    points = np.array([[0.0, 0.5, 3], [-1, 1, 2], [2, 0, 1], [9, 9, 9], [1.5, -4, 0]])
    feet = closest_parameters(sheared, points, np.full((5, 2), 0.5))
    expected = [[0, 0.25], [0, 0], [1, 0.5], [1, 1], [1, 0]]
    assert np.allclose(feet, expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("surface", [SPHERE, Torus(3.0, 1.0)], ids=["sphere", "torus"])
@pytest.mark.parametrize("height", [-0.7, -0.1, 0.0, 0.5, 20.0])
def test_feet_on_a_sphere_and_a_torus_are_those_that_the_points_were_raised_from(surface, height):
    points, feet = over(surface, np.full(200, height), seed=1)
    start = feet + np.random.default_rng(2).uniform(-0.1, 0.1, feet.shape)
    # Squares of distances have errors of an ulp, and the foot has the root of that.
    assert np.allclose(closest_parameters(surface, points, start), feet, rtol=0, atol=1e-7)


@settings(max_examples=8)
@given(seeds)
def test_what_is_left_at_the_foot_is_orthogonal_to_the_surface(seed):
    surface = wavy(seed)
    points, start = over(surface, np.random.default_rng(seed).uniform(-0.1, 0.1, 80), seed)
    feet = closest_parameters(surface, points, start)
    inner = ((feet > 0) & (feet < 1)).all(axis=1)
    off = evaluate(surface, feet) - points
    assert inner.any()
    for orders in ((1, 0), (0, 1)):
        along = (off * surface.derivatives(feet, *orders)).sum(axis=1)
        assert np.allclose(along[inner], 0, rtol=0, atol=1e-8)


@settings(max_examples=5)
@given(seeds)
def test_no_point_of_the_neighbourhood_is_nearer_than_the_foot(seed):
    surface = wavy(seed)
    rng = np.random.default_rng(seed)
    points = evaluate(surface, rng.random((50, 2))) + 0.05 * rng.normal(size=(50, 3))
    feet = closest_parameters(surface, points, rng.random((50, 2)))
    least = distances(surface, points, feet)
    for size in (1e-5, 1e-4, 1e-3):
        near = np.clip(feet + size * rng.normal(size=feet.shape), 0, 1)
        assert (distances(surface, points, near) >= least - 1e-13).all()


@settings(max_examples=6)
@given(seeds, rotations())
def test_feet_are_invariant_under_motions_and_under_exchange_of_directions(seed, rotation):
    surface = wavy(seed)
    points, start = over(surface, np.random.default_rng(seed).uniform(-0.1, 0.1, 40), seed)
    feet = closest_parameters(surface, points, start)
    turned = closest_parameters(moved(surface, rotation, 4.0), points @ rotation.T + 4.0, start)
    assert np.allclose(turned, feet, rtol=0, atol=1e-6)
    across = closest_parameters(exchanged(surface), points, start[:, ::-1])
    assert np.allclose(across[:, ::-1], feet, rtol=0, atol=1e-6)


def test_without_steps_the_start_is_kept_but_for_what_is_outside():
    surface = wavy(0)
    start = np.array([[0.3, 0.4], [-1, 0.5], [2, 7]])
    kept = closest_parameters(surface, np.ones((3, 3)), start, n_steps=0)
    assert kept.tolist() == [[0.3, 0.4], [0, 0.5], [1, 1]]
    assert start[2].tolist() == [2, 7]


def test_a_foot_is_found_where_the_surface_is_one_point():
    """All parameters are as near; there is no tangent to follow."""
    surface = BSplineSurface(1, UNIT, UNIT, np.zeros((2, 2, 3)))
    assert closest_parameters(surface, np.ones((1, 3)), np.array([[0.3, 0.4]])).tolist() == [[0.3, 0.4]]


# Normals and curvatures


@given(seeds)
def test_normals_are_unit_and_orthogonal_to_the_surface(seed):
    surface, uv = wavy(seed), np.random.default_rng(seed).random((50, 2))
    n = normals(surface, uv)
    assert np.allclose(np.linalg.norm(n, axis=1), 1, rtol=0, atol=1e-14)
    for orders in ((1, 0), (0, 1)):
        assert np.allclose((n * surface.derivatives(uv, *orders)).sum(axis=1), 0, rtol=0, atol=1e-13)


def test_normals_of_a_sphere_point_away_from_its_middle():
    _, uv = over(SPHERE, np.zeros(100), seed=3)
    assert np.allclose(normals(SPHERE, uv), evaluate(SPHERE, uv) / 2, rtol=0, atol=1e-14)


def test_a_singular_place_has_no_normal():
    cone = BSplineSurface(1, UNIT, UNIT, np.array([[[0.0, 0, 0], [0, 0, 0]], [[1, 0, 0], [0, 1, 0]]]))
    assert np.isnan(normals(cone, np.array([[0.0, 0.5], [1, 0.5]]))).tolist() == [[True] * 3, [False] * 3]


@settings(max_examples=40)
@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(-3, 3))
def test_curvatures_of_a_paraboloid_are_exact(a, b, c):
    uv = np.random.default_rng(0).random((50, 2))
    gaussian, mean = curvatures(paraboloid(a, b, c), uv)
    p, q = (uv @ np.array([[a, b], [b, c]])).T
    area = 1 + p**2 + q**2
    assert np.allclose(gaussian, (a * c - b**2) / area**2, rtol=0, atol=1e-11)
    expected = ((1 + q**2) * a - 2 * p * q * b + (1 + p**2) * c) / (2 * area**1.5)
    assert np.allclose(mean, expected, rtol=0, atol=1e-11)


def test_a_bowl_bends_towards_its_upward_normal_and_a_sphere_away_from_its_outward_one():
    gaussian, mean = curvatures(paraboloid(2.0, 0.0, 2.0), np.zeros((1, 2)))
    assert (gaussian[0], mean[0]) == pytest.approx((4.0, 2.0))
    gaussian, mean = curvatures(SPHERE, over(SPHERE, np.zeros(50), seed=4)[1])
    assert np.allclose(gaussian, 0.25, rtol=0, atol=1e-13)
    assert np.allclose(mean, -0.5, rtol=0, atol=1e-13)


def test_the_curvature_of_a_torus_is_that_of_do_carmo():
    """K = cos v / (r (a + r cos v)), section 3.3, example 5."""
    torus = Torus(3.0, 1.0)
    uv = over(torus, np.zeros(50), seed=5)[1]
    cosine = np.cos(uv[:, 1])
    gaussian, mean = curvatures(torus, uv)
    assert np.allclose(gaussian, cosine / (3 + cosine), rtol=0, atol=1e-13)
    assert np.allclose(mean, -0.5 * (1 + cosine / (3 + cosine)), rtol=0, atol=1e-13)


@settings(max_examples=6)
@given(seeds, rotations(), st.floats(0.1, 10))
def test_curvatures_follow_motion_scale_and_the_side_of_the_normal(seed, rotation, scale):
    surface, uv = wavy(seed), np.random.default_rng(seed).random((30, 2))
    gaussian, mean = curvatures(surface, uv)
    allowed = 1e-9 * (np.abs(gaussian).max() + np.abs(mean).max() + 1)
    turned = curvatures(moved(surface, scale * rotation, 3.0), uv)
    assert np.allclose(turned[0] * scale**2, gaussian, rtol=0, atol=allowed)
    assert np.allclose(turned[1] * scale, mean, rtol=0, atol=allowed)
    across = curvatures(exchanged(surface), uv[:, ::-1])
    assert np.allclose(across[0], gaussian, rtol=0, atol=allowed)
    assert np.allclose(across[1], -mean, rtol=0, atol=allowed)
