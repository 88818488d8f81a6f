"""Meshes of trimmed surfaces: discs with holes whose areas and edges are known."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pointchart.errors import InputError
from pointchart.mesh.connectivity import boundary_loops, fans, half_edges
from pointchart.mesh.quality import area_vectors, radius_ratios
from pointchart.plane.exact_signs import orientation_signs
from pointchart.surface import BSplineSurface, evaluate, tessellate

UNIT = np.array([0.0, 0, 1, 1])
BOX = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])


@dataclass
class Sphere:
    """The unit sphere by longitude and latitude."""

    def derivatives(self, uv, du=0, dv=0):
        u, v = (uv + np.array([du, dv]) * np.pi / 2).T
        return np.stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v) * (du == 0)], axis=1)


def rectangle(width, height):
    corners = np.array([[[0.0, 0, 0], [0, height, 0]], [[width, 0, 0], [width, height, 0]]])
    return BSplineSurface(1, UNIT, UNIT, corners)


def ring(n, radius, center=(0.5, 0.5), *, is_hole=False):
    turn = np.arange(n) * 2 * np.pi / n * (-1 if is_hole else 1)
    return np.array(center) + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)


def polygon_area(loop):
    x, y = loop.T
    return 0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()


def area(points, triangles):
    return np.linalg.norm(area_vectors(points, triangles), axis=1).sum()


def assert_disc(triangles, uv, n_holes):
    """Check that every point is used in one fan, triangles are anticlockwise and bound 1 + n_holes loops."""
    edges = half_edges(triangles, len(uv))
    assert edges.n_overfull == 0
    assert (fans(edges, len(uv)) == 1).all()
    assert (orientation_signs(uv, triangles) == 1).all()
    n_edges = np.count_nonzero(edges.twins < np.arange(len(edges.twins)))
    assert len(uv) - n_edges + len(triangles) == 1 - n_holes
    assert len(boundary_loops(edges)) == 1 + n_holes


@settings(max_examples=25)
@given(st.integers(3, 40), st.integers(0, 3), st.integers(1, 600), st.floats(0.3, 1.0), st.floats(0.05, 20.0))
def test_a_trimmed_surface_is_a_disc_with_its_holes(n_corners, n_holes, n, depth, width):
    outer = 0.5 + (ring(2 * n_corners, 0.5) - 0.5) * np.resize([1.0, depth], 2 * n_corners)[:, None]
    centers = 0.5 + (ring(3, 0.05) - 0.5)
    holes = [ring(5, 0.02, center, is_hole=True) for center in centers[:n_holes]]
    _, triangles, uv = tessellate(rectangle(width, 1.0), [outer, *holes], n)
    assert_disc(triangles, uv, n_holes)
    expected = sum(map(polygon_area, [outer, *holes]))
    assert np.isclose(area(np.c_[uv, 0 * uv[:, 0]], triangles), expected, rtol=1e-12)


def test_points_are_those_of_the_surface_and_the_loops_are_among_them():
    loops = [ring(30, 0.5), ring(12, 0.2, is_hole=True)]
    points, _, uv = tessellate(Sphere(), loops, 400)
    assert np.array_equal(points, evaluate(Sphere(), uv))
    assert all((uv == corner).all(axis=1).any() for loop in loops for corner in loop)


def test_a_plane_with_a_hole_has_the_area_of_its_polygons():
    loops = [BOX, ring(60, 0.25, is_hole=True)]
    points, triangles, _ = tessellate(rectangle(3.0, 2.0), loops, 500)
    assert np.isclose(area(points, triangles), 6 * sum(map(polygon_area, loops)), rtol=1e-12)


def test_the_area_of_a_patch_of_the_sphere_converges_with_the_square_of_the_spacing():
    corners = np.array([[0.0, 0], [1, 0], [1, np.pi / 6], [0, np.pi / 6]])
    counts = (100, 400, 1600, 6400)
    errors = [0.5 - area(*tessellate(Sphere(), [corners], n)[:2]) for n in counts]
    rate = -2 * np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert 1.8 < rate < 2.2


@pytest.mark.parametrize("width", [0.01, 0.7, 1.0, 1.4, 3.0, 100.0])
def test_triangles_are_no_slivers_however_the_surface_is_stretched(width):
    points, triangles, _ = tessellate(rectangle(width, 1.0), [BOX], 3000)
    ratios = radius_ratios(points, triangles)
    assert np.median(ratios) > 0.8
    assert np.percentile(ratios, 1) > 0.5


@pytest.mark.parametrize("n", [500, 5000])
def test_the_points_are_about_as_many_as_asked_for(n):
    _, _, uv = tessellate(rectangle(1.0, 1.0), [ring(24, 0.5), ring(12, 0.2, is_hole=True)], n)
    assert n < len(uv) + 60 < 1.25 * n + 120


def test_every_inner_edge_of_a_plane_is_delaunay():
    points, triangles, _ = tessellate(rectangle(1.0, 1.0), [ring(24, 0.5), ring(12, 0.2, is_hole=True)], 800)
    edges = half_edges(triangles, len(points))
    apex = np.roll(triangles, -2, axis=1).ravel()
    a, b = points[edges.origins] - points[apex], points[edges.targets] - points[apex]
    angle = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(axis=1))
    inner = np.flatnonzero(edges.twins >= 0)
    assert (angle[inner] + angle[edges.twins[inner]]).max() <= np.pi + 1e-9


def test_a_spike_of_a_thousandth_keeps_its_sides():
    spiky = np.array([[0.0, 0], [1, 0], [1, 1], [0.501, 1], [0.5, 0.01], [0.499, 1], [0, 1]])
    _, triangles, uv = tessellate(rectangle(1.0, 1.0), [spiky], 100)
    assert_disc(triangles, uv, 0)
    assert np.isclose(area(np.c_[uv, 0 * uv[:, 0]], triangles), polygon_area(spiky), rtol=1e-12)


def star(seed, n, tail):
    """Return a star-shaped polygon, the logarithms of whose radii have heavy tails: needles and cracks."""
    rng = np.random.default_rng(seed)
    turn = (np.arange(n) + 0.8 * rng.random(n)) * 2 * np.pi / n
    radius = np.exp(tail * rng.standard_t(2, n).clip(-8, 8))
    return radius[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)


def comb(n, width):
    teeth = np.arange(n)[:, None] + [0, width / 2, width]
    upper = np.stack([teeth, 0 * teeth + [0, 1, 0]], axis=2).reshape(-1, 2)
    return np.concatenate([[[-1, -1], [n, -1]], upper[::-1]])


def spiral(n, turns, gap):
    turn = np.linspace(1, turns * 2 * np.pi, n)
    ray = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    return np.concatenate([(turn + gap)[:, None] * ray, (turn[:, None] * ray)[::-1]])


def assert_filled(loops, n):
    """Check that the loops, with all their sides or pieces of them, are the boundary of a disc of their area."""
    _, triangles, uv = tessellate(rectangle(1.0, 1.0), loops, n)
    assert_disc(triangles, uv, len(loops) - 1)
    edges = half_edges(triangles, len(uv))
    rim = np.flatnonzero(edges.twins < 0)
    ahead = dict(zip(edges.origins[rim].tolist(), edges.targets[rim].tolist(), strict=True))
    number = {tuple(place): k for k, place in enumerate(uv.tolist())}
    for loop in loops:
        size = np.ptp(loop, axis=0).max()
        for start, end in zip(loop, np.roll(loop, -1, axis=0), strict=True):
            k, last = number[tuple(start)], number[tuple(end)]
            while (k := ahead[k]) != last:
                off = (end - start)[0] * (uv[k] - start)[1] - (end - start)[1] * (uv[k] - start)[0]
                assert abs(off) <= 1e-14 * size * np.linalg.norm(end - start)
    expected = sum(map(polygon_area, loops))
    box = np.ptp(loops[0], axis=0).prod()
    assert abs(area(np.c_[uv, 0 * uv[:, 0]], triangles) - expected) < 1e-12 * box


@settings(max_examples=20)
@given(st.integers(0, 2**32), st.integers(3, 300), st.floats(0.0, 1.5), st.integers(1, 2000))
def test_stars_of_needles_and_cracks_keep_their_sides(seed, n_corners, tail, n):
    assert_filled([star(seed, max(n_corners, 4), tail)], n)


@settings(max_examples=20)
@given(st.integers(0, 2**32), st.integers(8, 100), st.integers(1, 2000))
def test_ragged_holes_keep_their_sides(seed, n_corners, n):
    outer = star(seed, n_corners, 0.3)
    outer *= 1 / np.linalg.norm(outer, axis=1).min()
    inner = star(seed + 1, n_corners, 0.3)[::-1]
    inner *= 0.2 / np.linalg.norm(inner, axis=1).max()
    assert_filled([10 * outer, inner, inner + np.array([0.5, 0])], n)


@pytest.mark.parametrize("width", [0.5, 1e-6, 1e-9, 1e-12, 1e-14])
@pytest.mark.parametrize("n", [1, 300, 5000])
def test_needle_teeth_keep_their_sides(width, n):
    assert_filled([comb(20, width)], n)


@pytest.mark.parametrize("gap", [3.0, 1e-3, 1e-9])
def test_spirals_keep_their_sides(gap):
    assert_filled([spiral(300, 5, gap)], 3000)


@pytest.mark.parametrize("gap", [1e-3, 1e-9, 1e-13])
def test_a_fine_hole_very_near_to_a_long_side_keeps_its_sides(gap):
    assert_filled([BOX, ring(1000, 0.5 - gap, is_hole=True)], 50)


def test_thousands_of_ragged_corners_keep_their_sides():
    assert_filled([star(5, 4000, 0.5)], 100_000)


def test_fine_loops_that_cross_are_refused():
    with pytest.raises(InputError, match="loops 0 and 1 cross or touch each other"):
        tessellate(rectangle(1.0, 1.0), [ring(4000, 0.5), ring(4000, 0.3, (0.5, 0.75), is_hole=True)], 100_000)


FAULTS = {
    r"there are no loops; give the outer one": [],
    r"loop 0 has shape \(2, 2\); at least 3 finite corners": [BOX[:2]],
    r"loop 0 of 4 corners crosses or touches itself": [BOX[[0, 2, 1, 3]]],
    r"loop 0 of 5 corners crosses or touches itself": [BOX[[0, 1, 1, 2, 3]]],
    r"loop 0 has the signed area -1, but the outer loop runs anticlockwise; reverse it": [BOX[::-1]],
    r"loop 1 has the signed area 0.02.*, but a hole runs clockwise; reverse it": [BOX, ring(9, 0.1)],
    r"1 holes are together as large as loop 0": [BOX, BOX[::-1] - 0.5],
    r"loop 1 lies outside loop 0 or in another hole": [BOX, ring(9, 0.1, (3.0, 0.5), is_hole=True)],
    r"loop 2 lies outside loop 0 or in another": [BOX, ring(9, 0.3, is_hole=True), ring(9, 0.1, is_hole=True)],
}


@pytest.mark.parametrize("message", FAULTS)
def test_a_faulty_loop_is_named_with_its_remedy(message):
    with pytest.raises(InputError, match=message):
        tessellate(rectangle(1.0, 1.0), FAULTS[message], 50)


@pytest.mark.parametrize("hole", [ring(9, 0.52, is_hole=True), BOX[[0, 3, 2, 1]] / 2 + 0.75, BOX[[0, 3, 2, 1]] / 2])
def test_loops_that_cross_or_touch_are_refused(hole):
    with pytest.raises(InputError, match=r"loops 0 and 1 cross or touch each other; draw them apart"):
        tessellate(rectangle(1.0, 1.0), [BOX, hole], 50)


def test_no_points_are_refused():
    with pytest.raises(InputError, match="0 points cannot fill a surface; ask for at least 1"):
        tessellate(rectangle(1.0, 1.0), [BOX], 0)
