import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from strategies import clouds, planar_discs, rotations, seeds

from pointchart._kernels.map.mean_value_weights import half_angle_tangent
from pointchart.agreement.links import link_stars
from pointchart.boundary.layout import on_circle
from pointchart.errors import InputError
from pointchart.map.convex_combination import parameterize
from pointchart.map.weights import mean_value, normalize, reciprocal_distance, shape_preserving, trusted, uniform
from pointchart.mesh.connectivity import one_rings
from pointchart.points.neighborhoods import Neighborhoods
from pointchart.points.neighbors import ball, nearest
from pointchart.points.stars import delaunay_star
from pointchart.shapes import disc

ORDERED = [mean_value, shape_preserving]
SCHEMES = [uniform, reciprocal_distance, *ORDERED]


def star_of(points):
    return delaunay_star(points, nearest(points, 15))


def as_dict(neighborhoods, weights):
    pairs = zip(neighborhoods.rows.tolist(), neighborhoods.indices.tolist(), strict=True)
    return dict(zip(pairs, weights, strict=True))


def assert_same_weights(one, other):
    assert one.keys() == other.keys()
    assert np.allclose([one[pair] for pair in one], [other[pair] for pair in one], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("scheme", SCHEMES)
@settings(max_examples=20)
@given(points=clouds())
def test_weights_are_a_convex_combination(scheme, points):
    star = star_of(points)
    weights = scheme(points, star)
    assert weights.shape == star.indices.shape
    assert (weights > 0).all()
    assert np.allclose(np.bincount(star.rows, weights), 1, rtol=0, atol=1e-14)


@pytest.mark.parametrize("scheme", [uniform, reciprocal_distance])
@pytest.mark.parametrize("hood", [lambda points: nearest(points, 9), lambda points: ball(points, 1.5)])
@settings(max_examples=12)
@given(points=clouds())
def test_weights_without_order_are_a_convex_combination_on_balls_and_nearest_points(scheme, hood, points):
    around = hood(points)
    weights = scheme(points, around)
    assert (weights > 0).all()
    assert np.allclose(np.bincount(around.rows, weights), 1, rtol=0, atol=1e-13)


@pytest.mark.parametrize("scheme", SCHEMES)
@settings(max_examples=12)
@given(points=clouds(), rotation=rotations(), shift=st.tuples(*[st.floats(-50, 50)] * 3), exponent=st.floats(-9, 9))
def test_weights_do_not_depend_on_place_and_size(scheme, points, rotation, shift, exponent):
    moved = 10.0**exponent * (points @ rotation.T + shift)
    one, other = star_of(points), star_of(moved)
    assert_same_weights(as_dict(one, scheme(points, one)), as_dict(other, scheme(moved, other)))


@pytest.mark.parametrize("scheme", SCHEMES)
@settings(max_examples=12)
@given(points=clouds(), seed=seeds)
def test_weights_follow_their_points_through_a_renumbering(scheme, points, seed):
    order = np.random.default_rng(seed).permutation(len(points))
    one, other = star_of(points), star_of(points[order])
    mixed = as_dict(other, scheme(points[order], other))
    renamed = {(order[i], order[j]): weight for (i, j), weight in mixed.items()}
    assert_same_weights(as_dict(one, scheme(points, one)), renamed)


@pytest.mark.parametrize("scheme", ORDERED)
@settings(max_examples=20)
@given(shape=planar_discs())
def test_centres_of_closed_stars_are_the_weighted_means_of_their_neighbours(scheme, shape):
    star = star_of(shape.points)
    weights = scheme(shape.points, star)
    mean = np.column_stack([np.bincount(star.rows, weights * shape.uv[star.indices, axis]) for axis in range(2)])
    assert np.abs(mean - shape.uv)[~star.is_open].max() < 1e-13


@pytest.mark.parametrize("scheme", ORDERED)
@settings(max_examples=20)
@given(shape=planar_discs(largest=300), rotation=rotations(), seed=seeds)
def test_planar_points_with_an_affine_boundary_come_back_exactly(scheme, shape, rotation, seed):
    rng = np.random.default_rng(seed)
    tilted = 10.0 ** rng.uniform(-3, 3) * (shape.points @ rotation.T + rng.normal(size=3))
    expected = shape.uv @ rng.normal(size=(2, 2)) + rng.normal(size=2)
    star = star_of(tilted)
    inner = np.setdiff1d(np.arange(len(tilted)), shape.boundary)
    assume(not star.is_open[inner].any())
    found = parameterize(tilted, shape.boundary, expected[shape.boundary], star, weights=scheme)
    assert np.abs(found.uv - expected).max() < 1e-12 * max(1, np.abs(expected).max())


def twins(seed):
    """Return a disc and an interior point of it doubled at a hundredth of the spacing."""
    shape = disc(150, seed=seed)
    twins = shape.points[seed % 40] + [0.01 * shape.spacing, 0, 0]
    return np.r_[shape.points, [twins]], shape, seed % 40


def twin_distance(seed, scheme):
    points, shape, i = twins(seed)
    around = ball(points, 2.5 * shape.spacing)
    closed = [{j, *around.indices[around.indptr[j] : around.indptr[j + 1]].tolist()} for j in (i, len(points) - 1)]
    assume(closed[0] == closed[1])
    steps = np.ones(len(shape.boundary))
    uv = parameterize(points, shape.boundary, on_circle(steps), around, weights=scheme).uv
    return np.linalg.norm(uv[i] - uv[-1])


@settings(max_examples=20)
@given(st.integers(0, 10**6))
def test_proposition_4_1_points_with_equal_neighbourhoods_fall_together_by_uniform_weights(seed):
    assert twin_distance(seed, uniform) < 1e-14


@settings(max_examples=20)
@given(st.integers(0, 10**6))
def test_reciprocal_weights_keep_points_with_equal_neighbourhoods_apart(seed):
    assert twin_distance(seed, reciprocal_distance) > 1e-6


def test_uniform_weights_count_and_reciprocal_weights_measure():
    hood = Neighborhoods(np.array([0, 3, 3, 3, 3]), np.array([1, 2, 3]))
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 4]])
    assert uniform(points, hood).tolist() == [1 / 3] * 3
    assert np.allclose(reciprocal_distance(points, hood), np.array([4, 2, 1]) / 7, rtol=1e-15)


