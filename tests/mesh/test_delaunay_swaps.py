import numpy as np
import pytest
from comparisons import edges_of, f1, flip_at_random, mixed_in_plane
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay
from strategies import flat, planar_discs, rotations, seeds

from pointchart.boundary.layout import on_circle
from pointchart.boundary.steps import chord_length_steps
from pointchart.map.convex_combination import parameterize
from pointchart.map.weights import mean_value, reciprocal_distance, shape_preserving
from pointchart.mesh.connectivity import boundary_loops, half_edges, one_rings
from pointchart.mesh.delaunay_swaps import swap_in_place, swap_to_delaunay
from pointchart.mesh.planar_delaunay import triangulate
from pointchart.plane.exact_signs import orientation_signs
from pointchart.points.neighbors import nearest
from pointchart.points.stars import delaunay_star
from pointchart.proof.certificate import certify
from pointchart.shapes import tube

MAPS = {
    "reciprocal weights on the 20 nearest": (reciprocal_distance, lambda points: nearest(points, 20)),
    "shape-preserving weights on stars": (shape_preserving, lambda points: delaunay_star(points, nearest(points, 20))),
    "mean value weights on stars": (mean_value, lambda points: delaunay_star(points, nearest(points, 20))),
}


@settings(max_examples=15)
@given(planar_discs(smallest=20, largest=60), seeds, rotations())
def test_any_triangulation_of_planar_points_ends_at_the_delaunay_triangulation(shape, seed, rotation):
    mixed = mixed_in_plane(shape, seed)
    swapped = swap_to_delaunay(shape.points @ rotation.T, mixed)
    assert edges_of(swapped.triangles) == edges_of(Delaunay(shape.uv).simplices)
    assert (orientation_signs(shape.uv, swapped.triangles) == 1).all()
    assert swapped.is_settled
    assert swapped.n_swaps > 0


@settings(max_examples=15)
@given(planar_discs(smallest=40, largest=200), seeds, st.integers(1, 20))
def test_swaps_begun_where_a_delaunay_triangulation_was_changed_restore_it(shape, seed, n_flips):
    delaunay = swap_to_delaunay(shape.points, shape.triangles).triangles

    def is_plane(flipped):
        return (orientation_signs(shape.uv, flipped) == 1).all()

    changed = flip_at_random(delaunay, is_plane, np.random.default_rng(seed), n_flips)
    is_touched = np.zeros(len(shape.points), bool)
    is_touched[changed[(changed != delaunay).any(axis=1)]] = True
    edges = half_edges(changed, len(shape.points))
    _, is_settled = swap_in_place(shape.points, edges.origins, edges.twins, is_touched=is_touched)
    assert is_settled
    assert edges_of(edges.origins.reshape(-1, 3)) == edges_of(delaunay)


def test_where_no_point_is_touched_no_edge_is_swapped(disc_shape):
    shape = disc_shape("relief")
    mixed = flip_at_random(shape.triangles, lambda flipped: True, np.random.default_rng(0), 20)
    edges = half_edges(mixed, len(shape.points))
    nowhere = np.zeros(len(shape.points), bool)
    assert swap_in_place(shape.points, edges.origins, edges.twins, is_touched=nowhere) == (0, True)
    assert np.array_equal(edges.origins.reshape(-1, 3), mixed)


@settings(max_examples=15)
@given(seeds, st.integers(0, 400))
def test_swaps_of_any_mesh_keep_a_disc_and_its_boundary_and_end(seed, n_flips):
    shape = tube(2, n_around=10)
    mixed = flip_at_random(shape.triangles, lambda flipped: True, np.random.default_rng(seed), n_flips)
    swapped = swap_to_delaunay(shape.points, mixed)
    certificate = certify(shape.points, swapped.triangles, loop=shape.boundary)
    assert certificate.is_disc, certificate.faults
    assert len(swapped.triangles) == len(shape.triangles)
    again = swap_to_delaunay(shape.points, swapped.triangles)
    assert again.n_swaps == 0 or not swapped.is_settled


