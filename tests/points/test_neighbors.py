import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import clouds, rotations, seeds

from pointchart.errors import InputError
from pointchart.points.neighborhoods import Neighborhoods, from_pairs, rectangular
from pointchart.points.neighbors import ball, nearest, spacing
from pointchart.points.planes import normals
from pointchart.points.stars import delaunay_star
from pointchart.points.ties import break_ties
from pointchart.points.trees import BoxTree
from pointchart.shapes import bent_sheet, disc, grid, hemisphere, relief


def rows_of(neighborhoods):
    return np.split(neighborhoods.indices, neighborhoods.indptr[1:-1])


def distances(points):
    return np.linalg.norm(points[:, None] - points[None], axis=2)


@settings(max_examples=30)
@given(clouds(), st.floats(1.0, 4.0))
def test_a_ball_holds_exactly_the_points_that_are_nearer_than_its_radius(points, factor):
    radius = factor * spacing(points, k=1).max() * (1 + 1e-9)
    distance = distances(points)
    for i, row in enumerate(rows_of(ball(points, radius))):
        assert set(row.tolist()) == set(np.flatnonzero((distance[i] < radius) & (distance[i] > 0)).tolist())
        assert (np.diff(distance[i, row]) >= 0).all()


@settings(max_examples=20)
@given(clouds(), seeds)
def test_every_ball_may_have_its_own_radius(points, seed):
    radii = np.random.default_rng(seed).uniform(1.01, 3.0, len(points)) * spacing(points, k=1)
    inside = (distances(points) < radii[:, None]) & ~np.eye(len(points), dtype=bool)
    assert np.array_equal(ball(points, radii).sizes, inside.sum(axis=1))


@settings(max_examples=20)
@given(clouds())
def test_balls_of_one_radius_are_symmetric(points):
    hood = ball(points, 2 * spacing(points, k=1).max())
    pairs = set(zip(hood.rows.tolist(), hood.indices.tolist(), strict=True))
    assert pairs == {(j, i) for i, j in pairs}


def test_balls_are_open_and_grids_have_the_known_counts():
    x, y = np.meshgrid(np.arange(5.0), np.arange(5.0))
    grid = np.c_[x.ravel(), y.ravel(), np.zeros(25)]
    assert ball(grid, 2.0).sizes.reshape(5, 5)[2, 2] == 8
    assert ball(grid, np.nextafter(2.0, 3.0)).sizes.reshape(5, 5)[2, 2] == 12
    assert ball(grid, 1.1).sizes.reshape(5, 5)[0].tolist() == [2, 3, 3, 3, 2]


@settings(max_examples=30)
@given(clouds(), st.integers(1, 25))
def test_the_nearest_are_the_nearest_in_order_of_distance(points, k):
    distance = distances(points)
    np.fill_diagonal(distance, np.inf)
    found = nearest(points, k).indices.reshape(len(points), k)
    assert np.allclose(np.take_along_axis(distance, found, axis=1), np.sort(distance, axis=1)[:, :k], rtol=1e-12)


def test_the_nearest_are_all_others_where_there_are_few():
    points = hemisphere(9).points
    rows = rows_of(nearest(points, 50))
    assert all(sorted([i, *row.tolist()]) == list(range(9)) for i, row in enumerate(rows))


@settings(max_examples=30)
@given(clouds(smallest=8), st.integers(1, 25), seeds)
def test_a_tree_finds_the_nearest_of_points_in_any_order_for_any_of_them(points, k, seed):
    rng = np.random.default_rng(seed)
    mixed = rng.permutation(points)
    asked = rng.integers(0, len(points), 20).astype(np.int32)
    distance = distances(mixed)
    np.fill_diagonal(distance, np.inf)
    tree = BoxTree(mixed)
    found = tree.nearest(k, asked)
    far = np.take_along_axis(distance[asked], found, axis=1)
    assert np.allclose(far, np.sort(distance[asked], axis=1)[:, : found.shape[1]], rtol=1e-12)
    assert found.shape == (20, min(k, len(points) - 1))
    assert np.array_equal(tree.nearest(k)[asked], found)


@settings(max_examples=30)
@given(st.integers(1, 30), seeds)
def test_of_points_at_one_distance_those_of_smaller_coordinates_are_nearer(k, seed):
    corner = np.stack(np.meshgrid(range(6), range(5), range(3), indexing="ij"), axis=-1).reshape(-1, 3) * 1.0
    mixed = np.random.default_rng(seed).permutation(corner)
    square = ((mixed[:, None] - mixed) ** 2).sum(axis=2)
    expected = [np.lexsort((*mixed.T[::-1], row))[1 : k + 1].tolist() for row in square]
    assert BoxTree(mixed).nearest(k).tolist() == expected


@pytest.mark.parametrize("n", range(2, 20))
def test_points_on_a_line_are_found_in_turn(n):
    line = np.outer(2.0 ** np.arange(n), [1, 0, 0])
    found = BoxTree(line).nearest(n)
    assert [row.tolist() for row in found] == [[*range(i - 1, -1, -1), *range(i + 1, n)] for i in range(n)]


def test_neighbourhoods_of_one_size_are_the_rows_of_a_rectangle():
    hood = rectangular(np.array([[1, 2], [2, 0], [0, 1]]))
    assert hood.sizes.tolist() == [2, 2, 2]
    assert [row.tolist() for row in rows_of(hood)] == [[1, 2], [2, 0], [0, 1]]


def test_no_point_is_its_own_neighbour_even_where_points_coincide():
    points = np.r_[disc(30).points, disc(30).points, disc(30).points]
    hood = nearest(points, 2)
    assert (hood.sizes == 2).all()
    assert (hood.rows != hood.indices).all()


