import numpy as np
import pytest
from comparisons import edges_of, f1, same_loop
from hypothesis import given, settings
from strategies import planar_discs, rotations, seeds

from pointchart import shapes
from pointchart.agreement.links import link_stars
from pointchart.errors import InputError
from pointchart.mesh.connectivity import boundary_loops, editable_mesh, half_edges, one_rings
from pointchart.mesh.delaunay_swaps import swap_to_delaunay
from pointchart.mesh.quality import dihedral_angles
from pointchart.mesh.relocate import (
    JOURNAL,
    least_gain,
    mesh_energy,
    relocate_in_place,
    relocate_points,
    suspect_points,
)
from pointchart.points.neighborhoods import Neighborhoods
from pointchart.points.neighbors import nearest
from pointchart.points.surroundings import explore
from pointchart.proof.certificate import certify


def suspects_in(points, triangles, links, among=None):
    return suspect_points(links, editable_mesh(points, triangles, journal=0), among)


def put_astray(triangles, n_points, rng, n_moves):
    """Take random inner points out of a mesh, and split a random triangle by each."""
    for _ in range(n_moves):
        edges = half_edges(triangles, n_points)
        rim = edges.origins[edges.twins < 0]
        is_deep = np.bincount(triangles.ravel(), minlength=n_points) > 3
        is_deep[rim] = False
        v = int(rng.choice(np.flatnonzero(is_deep)))
        rest, fan = take_out(triangles, v)
        mesh = np.concatenate([rest, fan])
        if half_edges(mesh, n_points).n_overfull == 0:
            triangles = split(mesh, int(rng.integers(len(rest))), v)
    return triangles


def take_out(triangles, v):
    """Return the triangles without v, and a fan that closes the hole."""
    at_v = (triangles == v).any(axis=1)
    ring = _ring(triangles[at_v], v)
    return triangles[~at_v], np.array([[ring[0], ring[k], ring[k + 1]] for k in range(1, len(ring) - 1)])


def split(triangles, t, v):
    a, b, c = triangles[t]
    return np.concatenate([np.delete(triangles, t, axis=0), [[v, a, b], [v, b, c], [v, c, a]]])


def _ring(star, v):
    following = {}
    for triangle in star.tolist():
        k = triangle.index(v)
        following[triangle[(k + 1) % 3]] = triangle[(k + 2) % 3]
    ring = [next(iter(following))]
    while len(ring) < len(following):
        ring.append(following[ring[-1]])
    return ring


@settings(max_examples=15)
@given(planar_discs(smallest=30, largest=80), seeds, rotations())
def test_points_astray_in_a_planar_mesh_come_home_to_the_delaunay_triangulation(shape, seed, rotation):
    points = shape.points @ rotation.T
    true = swap_to_delaunay(points, shape.triangles).triangles
    astray = put_astray(true, len(points), np.random.default_rng(seed), 3)
    around = nearest(points, min(20, len(points) - 1))
    mesh, moves = astray, 1
    for _ in range(20):
        if moves == 0:
            break
        found = relocate_points(points, mesh, around, np.arange(len(points)))
        mesh, moves = swap_to_delaunay(points, found.triangles).triangles, found.n_moves
    assert moves == 0
    assert mesh_energy(points, mesh) <= mesh_energy(points, astray) * (1 + 1e-12)
    assert f1(edges_of(mesh), edges_of(true)) > 0.95


@settings(max_examples=15)
@given(planar_discs(smallest=20, largest=80), rotations())
def test_no_mesh_of_planar_points_has_less_energy_than_the_delaunay_triangulation(shape, rotation):
    points = shape.points @ rotation.T
    true = swap_to_delaunay(points, shape.triangles).triangles
    moved = relocate_points(points, true, nearest(points, min(20, len(points) - 1)), np.arange(len(points)))
    assert moved.n_moves == 0
    assert edges_of(moved.triangles) == edges_of(true)


