import copy

import numpy as np
import pytest
from comparisons import edges_of
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import planar_discs, rotations, seeds

from pointchart import shapes
from pointchart._kernels.mesh import curvature_swaps as kernels
from pointchart.mesh.connectivity import boundary_loops, half_edges
from pointchart.mesh.crease_swaps import (
    swap_to_least_curvature,
    swap_to_least_gaussian_curvature,
    swap_to_least_mean_curvature,
    swap_to_least_turn,
)
from pointchart.mesh.delaunay_swaps import swap_to_delaunay
from pointchart.pipeline import reconstruct
from pointchart.points.neighbors import spacing
from pointchart.proof.certificate import certify
from pointchart.runs.choices import SWAPS
from pointchart.runs.option_values import Swap


def bends(points, triangles):
    """Return the ends of the inner edges, their lengths and the angles between the normals there."""
    edges = half_edges(triangles, len(points))
    inner = np.flatnonzero(edges.twins > np.arange(len(edges.twins)))
    normal = np.cross(*(points[triangles[:, k]] - points[triangles[:, 0]] for k in (1, 2)))
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    cosine = np.einsum("ij,ij->i", normal[inner // 3], normal[edges.twins[inner] // 3])
    ends = np.column_stack([edges.origins[inner], edges.targets[inner]])
    return ends, np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1), np.arccos(np.clip(cosine, -1, 1))


def defects(points, triangles):
    """Return the angle defects, 0 on the boundary."""
    around = np.zeros(len(points))
    for k in range(3):
        u, v = (points[triangles[:, (k + step) % 3]] - points[triangles[:, k]] for step in (1, 2))
        cosine = np.einsum("ij,ij->i", u, v) / np.linalg.norm(u, axis=1) / np.linalg.norm(v, axis=1)
        np.add.at(around, triangles[:, k], np.arccos(np.clip(cosine, -1, 1)))
    defect = 2 * np.pi - around
    defect[np.concatenate(boundary_loops(half_edges(triangles, len(points))))] = 0
    return defect


def total_turn(points, triangles):
    return bends(points, triangles)[2].sum() / 2


def total_mean_curvature(points, triangles):
    _, lengths, angles = bends(points, triangles)
    return lengths @ angles / 2


def total_gaussian_curvature(points, triangles):
    return np.abs(defects(points, triangles)).sum()


def total_curvature(points, triangles):
    ends, lengths, angles = bends(points, triangles)
    h, s, k = np.zeros(len(points)), np.zeros(len(points)), defects(points, triangles)
    np.add.at(h, ends, np.column_stack([lengths * angles / 4] * 2))
    area = np.linalg.norm(np.cross(*(points[triangles[:, j]] - points[triangles[:, 0]] for j in (1, 2))), axis=1) / 2
    np.add.at(s, triangles, np.column_stack([area / 3] * 3))
    return np.where(k >= 0, 2 * h, 2 * np.sqrt(np.maximum(h * h - k * s, 0))).sum()


def cotangents(points, triangles):
    """Return the sum of the cotangents of all angles."""
    corners = points[triangles]
    squares = sum(((corners[:, k] - corners[:, k - 1]) ** 2).sum(axis=1) for k in range(3))
    doubled_area = np.linalg.norm(np.cross(*(corners[:, k] - corners[:, 0] for k in (1, 2))), axis=1)
    return np.minimum(squares / doubled_area / 2, kernels.MOST_COTANGENTS).sum()


TOTALS = {
    swap_to_least_turn: total_turn,
    swap_to_least_mean_curvature: total_mean_curvature,
    swap_to_least_gaussian_curvature: total_gaussian_curvature,
    swap_to_least_curvature: total_curvature,
}
IS_LENGTH = {swap_to_least_mean_curvature, swap_to_least_curvature}


def unit_of(swap, points):
    return spacing(points, k=1).mean() if swap in IS_LENGTH else 1.0


def total(swap, points, triangles):
    shape = unit_of(swap, points) * cotangents(points, triangles)
    return TOTALS[swap](points, triangles) + kernels.SHAPE_WEIGHT * shape


every_cost = pytest.mark.parametrize("swap", TOTALS)
every_bend = pytest.mark.parametrize("swap", [swap for swap in TOTALS if swap is not swap_to_least_gaussian_curvature])


@every_cost
@pytest.mark.parametrize("noise", [0.0, 0.1, 0.3])
def test_the_total_falls_and_the_mesh_settles_as_a_disc_with_its_boundary(any_disc, swap, noise):
    points = shapes.add_noise(any_disc, sigma_in_spacings=noise, seed=4).points
    swapped = swap(points, any_disc.triangles)
    before, after = (total(swap, points, triangles) for triangles in (any_disc.triangles, swapped.triangles))
    assert after < before if swapped.n_swaps else after == before
    assert swapped.is_settled
    assert certify(points, swapped.triangles, loop=any_disc.boundary).is_disc
    again = swap(points, swapped.triangles)
    assert again.n_swaps == 0
    assert np.array_equal(again.triangles, swapped.triangles)


@every_cost
@settings(max_examples=4)
@given(seed=seeds)
def test_no_single_swap_lowers_the_total_any_further(swap, seed):
    shape = shapes.add_noise(shapes.relief(30, seed=seed), sigma_in_spacings=0.2, seed=seed)
    least = swap(shape.points, shape.triangles).triangles
    edges = half_edges(least, len(shape.points))
    rounding = 2 * kernels.LEAST_GAIN * unit_of(swap, shape.points)
    for h in np.flatnonzero(edges.twins > np.arange(len(edges.twins))):
        t = edges.twins[h]
        a, b = edges.origins[h], edges.targets[h]
        c, d = (int(np.setdiff1d(least[k // 3], [a, b])[0]) for k in (h, t))
        if (min(c, d), max(c, d)) not in edges_of(least):
            swapped = least.copy()
            swapped[[h // 3, t // 3]] = [[c, a, d], [d, b, c]]
            before, after = (total(swap, shape.points, triangles) for triangles in (least, swapped))
            assert after > before - rounding


@every_cost
@settings(max_examples=10)
@given(shape=planar_discs(), rotation=rotations(), exponent=st.integers(-6, 6))
def test_planar_delaunay_meshes_are_left_as_they_are(swap, shape, rotation, exponent):
    swapped = swap(10.0**exponent * shape.points @ rotation.T, shape.triangles)
    assert swapped.n_swaps == 0
    assert np.array_equal(swapped.triangles, shape.triangles)


@every_bend
def test_the_convex_mesh_of_points_on_a_sphere_is_left_as_it_is(swap):
    cap = shapes.hemisphere(400)
    delaunay = swap_to_delaunay(cap.points, cap.triangles).triangles
    assert swap(cap.points, delaunay).n_swaps == 0


def folded_grid(angle, stretch):
    """Fold a grid along its middle column by an angle in degrees; return its points, triangles and crease edges."""
    flat = shapes.grid(9, 8)
    x, y = flat.uv.T
    half = np.deg2rad(angle) / 2
    points = np.column_stack([(x - 4) * np.cos(half), stretch * y, -np.abs(x - 4) * np.sin(half)])
    column = np.flatnonzero(x == 4)
    return points, flat.triangles, set(zip(column[:-1].tolist(), column[1:].tolist(), strict=True))


def crossed(triangles, crease, step):
    """Swap each edge of a crease, or only every second or third, for the edge that crosses it."""
    triangles = triangles.copy()
    edges = half_edges(triangles, triangles.max() + 1)
    for a, b in sorted(crease)[::step]:
        (h,) = np.flatnonzero((edges.origins == a) & (edges.targets == b))
        t = edges.twins[h]
        c, d = (int(np.setdiff1d(triangles[k // 3], [a, b])[0]) for k in (h, t))
        triangles[[h // 3, t // 3]] = [[c, a, d], [d, b, c]]
    return triangles


@pytest.mark.parametrize("angle", [10, 60, 90, 120])
@pytest.mark.parametrize("stretch", [0.5, 1.0, 2.0])
@pytest.mark.parametrize(
    ("swap", "step"),
    [(swap, step) for swap in TOTALS for step in (1, 2, 3) if (swap, step) != (swap_to_least_gaussian_curvature, 1)],
)
def test_a_folded_grid_gets_its_crease_back(swap, step, angle, stretch):
    points, triangles, crease = folded_grid(angle, stretch)
    start = crossed(triangles, crease, step)
    assert len(crease - edges_of(start)) == len(sorted(crease)[::step])
    assert crease <= edges_of(swap(points, start).triangles)


@every_cost
@settings(max_examples=10)
@given(rotation=rotations(), exponent=st.floats(-6, 6))
def test_swaps_do_not_depend_on_place_and_size(disc_shape, swap, rotation, exponent):
    shape = shapes.add_noise(disc_shape("relief"), sigma_in_spacings=0.1, seed=2)
    moved = 10.0**exponent * (shape.points @ rotation.T + [1, 2, 3])
    one, other = (swap(points, shape.triangles) for points in (shape.points, moved))
    assert edges_of(one.triangles) == edges_of(other.triangles)


@every_cost
def test_an_edge_stays_where_its_replacement_is_an_edge_already(swap):
    points = np.array([[0, 0, 9.0], [1, 0, 0], [-0.5, 0.8, 0], [-0.5, -0.8, 0]])
    assert swap(points, np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1]])).n_swaps == 0


def test_a_stepped_scan_is_certified_although_flat_treads_get_long_edges():
    """Bridges are looked for before: on a flat tread any edge is as good as another."""
    flat = shapes.disc(3000, seed=1)
    radius = np.linalg.norm(flat.uv, axis=1)
    steps = np.floor(4 * radius) + np.clip(5 * (4 * radius % 1.0) - 4, 0, 1)
    scan = np.column_stack([flat.uv, -0.05 * steps])
    result = reconstruct(scan, flat.boundary, swap=swap_to_least_turn)
    assert result.certificate.is_disc
    assert result.certificate.is_one_to_one


def test_every_word_of_the_command_line_names_its_swaps(disc_shape):
    shape = shapes.add_noise(disc_shape("relief"), sigma_in_spacings=0.1, seed=3)
    found = {word: edges_of(swap(shape.points, shape.triangles).triangles) for word, swap in SWAPS.items()}
    assert set(found) == set(Swap)
    for word, swap in zip(
        [Swap.normals, Swap.mean_curvature, Swap.gaussian_curvature, Swap.curvature], TOTALS, strict=True
    ):
        assert found[word] == edges_of(swap(shape.points, shape.triangles).triangles)


def test_the_corner_of_a_cube_turns_by_a_right_angle():
    points = np.r_[[[0.0, 0, 0]], np.eye(3)]
    edges = half_edges(np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1]]), 4)
    sums = np.empty((4, 3))
    kernels.sum_curvature(points, edges.origins, edges.twins, kernels.MEAN, sums)
    assert sums[0] == pytest.approx([np.pi / 2, 3 / 4 * np.pi / 2, 1 / 2])


def test_a_triangle_without_area_counts_as_folded_back():
    points = np.array([[0.0, 0, 0], [2, 0, 0], [1, 0, 0], [1, 1, 0]])
    assert kernels.turn_at_edge(points, 1, 0, 2, 3) == np.pi


@pytest.mark.parametrize("cost", [kernels.NORMALS, kernels.MEAN, kernels.GAUSSIAN, kernels.PRINCIPAL])
def test_the_compiled_descent_equals_its_python_function_for_every_cost(cost):
    shape = shapes.add_noise(shapes.relief(60, seed=3), sigma_in_spacings=0.2, seed=1)
    n, edges = len(shape.points), half_edges(shape.triangles, 60)
    sums = np.empty((n, 3))
    kernels.sum_curvature(shape.points, edges.origins, edges.twins, cost, sums)
    compiled = (shape.points, edges.origins, edges.twins, cost, 0.2, np.zeros(n, np.bool_), sums, np.zeros(n, np.int64))
    plain = copy.deepcopy(compiled)
    assert kernels.curvature_swaps(*compiled) == kernels.curvature_swaps.py_func(*plain) > 0
    assert np.array_equal(compiled[1], plain[1])
    assert np.allclose(compiled[5], plain[5], rtol=1e-12, atol=1e-12)