@pytest.mark.parametrize("k", [0, -3])
def test_a_count_below_one_is_refused(k):
    with pytest.raises(InputError, match=f"k is {k}; every point needs at least one neighbour"):
        nearest(disc(30).points, k)


@pytest.mark.parametrize("radius", [0.0, -1.0, float("nan")])
def test_a_radius_that_is_not_positive_is_refused(radius):
    with pytest.raises(InputError, match=f"the radius is {radius:g}; it has to be positive"):
        ball(disc(30).points, radius)


def test_lonely_points_are_named_with_the_distance_to_their_nearest():
    points = np.r_[disc(50).points, [[0, 0, 7], [0, 0, 10.5]]]
    message = "leaves points 50, 51 without any neighbour; the loneliest has its nearest at 3.5: use a larger radius"
    with pytest.raises(InputError, match=message):
        ball(points, 1.0)


@settings(max_examples=30)
@given(clouds(), st.integers(1, 9))
def test_spacing_is_the_median_distance_to_the_nearest(points, k):
    distance = np.sort(distances(points), axis=1)[:, 1 : k + 1]
    assert np.allclose(spacing(points, k=k), np.median(distance, axis=1), rtol=1e-12)
    assert np.array_equal(spacing(points, k=k), spacing(points, k=k, around=nearest(points, 12)))


@settings(max_examples=20)
@given(clouds(), st.floats(-9, 9))
def test_spacing_scales_with_the_points(points, exponent):
    scale = 10.0**exponent
    assert np.allclose(spacing(scale * points), scale * spacing(points), rtol=1e-12)


@settings(max_examples=20)
@given(clouds(), st.floats(-9, 9))
def test_ties_are_broken_by_less_than_a_hundredth_of_the_spacing_and_always_the_same_way(points, exponent):
    scaled = 10.0**exponent * points
    local = spacing(scaled)
    moved = break_ties(scaled, local)
    assert (np.abs(moved - scaled) <= 1.0001e-2 * local[:, None]).all()
    assert np.array_equal(moved, break_ties(scaled, local))


def test_broken_ties_let_the_stars_of_a_grid_agree_on_every_diagonal():
    shape = grid(12, 9)
    moved = break_ties(shape.points, spacing(shape.points))
    star = delaunay_star(moved, nearest(moved, 24))
    pairs = set(zip(star.rows.tolist(), star.indices.tolist(), strict=True))
    inner = ((shape.uv > 0) & (shape.uv < [11, 8])).all(axis=1)
    assert all((j, i) in pairs for i, j in pairs if inner[i] and inner[j])
    # A triangulation of m inner cells has m diagonals, so 4 sides and 2 ends of diagonals a point on average.
    assert 5 < star.sizes[inner].mean() < 7


@settings(max_examples=20)
@given(rotations(), st.floats(-1e3, 1e3))
def test_normals_of_a_plane_are_its_normal(rotation, offset):
    points = disc(60).points @ rotation.T + offset
    found = normals(points, nearest(points, 12))
    assert np.allclose(np.abs(found @ rotation[:, 2]), 1, atol=1e-10)
    assert np.allclose(np.linalg.norm(found, axis=1), 1, atol=1e-14)


def test_normals_equal_the_last_singular_vectors():
    points = hemisphere(300).points
    around = nearest(points, 12)
    for i, (row, normal) in enumerate(zip(rows_of(around), normals(points, around), strict=True)):
        local = points[np.r_[i, row]]
        expected = np.linalg.svd(local - local.mean(axis=0))[2][2]
        assert abs(expected @ normal) > 1 - 1e-10


def test_normals_of_a_cylinder_converge_to_the_radius_with_the_square_of_the_spacing():
    errors, counts = [], (21, 41, 81)
    for n in counts:
        sheet = bent_sheet(120, nx=n, ny=n)
        inner = (sheet.uv > 3).all(axis=1) & (sheet.uv < n - 4).all(axis=1)
        # Neighbours on one side only: on both sides the fit would be exact by symmetry.
        beside = np.flatnonzero(inner)[:, None] + np.array([1, n, n + 1])
        hood = from_pairs(np.repeat(np.flatnonzero(inner), 3), beside.ravel(), n * n)
        radial = sheet.points * [1, 0, 1] / np.hypot(sheet.points[:, 0], sheet.points[:, 2])[:, None]
        errors.append(np.arccos(np.abs((normals(sheet.points, hood) * radial).sum(axis=1)[inner]).clip(0, 1)).max())
    rate = np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert -1.2 < rate < -0.8


def test_pairs_are_gathered_by_their_centre():
    hood = from_pairs(np.array([0, 0, 2]), np.array([3, 1, 0]), 4)
    assert hood.indptr.tolist() == [0, 2, 2, 3, 3]
    assert hood.sizes.tolist() == [2, 0, 1, 0]
    assert hood.rows.tolist() == [0, 0, 2]
    assert hood.n_points == 4


@pytest.mark.parametrize("kind", [np.int32, np.int64, np.uint32])
def test_a_table_has_the_rows_of_the_neighbourhoods_in_the_same_types_always(kind):
    around = nearest(relief(60, seed=3).points, 9)
    indptr, indices = Neighborhoods(around.indptr.astype(kind), around.indices.astype(kind)).table
    assert (indptr.dtype, indices.dtype) == (np.uint64, np.uint32)
    assert np.array_equal(indptr, around.indptr)
    assert np.array_equal(indices, around.indices)
