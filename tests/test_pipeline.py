from functools import partial

import numpy as np
import pytest
from comparisons import edges_of, f1, in_rows
from scans import SIMULATED, square_layout

from pointchart import (
    InputError,
    ball,
    bicgstab,
    centripetal_steps,
    chord_length_steps,
    delaunay_star,
    keep_edges,
    mean_value,
    multigrid,
    nearest,
    on_circle,
    on_square,
    parameterize_scan,
    reciprocal_distance,
    reconstruct,
    shape_preserving,
    shapes,
    swap_to_delaunay,
    uniform,
    uniform_steps,
    uv_of_points,
    uv_on_mesh,
)
from pointchart.boundary import places_of
from pointchart.mesh.connectivity import half_edges

NEIGHBORS = {
    "ball": lambda shape: partial(ball, radius=3 * shape.spacing),
    "nearest": lambda shape: partial(nearest, k=20),
    "delaunay": lambda shape: stars,
}
METHODS = [
    ("ball", uniform),
    ("ball", reciprocal_distance),
    ("nearest", uniform),
    ("nearest", reciprocal_distance),
    ("delaunay", uniform),
    ("delaunay", reciprocal_distance),
    ("delaunay", shape_preserving),
    ("delaunay", mean_value),
]


def stars(points):
    return delaunay_star(points, nearest(points, 20))


@pytest.mark.parametrize(("neighbors", "weights"), METHODS, ids=lambda x: x if isinstance(x, str) else x.__name__)
@pytest.mark.parametrize("name", ["relief", "hemisphere"])
def test_after_the_swaps_every_method_finds_the_edges_of_the_surface(name, neighbors, weights):
    shape = SIMULATED[name]()
    result = reconstruct(shape.points, shape.boundary, connect=NEIGHBORS[neighbors](shape), weights=weights)
    truth = swap_to_delaunay(shape.points, shape.triangles).triangles
    assert f1(edges_of(result.rows[result.triangles]), edges_of(truth)) > 0.99


@pytest.mark.parametrize("neighbors", ["ball", "nearest"])
@pytest.mark.parametrize(("weights", "named"), [(shape_preserving, "shape-preserving"), (mean_value, "mean value")])
def test_weights_that_need_a_star_say_so(neighbors, weights, named):
    shape = SIMULATED["hemisphere"]()
    with pytest.raises(InputError, match=f"{named} weights need .*; use Delaunay stars"):
        reconstruct(shape.points, connect=NEIGHBORS[neighbors](shape), weights=weights)


@pytest.mark.parametrize("name", SIMULATED)
def test_linked_stars_find_the_edges_of_the_surface(name):
    shape = SIMULATED[name]()
    result = reconstruct(shape.points, shape.boundary)
    truth = swap_to_delaunay(shape.points, shape.triangles).triangles
    assert f1(edges_of(result.rows[result.triangles]), edges_of(truth)) > 0.99
    assert result.certificate.is_disc
    assert result.certificate.is_one_to_one


def test_a_disc_on_n_points_with_b_on_the_boundary_has_2n_less_b_less_2_triangles(any_disc):
    result = reconstruct(any_disc.points, any_disc.boundary)
    assert len(result.triangles) == 2 * len(any_disc.points) - len(any_disc.boundary) - 2
    assert result.rows.tolist() == list(range(len(any_disc.points)))
    assert set(result.triangles.ravel()) == set(range(len(any_disc.points)))


def test_without_swaps_the_mesh_is_that_of_the_parameters():
    shape = SIMULATED["sculpture"]()
    kept = reconstruct(shape.points, swap=keep_edges)
    swapped = reconstruct(shape.points)
    truth = edges_of(swap_to_delaunay(shape.points, shape.triangles).triangles)
    assert kept.evidence.counts.n_swaps == 0
    assert f1(edges_of(kept.triangles), truth) < f1(edges_of(swapped.triangles), truth)


@pytest.mark.parametrize("solver", [bicgstab, multigrid])
def test_the_solver_does_not_change_the_mesh(solver):
    shape = SIMULATED["hemisphere"]()
    assert in_rows(reconstruct(shape.points, solver=solver)) == in_rows(reconstruct(shape.points))


