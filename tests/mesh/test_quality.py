import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import flat, planar_discs, rotations, seeds

from pointchart.mesh.connectivity import half_edges
from pointchart.mesh.distortion import l2_stretch, least_distance, stretches
from pointchart.mesh.quality import area_vectors, dihedral_angles, edge_lengths, radius_ratios
from pointchart.shapes import bent_sheet, disc, grid, hemisphere

TRIANGLE = np.array([[0, 1, 2]])
HINGE = np.array([[0, 1, 2], [1, 0, 3]])


@settings(max_examples=20)
@given(planar_discs())
def test_every_edge_is_listed_once_with_its_length(shape):
    ends, lengths = edge_lengths(shape.points, half_edges(shape.triangles, len(shape.points)))
    found = np.sort(ends, axis=1)
    assert len(found) == 3 * len(shape.points) - 3 - len(shape.boundary)
    assert len(np.unique(found, axis=0)) == len(found)
    assert np.array_equal(lengths, np.linalg.norm(shape.points[ends[:, 0]] - shape.points[ends[:, 1]], axis=1))


@settings(max_examples=20)
@given(planar_discs(), rotations())
def test_areas_of_a_planar_disc_add_up_to_its_polygon(shape, rotation):
    x, y = shape.uv[shape.boundary].T
    polygon = 0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()
    vectors = area_vectors(shape.points @ rotation.T, shape.triangles)
    assert np.allclose(vectors.sum(axis=0), polygon * rotation[:, 2], rtol=0, atol=1e-12)
    assert np.isclose(np.linalg.norm(vectors, axis=1).sum(), polygon, rtol=1e-12)


def test_the_area_of_a_hemisphere_converges_with_the_square_of_the_spacing():
    counts = (200, 800, 3200)
    errors = []
    for n in counts:
        cap = hemisphere(n)
        errors.append(2 * np.pi - np.linalg.norm(area_vectors(cap.points, cap.triangles), axis=1).sum())
    rate = -2 * np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert 1.7 < rate < 2.3


@given(st.floats(0.0, np.pi))
def test_dihedral_angles_are_the_turn_of_the_surface(turn):
    points = np.array([[0.0, 0, 0], [0, 1, 0], [-1, 0.5, 0], [np.cos(turn), 0.5, np.sin(turn)]])
    assert np.allclose(dihedral_angles(points, HINGE, half_edges(HINGE, 4)), turn, rtol=0, atol=1e-12)


def test_a_rolled_grid_turns_by_the_same_angle_at_every_crease():
    sheet = bent_sheet(90, nx=10, ny=5)
    angles = dihedral_angles(sheet.points, sheet.triangles, half_edges(sheet.triangles, len(sheet.points)))
    creases = angles[angles > 1e-9]
    assert len(creases) == 8 * 4
    assert np.allclose(creases, np.radians(90) / 9, rtol=1e-12)


@pytest.mark.parametrize(
    ("corners", "ratio"),
    [
        ([[0, 0], [1, 0], [0.5, 3**0.5 / 2]], 1.0),
        ([[0, 0], [1, 0], [0, 1]], 2 * (np.sqrt(2) - 1)),
        ([[0, 0], [3, 0], [0, 4]], 0.8),
        ([[0, 0], [1, 0], [2, 0]], 0.0),
        ([[0, 0], [0, 0], [0, 0]], 0.0),
    ],
)
def test_radius_ratios_are_exact(corners, ratio):
    points = flat(np.array(corners, dtype=np.float64))
    assert np.allclose(radius_ratios(points, TRIANGLE), ratio, rtol=1e-14, atol=1e-14)


@settings(max_examples=30)
@given(seeds, rotations(), st.floats(-9, 9))
def test_radius_ratios_lie_between_flat_and_equilateral_at_any_size(seed, rotation, exponent):
    points = np.random.default_rng(seed).normal(size=(30, 3))
    triangles = np.arange(30).reshape(10, 3)
    ratios = radius_ratios(points, triangles)
    assert (ratios > 0).all()
    assert (ratios <= 1 + 1e-15).all()
    moved = 10.0**exponent * (points @ rotation.T)
    assert np.allclose(radius_ratios(moved, triangles), ratios, rtol=1e-6)


@pytest.mark.parametrize("angle", [1, 90, 270])
def test_a_rolled_sheet_has_hardly_any_stretch(angle):
    sheet = bent_sheet(angle, nx=61, ny=21)
    chord = np.sin(np.radians(angle) / 120) / (np.radians(angle) / 120)
    largest, smallest = stretches(sheet.points, sheet.triangles, sheet.uv)
    assert np.allclose(largest / smallest, 1 / chord, rtol=1e-12)
    assert np.isclose(l2_stretch(sheet.points, sheet.triangles, sheet.uv), 1, atol=(1 - chord))


@settings(max_examples=20)
@given(planar_discs(), rotations(), st.floats(-6, 6), st.floats(-6, 6))
def test_the_stretch_of_an_isometry_is_one_at_any_size(shape, rotation, exponent, uv_exponent):
    points = 10.0**exponent * (shape.points @ rotation.T + 3)
    uv = 10.0**uv_exponent * shape.uv[:, ::-1] + 2
    largest, smallest = stretches(points, shape.triangles, uv)
    assert np.allclose(largest, 1, rtol=1e-6)
    assert np.allclose(smallest, 1, rtol=1e-6)
    assert np.isclose(l2_stretch(points, shape.triangles, uv), 1, rtol=1e-6)


@settings(max_examples=20)
@given(planar_discs(), st.floats(1.0, 50.0))
def test_stretches_of_an_affine_map_are_its_singular_values(shape, ratio):
    largest, smallest = stretches(shape.points * [ratio, 1, 1], shape.triangles, shape.uv)
    assert np.allclose(largest, np.sqrt(ratio), rtol=1e-9)
    assert np.allclose(smallest, 1 / np.sqrt(ratio), rtol=1e-9)
    exact = np.sqrt((ratio + 1 / ratio) / 2)
    assert np.isclose(l2_stretch(shape.points * [ratio, 1, 1], shape.triangles, shape.uv), exact, rtol=1e-9)


@settings(max_examples=30)
@given(planar_discs(), seeds)
def test_the_l2_stretch_is_at_least_one(shape, seed):
    uv = np.random.default_rng(seed).normal(size=shape.uv.shape)
    assert l2_stretch(shape.points, shape.triangles, uv) >= 1


def test_a_flat_triangle_of_the_plane_has_infinite_stretch():
    shape = grid(3, 3)
    uv = shape.uv.copy()
    uv[4] = uv[1]
    assert l2_stretch(shape.points, shape.triangles, uv) == float("inf")


def test_the_least_distance_is_that_of_the_nearest_pair():
    uv = disc(200, seed=2).uv
    distance = np.linalg.norm(uv[:, None] - uv[None], axis=2)[~np.eye(200, dtype=bool)]
    assert np.isclose(least_distance(uv), distance.min(), rtol=1e-14)
    assert least_distance(np.r_[uv, [uv[3] + [1e-14, 0]]]) < 1.1e-14
    assert least_distance(np.r_[uv, [uv[3]]]) == 0