def test_swaps_keep_the_boundary_and_settle(any_disc):
    swapped = swap_to_delaunay(any_disc.points, any_disc.triangles)
    assert swapped.is_settled
    (before,), (after,) = (
        boundary_loops(half_edges(triangles, len(any_disc.points)))
        for triangles in (any_disc.triangles, swapped.triangles)
    )
    assert np.array_equal(before, after)
    assert certify(any_disc.points, swapped.triangles, loop=any_disc.boundary).is_disc


def test_a_second_run_swaps_nothing(any_disc):
    once = swap_to_delaunay(any_disc.points, any_disc.triangles)
    twice = swap_to_delaunay(any_disc.points, once.triangles)
    assert twice.n_swaps == 0
    assert np.array_equal(once.triangles, twice.triangles)


@settings(max_examples=10)
@given(rotations(), st.floats(-9, 9))
def test_swaps_do_not_depend_on_place_and_size(disc_shape, rotation, exponent):
    shape = disc_shape("relief")
    moved = 10.0**exponent * (shape.points @ rotation.T + [1, 2, 3])
    one, other = (swap_to_delaunay(points, shape.triangles) for points in (shape.points, moved))
    assert edges_of(one.triangles) == edges_of(other.triangles)


def map_and_mesh(points, loop, name):
    weights, neighborhoods = MAPS[name]
    rim = on_circle(chord_length_steps(points, loop))
    uv = parameterize(points, loop, rim, neighborhoods(points), weights=weights).uv
    return swap_to_delaunay(points, triangulate(uv, loop)).triangles


@pytest.mark.parametrize("name", MAPS)
# The rolled sheet is left out: a grid has two equally good diagonals in each cell.
@pytest.mark.parametrize("shape", ["relief", "thinned relief", "hemisphere", "cap of 150 degrees", "tube", "face"])
def test_every_map_of_the_right_topology_ends_in_the_same_mesh(disc_shape, shape, name):
    shape = disc_shape(shape)
    true = swap_to_delaunay(shape.points, shape.triangles).triangles
    found = map_and_mesh(shape.points, shape.boundary, name)
    assert f1(edges_of(found), edges_of(true)) > 0.999


@pytest.mark.parametrize("name", MAPS)
def test_the_true_mesh_of_a_scanned_foot_is_found_by_every_map(scan, name):
    foot = scan("foot")
    found = map_and_mesh(foot.points, foot.loop, name)
    assert f1(edges_of(found), edges_of(foot.triangles)) > 0.999


def test_the_mean_value_map_of_a_mesh_to_the_circle_is_one_to_one(any_disc):
    rim = on_circle(chord_length_steps(any_disc.points, any_disc.boundary))
    rings = one_rings(any_disc.triangles, len(any_disc.points))
    uv = parameterize(any_disc.points, any_disc.boundary, rim, rings, weights=mean_value).uv
    assert (orientation_signs(uv, any_disc.triangles) == 1).all()


@settings(max_examples=8)
@given(seeds)
def test_even_a_mesh_with_random_edges_is_mapped_one_to_one(disc_shape, seed):
    shape = disc_shape("tube")
    mixed = flip_at_random(shape.triangles, lambda flipped: True, np.random.default_rng(seed), 60)
    rim = on_circle(chord_length_steps(shape.points, shape.boundary))
    uv = parameterize(shape.points, shape.boundary, rim, one_rings(mixed, len(shape.points)), weights=mean_value).uv
    assert (orientation_signs(uv, mixed) == 1).all()


def test_an_edge_stays_where_its_replacement_is_an_edge_already():
    # A tetrahedron without its base: the only inner edges meet in the tip, and all three ends are joined.
    points = np.array([[0, 0, 9.0], [1, 0, 0], [-0.5, 0.8, 0], [-0.5, -0.8, 0]])
    triangles = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1]])
    assert swap_to_delaunay(points, triangles).n_swaps == 0


def test_the_given_triangles_are_not_changed():
    kite = np.array([[0, 1, 2], [1, 0, 3]])
    points = flat(np.array([[0.0, 0], [9, 0], [4, 1], [4, -1]]))
    swapped = swap_to_delaunay(points, kite)
    assert swapped.n_swaps == 1
    assert kite.tolist() == [[0, 1, 2], [1, 0, 3]]
    assert edges_of(swapped.triangles) == {(0, 2), (0, 3), (1, 2), (1, 3), (2, 3)}