def test_weights_of_the_users_own_are_taken():
    def bell(points, around):
        offset = np.linalg.norm(points[around.indices] - points[around.rows], axis=1)
        weights = np.exp(-((offset / 0.1) ** 2))
        return weights / np.bincount(around.rows, weights)[around.rows]

    shape = SIMULATED["relief"]()
    result = reconstruct(shape.points, connect=partial(nearest, k=15), weights=bell)
    assert in_rows(result) == in_rows(reconstruct(shape.points))


@pytest.mark.parametrize("name", SIMULATED)
def test_uv_on_the_mesh_is_one_to_one_and_uv_of_the_points_is_the_first_map(name):
    shape = SIMULATED[name]()
    on_mesh = reconstruct(shape.points, chart=uv_on_mesh, connect=partial(nearest, k=20), weights=reciprocal_distance)
    of_points = reconstruct(
        shape.points, chart=uv_of_points, connect=partial(nearest, k=20), weights=reciprocal_distance
    )
    survey, alone = parameterize_scan(shape.points, connect=partial(nearest, k=20), weights=reciprocal_distance)
    assert on_mesh.certificate.flat_or_folded_uv == 0
    assert np.array_equal(of_points.uv, alone.uv[np.argsort(survey.cloud.rows)])
    assert np.array_equal(of_points.evidence.solve.values, of_points.uv)
    assert np.allclose(of_points.evidence.first_solve.values, of_points.uv, atol=1e-12)
    assert in_rows(of_points) == in_rows(on_mesh)
    assert not np.allclose(of_points.uv, on_mesh.uv)


def test_planar_points_come_back_exactly_from_a_boundary_that_is_laid_out_as_it_lies():
    flat = shapes.disc(500, seed=3)
    result = reconstruct(flat.points, flat.boundary, layout=lambda points, loop: points[loop, :2])
    assert np.abs(result.uv - flat.uv).max() < 1e-13


def test_parameters_of_the_scan_alone_reproduce_planar_points():
    flat = shapes.disc(500, seed=3)
    survey, mapped = parameterize_scan(
        flat.points, flat.boundary, weights=shape_preserving, layout=lambda points, loop: points[loop, :2]
    )
    assert np.abs(mapped.uv - flat.uv[survey.cloud.rows]).max() < 1e-13


@pytest.mark.parametrize("shape", [shapes.relief(600, seed=2), shapes.grid(15, 12), shapes.hemisphere(500)], ids=repr)
def test_a_square_has_exact_corners_and_sides_and_is_one_to_one(shape):
    result = reconstruct(shape.points, layout=square_layout)
    rim, u, v = result.uv[result.loop], *result.uv.T
    for corner in ([0, 0], [1, 0], [1, 1], [0, 1]):
        assert (rim == corner).all(axis=1).sum() == 1
    assert (((rim == 0) | (rim == 1)).any(axis=1)).all()
    assert result.certificate.is_one_to_one
    mesh = half_edges(result.triangles, len(result.uv))
    a, b = mesh.origins[mesh.twins >= 0], mesh.targets[mesh.twins >= 0]
    for side in (u == 0, u == 1, v == 0, v == 1):
        assert not (side[a] & side[b]).any()


def test_corners_can_be_chosen():
    sheet = shapes.grid(9, 7)
    corners = [8, 62, 54, 0]
    result = reconstruct(
        sheet.points,
        layout=lambda points, loop: on_square(chord_length_steps(points, loop), places_of(corners, loop)),
    )
    assert result.uv[corners].tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]


@pytest.mark.parametrize("steps", [chord_length_steps, uniform_steps, centripetal_steps])
def test_the_spacing_of_the_boundary_does_not_change_the_mesh(steps):
    shape = SIMULATED["hemisphere"]()
    result = reconstruct(shape.points, layout=lambda points, loop: on_circle(steps(points, loop)))
    assert in_rows(result) == in_rows(reconstruct(shape.points))
    assert np.linalg.norm(result.uv[result.loop], axis=1) == pytest.approx(1)
    assert np.allclose(result.uv[result.loop], on_circle(steps(shape.points, result.loop)))