@pytest.mark.parametrize("scheme", ORDERED)
@pytest.mark.parametrize("n", [3, 4, 7, 12])
def test_weights_in_a_regular_polygon_are_all_the_same(scheme, n):
    turn = 2 * np.pi * np.arange(n) / n + 0.1
    points = np.r_[[[0, 0, 0]], np.c_[np.cos(turn), np.sin(turn), 0 * turn]]
    weights = scheme(points, delaunay_star(points, nearest(points, n)))
    assert np.allclose(weights[:n], 1 / n, rtol=1e-13)


def test_weights_around_a_point_with_three_neighbours_are_its_barycentric_coordinates():
    points = np.array([[0.1, 0.2, 0], [-1, -1, 0], [2, 0, 0], [0, 3, 0]])
    exact = np.linalg.solve(np.r_[points[1:, :2].T, [[1, 1, 1]]], [0.1, 0.2, 1])
    star = delaunay_star(points, nearest(points, 3))
    for scheme in ORDERED:
        weights = as_dict(star, scheme(points, star))
        assert np.allclose([weights[0, j] for j in (1, 2, 3)], exact, rtol=1e-13)


@given(st.floats(1e-9, np.pi - 1e-3), st.floats(0.1, 10), st.floats(0.1, 10))
def test_half_angle_tangents_are_exact_for_small_and_large_angles(angle, a, b):
    points = np.array([[0.0, 0, 0], [a, 0, 0], [b * np.cos(angle), b * np.sin(angle), 0]])
    assert np.isclose(half_angle_tangent(points, 0, 1, 2), np.tan(angle / 2), rtol=1e-6, atol=1e-15)


def test_mean_value_weights_of_a_mesh_need_no_planar_positions(any_disc):
    rings = one_rings(any_disc.triangles, len(any_disc.points))
    weights = mean_value(any_disc.points, rings)
    assert (weights > 0).all()
    assert np.allclose(np.bincount(rings.rows, weights), 1, rtol=0, atol=1e-14)


def test_open_stars_get_mean_value_weights_instead_of_shape_preserving_ones():
    points = disc(200).points
    star = star_of(points)
    is_open = np.repeat(star.is_open, star.sizes)
    assert np.allclose(shape_preserving(points, star)[is_open], mean_value(points, star)[is_open], rtol=1e-14)


@pytest.mark.parametrize("scheme", ORDERED)
def test_unordered_neighbours_are_refused_where_order_matters(scheme):
    points = disc(60).points
    with pytest.raises(InputError, match="use Delaunay stars"):
        scheme(points, nearest(points, 8))


def test_normalized_weights_keep_their_proportions():
    hood = Neighborhoods(np.array([0, 2, 2, 3]), np.array([1, 2, 0]))
    assert normalize(np.array([1.0, 3.0, 7.0]), hood).tolist() == [0.25, 0.75, 1.0]


@settings(max_examples=12)
@given(clouds())
def test_trusted_weights_are_a_convex_combination_in_proportion_to_trust(points):
    links = link_stars(star_of(points))
    graph = links.neighborhoods
    plain, weighed = reciprocal_distance(points, graph), trusted(links)(points, graph)
    assert (weighed > 0).all()
    assert np.allclose(np.bincount(graph.rows, weighed), 1, rtol=0, atol=1e-14)
    ratio = weighed / (plain * links.trust)
    assert np.allclose(ratio, ratio[graph.indptr[:-1]][graph.rows], rtol=1e-12)