def test_the_energy_is_the_formula_summed_over_triangles_and_inner_edges():
    shape = shapes.relief(150, seed=2)
    points, triangles = shape.points, shape.triangles
    corner = points[triangles]
    sides = np.stack([corner[:, k] - corner[:, k - 1] for k in range(3)])
    area = 0.5 * np.linalg.norm(np.cross(sides[0], sides[1]), axis=1)
    edges = half_edges(triangles, len(points))
    inner = np.flatnonzero(edges.twins > np.arange(len(edges.twins)))
    squares = ((points[edges.origins] - points[edges.targets]) ** 2).sum(axis=1)[inner]
    beside = area[inner // 3] + area[edges.twins[inner] // 3]
    turn = dihedral_angles(points, triangles, edges)
    expected = (area * (sides**2).sum(axis=(0, 2))).sum() + 2 * (squares * beside * np.sin(turn / 2) ** 4).sum()
    assert mesh_energy(points, triangles) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_moves_lower_the_energy_end_and_keep_disc_boundary_and_points(seed):
    shape = shapes.add_noise(shapes.hemisphere(500), sigma_in_spacings=0.3, seed=seed)
    n = len(shape.points)
    astray = put_astray(shape.triangles, len(shape.points), np.random.default_rng(seed), 30)
    around, everyone = nearest(shape.points, 20), np.arange(n)
    moved = relocate_points(shape.points, astray, around, everyone)
    assert moved.n_moves > 10
    assert mesh_energy(shape.points, moved.triangles) < mesh_energy(shape.points, astray)
    assert certify(shape.points, moved.triangles).is_disc
    (before,), (after,) = (boundary_loops(half_edges(t, n)) for t in (astray, moved.triangles))
    assert same_loop(after, before)
    last = moved
    for _ in range(20):
        if last.n_moves == 0:
            break
        last = relocate_points(shape.points, last.triangles, around, everyone)
    assert last.n_moves == 0
    assert mesh_energy(shape.points, last.triangles) <= mesh_energy(shape.points, moved.triangles)


@settings(max_examples=10, deadline=None)
@given(rotations(), seeds)
def test_the_moves_do_not_depend_on_turn_and_scale(rotation, seed):
    shape = shapes.relief(200, seed=4)
    astray = put_astray(shape.triangles, len(shape.points), np.random.default_rng(seed), 8)
    around, everyone = nearest(shape.points, 20), np.arange(len(shape.points))
    here = relocate_points(shape.points, astray, around, everyone)
    there = relocate_points(2.0**9 * (shape.points @ rotation.T), astray, around, everyone)
    assert edges_of(there.triangles) == edges_of(here.triangles)


def test_points_on_the_other_of_two_close_sheets_go_back_where_edge_swaps_leave_them():
    shape = shapes.fold(1.5, nx=41, ny=15)
    points, mesh = shape.points, shape.triangles
    for v in np.random.default_rng(0).choice(np.setdiff1d(np.arange(len(points)), shape.boundary), 10, replace=False):
        rest, fan = take_out(mesh, v)
        is_across = np.linalg.norm(shape.uv[rest].mean(axis=1) - shape.uv[v], axis=1) > 8
        distance = np.linalg.norm(points[rest].mean(axis=1) - points[v], axis=1)
        mesh = split(np.concatenate([rest, fan]), int(np.argmin(np.where(is_across, distance, np.inf))), v)
    swapped = swap_to_delaunay(points, mesh).triangles
    assert longest_in_plane(shape, swapped) > 8
    suspects = suspects_in(points, swapped, link_stars(explore(points).star).neighborhoods)
    moved = relocate_points(points, swapped, nearest(points, 20), suspects)
    assert moved.n_moves >= 10
    assert longest_in_plane(shape, moved.triangles) < 1.5  # edges and diagonals of the grid's squares


def longest_in_plane(shape, triangles):
    a, b = np.array(sorted(edges_of(triangles))).T
    return np.linalg.norm(shape.uv[a] - shape.uv[b], axis=1).max()


def test_nothing_is_suspect_on_a_clean_scan_and_points_astray_are():
    shape = shapes.hemisphere(600)
    star = explore(shape.points).star
    astray = put_astray(shape.triangles, len(shape.points), np.random.default_rng(3), 1)
    (v,) = np.flatnonzero(np.bincount(astray.ravel()) == 3)[:1]
    for links in (star, link_stars(star).neighborhoods):
        # Stars of the rim are hulls of their neighbours, and may reach along the rim past two others.
        assert set(suspects_in(shape.points, shape.triangles, links)) <= set(shape.boundary)
        assert v in suspects_in(shape.points, astray, links)


def two_edges_apart(shape):
    """Tell which pairs of points are at most two edges apart, (n, n), by powers of the adjacency matrix."""
    rings = one_rings(shape.triangles, len(shape.points))
    edge = np.eye(len(shape.points), dtype=int)
    edge[rings.rows, rings.indices] = 1
    return edge @ edge > 0


@settings(max_examples=15)
@given(planar_discs(smallest=20, largest=80), seeds)
def test_suspects_are_the_ends_of_links_of_more_than_two_edges(shape, seed):
    n, rng = len(shape.points), np.random.default_rng(seed)
    is_near = two_edges_apart(shape)
    sizes = rng.integers(0, 3, n)
    links = Neighborhoods(np.r_[0, np.cumsum(sizes)], rng.integers(0, n, sizes.sum()))
    is_far = ~is_near[links.rows, links.indices]
    expected = np.unique(np.r_[links.rows[is_far], links.indices[is_far]])
    assert suspects_in(shape.points, shape.triangles, links).tolist() == expected.tolist()
    among = rng.permutation(n)[: n // 2]
    is_far &= np.isin(links.rows, among)
    expected = np.unique(np.r_[links.rows[is_far], links.indices[is_far]])
    assert suspects_in(shape.points, shape.triangles, links, among).tolist() == expected.tolist()


def wheel(n_around, n_rings, *, is_whole):
    """Return rings of points around one that is joined to all of the first, or half of them, so that it is on the rim.

    All are in the order of the rings.
    """
    ring = 1 + np.arange(n_rings * n_around).reshape(n_rings, n_around)
    turn = (2 if is_whole else 1) * np.pi * np.arange(n_around) / n_around
    here, there = (ring, np.roll(ring, -1, axis=1)) if is_whole else (ring[:, :-1], ring[:, 1:])
    fan = np.stack([np.zeros_like(here[0]), here[0], there[0]], axis=-1)
    bands = [(here[:-1], here[1:], there[1:]), (here[:-1], there[1:], there[:-1])]
    triangles = np.concatenate([fan, *(np.stack(band, axis=-1).reshape(-1, 3) for band in bands)])
    rings = [np.zeros((1, 2)), *(r * np.c_[np.cos(turn), np.sin(turn)] for r in range(1, n_rings + 1))]
    uv = np.concatenate(rings)
    return shapes.Shape(np.c_[uv, np.zeros(len(uv))], triangles, uv)


@pytest.mark.parametrize("is_whole", [True, False])
def test_suspects_are_found_around_points_of_many_edges(is_whole):
    shape = wheel(45, 4, is_whole=is_whole)
    n, draft, is_near = (
        len(shape.points),
        editable_mesh(shape.points, shape.triangles, journal=0),
        two_edges_apart(shape),
    )
    assert not is_near.all(axis=1).any()
    for i in range(n):
        links = Neighborhoods(np.where(np.arange(n + 1) > i, n, 0), np.arange(n))
        expected = np.union1d(np.flatnonzero(~is_near[i]), [i])
        assert suspect_points(links, draft, np.array([i])).tolist() == expected.tolist()
        beside = np.flatnonzero(is_near[i])
        links = Neighborhoods(np.where(np.arange(n + 1) > i, len(beside), 0), beside)
        assert len(suspect_points(links, draft)) == 0


def astray_relief():
    shape = shapes.relief(200, seed=4)
    return shape, put_astray(shape.triangles, len(shape.points), np.random.default_rng(0), 8)


def test_no_point_moves_where_no_gain_is_enough():
    shape, astray = astray_relief()
    draft, everyone = editable_mesh(shape.points, astray, journal=JOURNAL), np.arange(len(shape.points))
    around = nearest(shape.points, 20)
    n_moves, is_touched = relocate_in_place(draft, around, everyone, np.inf)
    assert n_moves == is_touched.sum() == 0
    assert np.array_equal(draft.corners.reshape(-1, 3), astray)
    n_moves, is_touched = relocate_in_place(draft, around, everyone, least_gain(draft))
    assert n_moves > 0
    is_other = (draft.corners.reshape(-1, 3) != astray).any(axis=1)
    assert is_touched[draft.corners.reshape(-1, 3)[is_other]].all()


def test_the_least_gain_is_a_small_share_of_the_energy_of_a_triangle_in_any_unit():
    shape, _ = astray_relief()
    one, other = (least_gain(editable_mesh(unit * shape.points, shape.triangles, journal=0)) for unit in (1, 4.0))
    assert other == 4.0**4 * one
    assert 0 < one < 1e-3 * mesh_energy(shape.points, shape.triangles) / len(shape.triangles)


def test_without_near_points_nothing_moves():
    shape = shapes.disc(100, seed=1)
    nowhere = Neighborhoods(np.zeros(101, np.int64), np.zeros(0, np.int64))
    stayed = relocate_points(shape.points, shape.triangles, nowhere, np.arange(100))
    assert stayed.n_moves == 0
    assert np.array_equal(stayed.triangles, shape.triangles)


def test_a_mesh_that_leaves_a_point_out_is_refused():
    shape = shapes.disc(100, seed=1)
    more = np.vstack([shape.points, [0.0, 0, 1]])
    with pytest.raises(InputError, match="1 points are in no triangle"):
        relocate_points(more, shape.triangles, nearest(more, 10), np.arange(100))
