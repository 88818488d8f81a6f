import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import clouds, planar_discs, rotations, seeds

from pointchart import InputError, explore, nearest, nearest_star, shapes, spacing
from pointchart.agreement.agreed_surface import collect_agreed
from pointchart.agreement.links import disputed_links
from pointchart.points.neighborhoods import PlanarStars


def star_pairs(star):
    return set(zip(star.rows.tolist(), star.indices.tolist(), strict=True))


def edge_pairs(triangles):
    edges = np.asarray(triangles)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    return set(map(tuple, np.r_[edges, edges[:, ::-1]].tolist()))


@settings(max_examples=10)
@given(clouds(smallest=60))
def test_a_vicinity_holds_the_twenty_nearest_and_their_median_distance(points):
    vicinity = explore(points)
    assert np.array_equal(vicinity.around.indices, nearest(points, 20).indices)
    assert np.array_equal(vicinity.spacing, spacing(points))


@settings(max_examples=10)
@given(clouds(smallest=60))
def test_stars_have_widths_but_no_positions(points):
    vicinity = explore(points)
    assert not isinstance(vicinity.star, PlanarStars)
    assert np.array_equal(np.isinf(vicinity.star.width), vicinity.star.is_open)


@pytest.mark.parametrize("n", [4, 5, 12])
def test_few_points_have_all_others_around_them(n):
    points = shapes.disc(12).points[:n] + np.eye(3)[2] * np.arange(n)[:, None] / 100
    assert explore(points).around.sizes.tolist() == [n - 1] * n


@settings(max_examples=10)
@given(planar_discs(smallest=60))
def test_the_stars_inside_a_planar_disc_are_those_of_its_triangulation(shape):
    star = explore(shape.points).star
    inner = np.setdiff1d(np.arange(len(shape.points)), shape.boundary)
    is_inner = np.isin(star.rows, inner)
    found = set(zip(star.rows[is_inner].tolist(), star.indices[is_inner].tolist(), strict=True))
    expected = {(i, j) for i, j in edge_pairs(shape.triangles) if i in set(inner.tolist())}
    # Ties are broken by a hundredth of the spacing, which swaps a diagonal of four points close to a circle.
    assert len(found ^ expected) <= 0.05 * len(expected)


@pytest.mark.parametrize("size", [(12, 9), (20, 15)])
def test_the_stars_of_a_grid_agree_on_two_triangles_a_cell(size):
    vicinity = explore(shapes.grid(*size).points)
    agreed = collect_agreed(vicinity.smoothed, vicinity.star, vicinity.spacing).triangles
    assert len(agreed) == 2 * (size[0] - 1) * (size[1] - 1)


@pytest.mark.parametrize("sigma", [0.25, 0.5])
@pytest.mark.parametrize("seed", range(2))
def test_stars_of_smoothed_points_dispute_a_quarter_of_the_links_at_most_of_those_of_noisy_points(sigma, seed):
    points = shapes.add_noise(shapes.relief(1000, seed=seed), sigma_in_spacings=sigma, seed=seed).points
    vicinity = explore(points)
    assert disputed_links(vicinity.star).sum() < disputed_links(nearest_star(points, vicinity.around)).sum() / 4


@settings(max_examples=10)
@given(clouds(smallest=60), st.integers(-40, 40))
def test_a_power_of_two_of_scale_changes_no_digit(points, exponent):
    one, other = explore(points), explore(np.ldexp(points, exponent))
    assert np.array_equal(np.ldexp(one.smoothed, exponent), other.smoothed)
    assert np.array_equal(np.ldexp(one.spacing, exponent), other.spacing)
    assert np.array_equal(one.star.indices, other.star.indices)


@settings(max_examples=10)
@given(clouds(smallest=60), rotations(), seeds)
def test_pose_and_numbering_change_stars_only_where_ties_are_broken(points, rotation, seed):
    order = np.random.default_rng(seed).permutation(len(points))
    one, other = explore(points), explore(points[order] @ rotation.T)
    assert np.allclose(other.smoothed, one.smoothed[order] @ rotation.T, rtol=0, atol=1e-12)
    assert np.allclose(other.spacing, one.spacing[order], rtol=1e-12)
    renumbered = {(order[i], order[j]) for i, j in star_pairs(other.star)}
    assert len(renumbered ^ star_pairs(one.star)) <= 0.05 * len(renumbered)


def test_the_points_given_are_not_touched():
    points = shapes.relief(300, seed=1).points
    before = points.copy()
    points.setflags(write=False)
    explore(points)
    assert np.array_equal(points, before)


def test_points_that_are_not_finite_are_refused():
    points = shapes.grid(6, 5).points.copy()
    points[7, 1] = np.nan
    with pytest.raises(InputError, match="1 points are NaN or infinite, the first at index 7"):
        explore(points)
