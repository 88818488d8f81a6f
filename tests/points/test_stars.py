import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay
from strategies import clouds, cocircular_sets, flat, integer_sets, planar_discs, rotations, seeds

from pointchart.errors import InputError
from pointchart.points.neighborhoods import Neighborhoods
from pointchart.points.neighbors import ball, nearest
from pointchart.points.planes import normals, smooth
from pointchart.points.stars import STEEPEST, delaunay_star, nearest_star
from pointchart.shapes import add_noise, disc, fold, grid, hemisphere, relief


def star_pairs(star):
    return set(zip(star.rows.tolist(), star.indices.tolist(), strict=True))


def whole_star(uv):
    return delaunay_star(flat(uv), nearest(flat(uv), len(uv) - 1))


def edge_pairs(triangles):
    edges = np.asarray(triangles)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    return set(map(tuple, np.r_[edges, edges[:, ::-1]].tolist()))


def widest_gap(offsets):
    turns = np.sort(np.arctan2(offsets[:, 1], offsets[:, 0]))
    return np.diff(turns, append=turns[0] + 2 * np.pi).max()


def circle_range(uv, i, j):
    """Return the range of t for which the circle about (p_i + p_j) / 2 + t n through both points is empty.

    Exact for small whole numbers, whose quotients differ by far more than rounding.
    """
    others = np.delete(uv, [i, j], axis=0)
    from_i, from_j, along = others - uv[i], others - uv[j], uv[j] - uv[i]
    power = (from_i * from_j).sum(axis=1)
    side = 2 * (along[0] * from_i[:, 1] - along[1] * from_i[:, 0])
    if (power[side == 0] < 0).any():
        return np.inf, -np.inf
    lowest = (power[side < 0] / side[side < 0]).max(initial=-np.inf)
    highest = (power[side > 0] / side[side > 0]).min(initial=np.inf)
    return lowest, highest


def assert_star_is_delaunay(uv):
    found = star_pairs(whole_star(uv))
    for i in range(len(uv)):
        for j in set(range(len(uv))) - {i}:
            lowest, highest = circle_range(uv, i, j)
            if (i, j) in found:
                assert lowest <= highest, f"{i}, {j} lie on no empty circle"
            else:
                assert lowest >= highest, f"{i}, {j} lie on a circle that all other points are strictly outside"


@pytest.mark.parametrize("size", [4, 5, 8, 20])
def test_the_star_by_inversion_equals_the_star_of_a_delaunay_triangulation(size):
    n_sets = 1000
    rng = np.random.default_rng(size)
    # Sets stand far apart, so the nearest size - 1 of each point are the others of its set: one call does them all.
    places = 100.0 * np.stack(np.divmod(np.arange(n_sets), 40), axis=1)
    uv = (places[:, None] + rng.random((n_sets, size, 2))).reshape(-1, 2)
    star = delaunay_star(flat(uv), nearest(flat(uv), size - 1))
    expected, on_hull = set(), np.zeros(len(uv), bool)
    for first in range(0, len(uv), size):
        triangulation = Delaunay(uv[first : first + size] - uv[first])
        expected |= edge_pairs(triangulation.simplices + first)
        on_hull[triangulation.convex_hull + first] = True
    assert star_pairs(star) == expected
    for i in np.flatnonzero(star.is_open != on_hull):
        others = np.delete(np.arange(i - i % size, i - i % size + size), i % size)
        assert abs(widest_gap(uv[others] - uv[i]) - np.pi) < 1e-6, "only a gap of pi up to 1e-6 may be told otherwise"


@settings(max_examples=100)
@given(integer_sets())
def test_stars_of_grid_points_are_delaunay_exactly(uv):
    assume(np.linalg.matrix_rank(uv - uv[0]) == 2)
    assert_star_is_delaunay(uv)


@settings(max_examples=40)
@given(cocircular_sets())
def test_stars_of_points_on_one_circle_are_delaunay_exactly(uv):
    assert_star_is_delaunay(uv)


