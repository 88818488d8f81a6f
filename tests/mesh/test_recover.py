import numpy as np
import pytest
from comparisons import edges_of, f1, mixed_in_plane, same_loop
from hypothesis import given, settings
from strategies import planar_discs, rotations, seeds

from pointchart import shapes
from pointchart.agreement.links import Links, link_stars
from pointchart.mesh.connectivity import boundary_loops, half_edges, one_rings
from pointchart.mesh.delaunay_swaps import swap_to_delaunay
from pointchart.mesh.planar_delaunay import triangulate
from pointchart.mesh.recover import recover_links
from pointchart.mesh.relocate import mesh_energy
from pointchart.pipeline import reconstruct
from pointchart.plane.exact_signs import orientation_signs
from pointchart.points.neighborhoods import Neighborhoods
from pointchart.points.surroundings import explore
from pointchart.proof.certificate import certify


def links_of(triangles, n):
    """Every edge of a mesh as a trusted link."""
    rings = one_rings(triangles, n)
    return Links(rings, np.ones(len(rings.indices)))


@settings(max_examples=15)
@given(planar_discs(smallest=20, largest=60), seeds, rotations())
def test_the_edges_of_a_planar_delaunay_triangulation_are_recovered_from_any_other(shape, seed, rotation):
    mixed = mixed_in_plane(shape, seed)
    true = swap_to_delaunay(shape.points, shape.triangles).triangles
    points = shape.points @ rotation.T
    recovered = recover_links(points, shape.uv, mixed, links_of(true, len(points)))
    assert f1(edges_of(recovered.triangles), edges_of(true)) >= f1(edges_of(mixed), edges_of(true))
    assert (orientation_signs(shape.uv, recovered.triangles) == 1).all()
    again = recover_links(points, shape.uv, recovered.triangles, links_of(true, len(points)))
    assert again.n_recovered + again.n_missed <= recovered.n_recovered + recovered.n_missed


def test_a_narrow_map_gives_a_wrong_triangulation_that_recovery_mends():
    """The Delaunay triangulation of a map that is narrow in one direction joins points that are far apart."""
    shape = shapes.disc(600, seed=1)
    narrow = shape.uv * [1.0, 40.0]
    triangles = triangulate(narrow, shape.boundary)
    true = edges_of(swap_to_delaunay(shape.points, shape.triangles).triangles)
    recovered = recover_links(shape.points, narrow, triangles, link_stars(explore(shape.points).star))
    assert f1(edges_of(triangles), true) < 0.6
    assert f1(edges_of(recovered.triangles), true) > 0.95


@pytest.mark.parametrize("seed", range(3))
def test_recovery_never_raises_the_energy_and_keeps_the_disc(seed):
    shape = shapes.add_noise(shapes.relief(400, seed=seed), sigma_in_spacings=0.2, seed=seed)
    n = len(shape.points)
    links = link_stars(explore(shape.points).star)
    loose = shapes.planar.delaunay(shape.uv)
    loose = loose if len(boundary_loops(half_edges(loose, n))) == 1 else shape.triangles
    recovered = recover_links(shape.points, shape.uv, loose, links)
    assert mesh_energy(shape.points, recovered.triangles) <= mesh_energy(shape.points, loose) * (1 + 1e-12)
    assert certify(shape.points, recovered.triangles).is_disc
    (before,), (after,) = (boundary_loops(half_edges(t, n)) for t in (loose, recovered.triangles))
    assert same_loop(after, before)


def test_links_across_to_another_sheet_are_missed_not_made():
    """Sheets one spacing apart: half the stars' links cross over, and a mesh with them would cost more."""
    shape = shapes.fold(1.0, nx=41, ny=15)
    n = len(shape.points)
    rows = np.arange(n)
    across = rows[(shape.uv[:, 0] < shape.uv[:, 0].mean() - 8) & ~np.isin(rows, shape.boundary)]
    partner = [
        int(np.argmin(np.linalg.norm(shape.points - shape.points[i], axis=1) + 1e9 * _near(shape, i))) for i in across
    ]
    links = _pairs(across, np.array(partner), n)
    recovered = recover_links(shape.points, shape.uv, shape.triangles, links)
    assert recovered.n_recovered == 0
    assert recovered.n_missed > 50


def _near(shape, i):
    return np.linalg.norm(shape.uv - shape.uv[i], axis=1) < 8


def _pairs(one, other, n):
    rows, columns = np.concatenate([one, other]), np.concatenate([other, one])
    order = np.argsort(rows, kind="stable")
    indptr = np.concatenate([[0], np.cumsum(np.bincount(rows, minlength=n))])
    return Links(Neighborhoods(indptr, columns[order]), np.ones(len(rows)))


@pytest.mark.parametrize("gap", [3.0, 4.0])
def test_every_edge_on_folded_sheets_three_spacings_apart_joins_neighbours_of_the_grid(gap):
    shape = shapes.fold(gap)
    result = reconstruct(shape.points, shape.boundary)
    a, b = np.array(sorted(edges_of(result.triangles))).T
    assert result.certificate.is_one_to_one
    assert np.linalg.norm(shape.uv[a] - shape.uv[b], axis=1).max() < 1.5


@pytest.mark.parametrize("name", ["club", "hand", "maze"])
def test_the_mesh_of_a_real_scan_has_the_energy_of_the_true_surface(name, scan):
    """On the regular grid of the maze all other diagonals are as good, so the energy tells and not the edges."""
    points, triangles, loop = scan(name)
    result = reconstruct(points, loop)
    assert result.certificate.is_one_to_one
    assert mesh_energy(points, result.triangles) == pytest.approx(mesh_energy(points, triangles), rel=0.01)


@pytest.mark.parametrize(("name", "least"), [("club", 0.985), ("hand", 0.998), ("nefertiti_uneven", 0.985)])
def test_the_edges_of_a_real_scan_are_those_of_the_true_surface(name, least, scan):
    points, triangles, loop = scan(name)
    assert f1(edges_of(reconstruct(points, loop).triangles), edges_of(triangles)) >= least
