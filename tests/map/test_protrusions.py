import numpy as np
import pytest

from pointchart import shapes
from pointchart.agreement.links import link_stars
from pointchart.map.convex_combination import parameterize
from pointchart.map.protrusions import COLLAPSED, _carried_on, parameterize_open
from pointchart.map.weights import trusted
from pointchart.mesh.planar_delaunay import coinciding
from pointchart.pipeline import reconstruct
from pointchart.points.neighborhoods import from_pairs
from pointchart.points.surroundings import explore


def parts_of(shape):
    links = link_stars(explore(shape.points).star)
    turns = np.arange(len(shape.boundary)) * 2 * np.pi / len(shape.boundary)
    return links.neighborhoods, trusted(links), np.column_stack([np.cos(turns), np.sin(turns)])


def jittered(length, seed=1, sigma=0.1):
    return shapes.add_noise(shapes.tube(length, n_around=16), sigma_in_spacings=sigma, seed=seed)


def test_a_map_in_which_nothing_collapses_is_the_convex_combination_map_itself():
    shape = shapes.hemisphere(400)
    graph, weights, layout = parts_of(shape)
    plain = parameterize(shape.points, shape.boundary, layout, graph, weights=weights)
    opened, kept = parameterize_open(shape.points, shape.boundary, layout, graph, weights=weights)
    assert np.array_equal(opened.uv, plain.uv)
    assert kept is weights


def test_a_tube_of_60_radii_collapses_and_is_opened():
    shape = jittered(60)
    graph, weights, layout = parts_of(shape)
    plain = parameterize(shape.points, shape.boundary, layout, graph, weights=weights)
    opened, kept = parameterize_open(shape.points, shape.boundary, layout, graph, weights=weights)
    assert len(coinciding(plain.uv)) > 100
    assert len(coinciding(opened.uv)) == 0
    lengths = np.linalg.norm(opened.uv[graph.indices] - opened.uv[graph.rows], axis=1)
    assert np.maximum.reduceat(lengths, graph.indptr[:-1]).min() > COLLAPSED
    new = kept(shape.points, graph)
    assert (new > 0).all()
    assert np.bincount(graph.rows, new) == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize(("length", "sigma"), [(1, 0.1), (20, 0.1), (60, 0.1), (60, 0.25), (120, 0.25), (200, 0.1)])
def test_a_noisy_tube_is_a_certified_disc(length, sigma):
    shape = jittered(length, sigma=sigma)
    certificate = reconstruct(shape.points, shape.boundary).certificate
    assert certificate.is_disc
    assert certificate.is_one_to_one
    assert certificate.longest_edge_over_spacing < 2.5


def test_a_stretch_that_grows_evenly_from_the_boundary_goes_on_evenly_where_it_is_lost():
    x = np.r_[0.0, np.cumsum(np.random.default_rng(2).uniform(0.5, 2.0, 29))]
    points = np.column_stack([x, 0 * x, 0 * x])
    steps = np.arange(29)
    rows, columns = np.r_[steps, steps + 1], np.r_[steps + 1, steps]
    order = np.argsort(rows, kind="stable")
    chain = from_pairs(rows[order], columns[order], 30)
    true = 3.0 + 0.7 * x
    seen = np.where(x < 9.0, true, np.nan)
    assert np.isnan(seen).sum() > 10
    assert _carried_on(seen, points, np.array([0]), chain) == pytest.approx(true, rel=1e-12)