@settings(max_examples=100)
@given(integer_sets())
def test_a_star_is_open_exactly_where_the_point_lies_on_the_hull(uv):
    assume(np.linalg.matrix_rank(uv - uv[0]) == 2)
    for i, is_open in enumerate(whole_star(uv).is_open):
        assert is_open == (widest_gap(np.delete(uv, i, axis=0) - uv[i]) > np.pi - 1e-7)


@settings(max_examples=20)
@given(rotations(), st.sampled_from([1.0, 1e-9, 1e9]), st.integers(4, 9), st.integers(4, 9))
def test_a_tilted_grid_has_symmetric_stars_of_four(rotation, scale, nx, ny):
    shape = grid(nx, ny)
    points = scale * (shape.points @ rotation.T)
    star = delaunay_star(points, nearest(points, 15))
    sides = np.array(((shape.uv == 0) | (shape.uv == [nx - 1, ny - 1])).sum(axis=1))
    assert np.array_equal(star.sizes, 4 - sides)
    assert np.array_equal(star.is_open, sides > 0)
    assert star_pairs(star) == {
        (i, j) for i, j in edge_pairs(shape.triangles) if abs(shape.uv[i] - shape.uv[j]).sum() == 1
    }


def assert_turns_left(star):
    """Check that consecutive neighbours turn anticlockwise by less than pi, once around where the star is closed."""
    for i in range(star.n_points):
        x, y = star.local[star.indptr[i] : star.indptr[i + 1]].T
        last = len(x) - 1 if star.is_open[i] else len(x)
        cross = x * np.roll(y, -1) - y * np.roll(x, -1)
        assert (cross[:last] > 0).all()
        turn = np.arctan2(cross, x * np.roll(x, -1) + y * np.roll(y, -1))[:last]
        assert turn.sum() < np.pi + 1e-5 if star.is_open[i] else abs(turn.sum() - 2 * np.pi) < 1e-9


@settings(max_examples=20)
@given(clouds())
def test_stars_run_once_around_their_centre_anticlockwise(points):
    assert_turns_left(delaunay_star(points, nearest(points, 15)))


@settings(max_examples=20)
@given(clouds())
def test_local_positions_are_projections_to_the_plane(points):
    around = nearest(points, 15)
    star = delaunay_star(points, around)
    offset = points[star.indices] - points[star.rows]
    height = (offset * normals(points, around)[star.rows]).sum(axis=1)
    assert np.allclose((star.local**2).sum(axis=1), (offset**2).sum(axis=1) - height**2, rtol=1e-9)


@settings(max_examples=20)
@given(clouds(), rotations(), st.tuples(*[st.floats(-100, 100)] * 3), st.floats(-9, 9))
def test_stars_do_not_depend_on_place_and_size(points, rotation, shift, exponent):
    moved = 10.0**exponent * (points @ rotation.T + shift)
    one, other = (delaunay_star(p, nearest(p, 15)) for p in (points, moved))
    assert star_pairs(one) == star_pairs(other)
    assert np.array_equal(one.is_open, other.is_open)


@settings(max_examples=20)
@given(clouds(), st.integers(-60, 60))
def test_stars_scaled_by_a_power_of_two_are_the_same_to_the_last_bit(points, exponent):
    scaled = np.ldexp(points, exponent)
    one, other = (delaunay_star(p, nearest(p, 15)) for p in (points, scaled))
    assert np.array_equal(one.indices, other.indices)
    assert np.array_equal(np.ldexp(one.local, exponent), other.local)


@settings(max_examples=20)
@given(clouds(), seeds)
def test_renumbered_points_have_renumbered_stars(points, seed):
    order = np.random.default_rng(seed).permutation(len(points))
    one, other = (delaunay_star(p, nearest(p, 15)) for p in (points, points[order]))
    assert {(order[i], order[j]) for i, j in star_pairs(other)} == star_pairs(one)


@settings(max_examples=20)
@given(planar_discs(), seeds)
def test_the_order_of_the_candidates_does_not_matter(shape, seed):
    around = nearest(shape.points, 15)
    mixed = np.random.default_rng(seed).permuted(around.indices.reshape(-1, 15), axis=1).ravel()
    one, other = (delaunay_star(shape.points, Neighborhoods(around.indptr, row)) for row in (around.indices, mixed))
    assert star_pairs(one) == star_pairs(other)


