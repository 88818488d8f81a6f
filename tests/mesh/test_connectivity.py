import numpy as np
import pytest
from hypothesis import given, settings
from strategies import planar_discs

from pointchart import shapes
from pointchart.mesh.connectivity import boundary_loops, fans, half_edges, one_rings


def as_cycle(loop):
    turn = int(np.argmin(loop))
    return np.roll(loop, -turn).tolist()


def euler(edges, n_points):
    return n_points - (len(edges.twins) - int((edges.twins >= 0).sum()) // 2) + len(edges.twins) // 3


def test_twins_run_along_the_same_edge_the_other_way(any_disc):
    edges = half_edges(any_disc.triangles, len(any_disc.points))
    inner = np.flatnonzero(edges.twins >= 0)
    assert edges.n_overfull == 0
    assert np.array_equal(edges.twins[edges.twins[inner]], inner)
    assert np.array_equal(edges.origins[inner], edges.targets[edges.twins[inner]])
    assert np.array_equal(edges.targets[inner], edges.origins[edges.twins[inner]])


def test_half_edges_without_a_twin_are_those_of_one_triangle(any_disc):
    edges = half_edges(any_disc.triangles, len(any_disc.points))
    ends = np.sort(np.c_[edges.origins, edges.targets], axis=1)
    _, inverse, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    assert np.array_equal(count[inverse.ravel()] == 1, edges.twins < 0)


def test_the_boundary_of_a_disc_is_its_one_loop_with_the_surface_on_the_left(any_disc):
    edges = half_edges(any_disc.triangles, len(any_disc.points))
    (loop,) = boundary_loops(edges)
    assert as_cycle(loop) == as_cycle(any_disc.boundary)
    assert euler(edges, len(any_disc.points)) == 1


@pytest.mark.parametrize(
    ("shape", "lengths", "characteristic"),
    [(shapes.annulus(30, 4), [30, 30], 0), (shapes.sphere(200), [], 2), (shapes.torus(20, 9), [], 0)],
)
def test_surfaces_that_are_no_discs_have_the_known_loops(shape, lengths, characteristic):
    edges = half_edges(shape.triangles, len(shape.points))
    loops = boundary_loops(edges)
    assert [len(loop) for loop in loops] == lengths
    assert {frozenset(loop) for loop in loops} == {frozenset(loop) for loop in shape.loops}
    assert euler(edges, len(shape.points)) == characteristic
    assert edges.n_overfull == 0


def test_a_one_sided_strip_has_edges_that_turn_over():
    strip = shapes.moebius(20, 4)
    assert half_edges(strip.triangles, len(strip.points)).n_overfull == 2 * 3


def test_manifold_meshes_have_one_fan_a_point(any_disc):
    n = len(any_disc.points)
    assert (fans(half_edges(any_disc.triangles, n), n) == 1).all()


def test_fans_that_meet_in_a_point_are_counted():
    blades = np.array([[0, 1, 2], [0, 3, 4], [0, 4, 5], [0, 6, 7]])
    assert fans(half_edges(blades, 9), 9).tolist() == [3, 1, 1, 1, 1, 1, 1, 1, 0]


def test_one_rings_list_the_corners_of_the_triangles_of_each_point_anticlockwise(any_disc):
    n = len(any_disc.points)
    rings = one_rings(any_disc.triangles, n)
    assert np.array_equal(np.flatnonzero(rings.is_open), np.sort(any_disc.boundary))
    found = set()
    for i in range(n):
        row = rings.indices[rings.indptr[i] : rings.indptr[i + 1]].tolist()
        found |= {(i, *ends) for ends in zip(row, row[1:] + ([] if rings.is_open[i] else row[:1]), strict=False)}
    expected = np.concatenate([np.roll(any_disc.triangles, turn, axis=1) for turn in range(3)])
    assert found == set(map(tuple, expected.tolist()))


def test_rings_of_boundary_points_start_at_the_next_boundary_point(any_disc):
    rings = one_rings(any_disc.triangles, len(any_disc.points))
    loop = any_disc.boundary
    assert np.array_equal(rings.indices[rings.indptr[loop]], np.roll(loop, -1))
    assert np.array_equal(rings.indices[rings.indptr[loop + 1] - 1], np.roll(loop, 1))


@settings(max_examples=20)
@given(planar_discs())
def test_rings_are_as_long_as_edges_are_many(shape):
    n = len(shape.points)
    rings = one_rings(shape.triangles, n)
    assert rings.sizes.sum() == 2 * (3 * n - 3 - len(shape.boundary))


def test_points_in_no_triangle_have_an_empty_open_ring():
    rings = one_rings(np.array([[0, 1, 2]]), 5)
    assert rings.sizes.tolist() == [2, 2, 2, 0, 0]
    assert rings.is_open.all()