@settings(max_examples=20)
@given(planar_discs(smallest=60))
def test_stars_of_enough_neighbours_are_those_of_the_whole_triangulation(shape):
    star = delaunay_star(shape.points, ball(shape.points, 6 * shape.spacing))
    inner = ~star.is_open
    assert np.array_equal(np.flatnonzero(star.is_open), np.sort(shape.boundary))
    expected = edge_pairs(shape.triangles)
    assert {(i, j) for i, j in star_pairs(star) if inner[i]} == {(i, j) for i, j in expected if inner[i]}


@settings(max_examples=20)
@given(clouds())
def test_no_neighbour_is_steeper_than_the_limit(points):
    rough = points + [0, 0, 1] * np.random.default_rng(0).normal(0, 0.2, (len(points), 1))
    around = nearest(rough, 12)
    star = delaunay_star(rough, around)
    offset = rough[star.indices] - rough[star.rows]
    height = np.abs((offset * normals(rough, around)[star.rows]).sum(axis=1))
    assert (height <= (STEEPEST + 1e-9) * np.linalg.norm(offset, axis=1)).all()


def test_a_parallel_sheet_is_left_out():
    shape = grid(9, 9)
    sheets = np.r_[shape.points, shape.points + np.array([0, 0, 2])]
    star = delaunay_star(sheets, ball(sheets, 2.3), planes=nearest(sheets, 8))
    inner = np.flatnonzero(((shape.uv > 0) & (shape.uv < 8)).all(axis=1))
    for i in np.r_[inner, inner + 81]:
        row = star.indices[star.indptr[i] : star.indptr[i + 1]]
        assert sorted(row - i) == [-9, -1, 1, 9]
        assert not star.is_open[i]


def test_the_sheets_of_a_fold_are_not_joined():
    shape = add_noise(fold(3, nx=41, ny=15), sigma_in_spacings=0.02)
    star = delaunay_star(shape.points, nearest(shape.points, 20), planes=nearest(shape.points, 8))
    along = shape.uv[:, 0] - 20
    sheet = np.where(np.abs(along) > 3 * np.pi / 4, np.sign(along), 0)
    assert (sheet[star.rows] * sheet[star.indices] >= 0).all()


def test_neighbours_in_one_direction_leave_the_nearest():
    uv = np.array([[0, 0], [1, 0], [2, 0], [0, 3], [0, 1], [-1, 0], [-4, 0], [0, -1.0]])
    star = whole_star(uv)
    assert sorted(star.indices[: star.indptr[1]].tolist()) == [1, 4, 5, 7]


@pytest.mark.parametrize("ulps", [1, 3])
def test_neighbours_an_ulp_apart_do_not_break_a_star(ulps):
    points = relief(80, seed=4).points
    twins = points[5] + ulps * np.spacing(points[5])
    points = np.r_[points, [twins]]
    star = delaunay_star(points, nearest(points, 15))
    assert {(5, 80), (80, 5)} <= star_pairs(star)
    assert np.isfinite(star.local).all()


# Stars among more, where they ask for it


@pytest.mark.parametrize("stretch", [1, 2, 3])
def test_stars_of_a_scan_with_lines_far_apart_are_those_of_the_whole_triangulation(stretch):
    uv = disc(400, seed=3).uv * [1, stretch]
    star = nearest_star(flat(uv), nearest(flat(uv), 8))
    expected = edge_pairs(Delaunay(uv).simplices)
    closed = ~star.is_open
    # A star that is open among the nearest stays so: lines far apart are told from a boundary elsewhere.
    assert {(i, j) for i, j in star_pairs(star) if closed[i]} == {(i, j) for i, j in expected if closed[i]}
    assert closed.mean() > 0.8


@settings(max_examples=20)
@given(planar_discs(smallest=60), st.integers(12, 40))
def test_in_a_plane_the_number_of_nearest_does_not_matter(shape, k):
    one, other = (nearest_star(shape.points, nearest(shape.points, count)) for count in (k, 50))
    closed = ~one.is_open & ~other.is_open
    assert {(i, j) for i, j in star_pairs(one) if closed[i]} == {(i, j) for i, j in star_pairs(other) if closed[i]}


def test_stars_of_sheets_three_spacings_apart_are_those_of_each_alone():
    shape = disc(600, seed=1)
    sheets = np.r_[shape.points, shape.points + shape.spacing * np.array([0.3, 0.2, 3.0])]
    star, alone = (nearest_star(points, nearest(points, 20)) for points in (sheets, shape.points))
    assert {(i, j) for i, j in star_pairs(star) if i < 600} == star_pairs(alone)


# Smoothing


@settings(max_examples=10)
@given(planar_discs(smallest=60), rotations(), st.tuples(*[st.floats(-9, 9)] * 3))
def test_smoothing_leaves_the_points_of_any_plane_where_they_are(shape, rotation, shift):
    points = shape.points @ rotation.T + shift
    assert np.allclose(smooth(points, nearest(points, 20)), points, rtol=0, atol=1e-12)


@settings(max_examples=10)
@given(clouds(smallest=60), rotations(), st.floats(-6, 6), seeds)
def test_smoothing_moves_with_the_points_scales_with_them_and_ignores_their_order(points, rotation, exponent, seed):
    still = smooth(points, nearest(points, 20))
    moved = 10.0**exponent * (points @ rotation.T + 1)
    expected = 10.0**exponent * (still @ rotation.T + 1)
    assert np.allclose(smooth(moved, nearest(moved, 20)), expected, rtol=1e-9)
    order = np.random.default_rng(seed).permutation(len(points))
    assert np.allclose(smooth(points[order], nearest(points[order], 20)), still[order], rtol=0, atol=1e-12)


@pytest.mark.parametrize("sigma", [0.1, 0.25, 0.5])
@pytest.mark.parametrize("seed", range(2))
def test_smoothing_halves_the_noise_across_a_curved_surface_at_least(sigma, seed):
    cap = hemisphere(3000)
    noisy = add_noise(cap, sigma_in_spacings=sigma, seed=seed).points
    inside = cap.points[:, 2] > 4 * cap.spacing
    before, after = (np.linalg.norm(p[inside], axis=1) - 1 for p in (noisy, smooth(noisy, nearest(noisy, 20))))
    assert after.std() < 0.5 * before.std()


def test_along_the_surface_smoothing_moves_by_the_square_of_the_noise_only():
    sheet, sigmas, moves = disc(800, seed=2), np.array([0.05, 0.1, 0.2]), []
    height = np.random.default_rng(5).normal(size=(800, 1)) * [0, 0, sheet.spacing]
    for sigma in sigmas:
        noisy = sheet.points + sigma * height
        moves.append(np.abs(smooth(noisy, nearest(sheet.points, 20)) - noisy)[:, :2].mean())
    assert np.polyfit(np.log(sigmas), np.log(moves), 1)[0] == pytest.approx(2, abs=0.1)


def test_a_smoothed_sphere_shrinks_with_the_square_of_the_spacing():
    errors = []
    for n in (500, 2000, 8000):
        cap = hemisphere(n)
        radius = np.linalg.norm(smooth(cap.points, nearest(cap.points, 20)), axis=1)
        errors.append(1 - radius[cap.points[:, 2] > 0.5].mean())
    assert np.polyfit(np.log([1.0, 0.5, 0.25]), np.log(errors), 1)[0] == pytest.approx(2, abs=0.1)


def test_a_sheet_three_spacings_away_pulls_no_inner_point():
    sheet = grid(15, 12)
    sheets = np.r_[sheet.points, sheet.points + np.array([0.3, 0.2, 3.0])]
    inside = ((sheet.uv > 1) & (sheet.uv < [13, 10])).all(axis=1)
    assert np.abs(smooth(sheets, nearest(sheets, 20))[:180] - sheet.points)[inside].max() < 1e-12


@pytest.mark.parametrize("stage", [delaunay_star, nearest_star, normals, smooth])
def test_neighbourhoods_of_other_points_are_refused(stage):
    sheet = grid(6, 5)
    with pytest.raises(InputError, match="the neighbourhoods are those of 30 points, not of 29"):
        stage(sheet.points[:29], nearest(sheet.points, 8))
