import numpy as np
import pytest
from hypothesis import given, settings
from strategies import clouds

from pointchart.agreement.links import LONE_TRUST, disputed_links, link_stars, tie_down
from pointchart.errors import InputError
from pointchart.pipeline import reconstruct
from pointchart.points.neighbors import nearest
from pointchart.points.stars import delaunay_star
from pointchart.shapes import add_noise, disc, fold, grid, hemisphere, relief
from pointchart.solve.reach import cut_points


def links_of(points, k=15):
    return link_stars(delaunay_star(points, nearest(points, k)))


def pairs_of(links):
    graph = links.neighborhoods
    return dict(zip(zip(graph.rows.tolist(), graph.indices.tolist(), strict=True), links.trust, strict=True))


@settings(max_examples=20)
@given(clouds())
def test_links_are_symmetric_and_so_is_their_trust(points):
    found = pairs_of(links_of(points))
    assert all(found[j, i] == trust for (i, j), trust in found.items())
    assert set(found.values()) <= {LONE_TRUST, 1.0}
    assert all(i != j for i, j in found)


@settings(max_examples=20)
@given(clouds())
def test_links_are_exactly_the_pairs_of_which_one_star_holds_the_other(points):
    star = delaunay_star(points, nearest(points, 15))
    held = set(zip(star.rows.tolist(), star.indices.tolist(), strict=True))
    assert set(pairs_of(link_stars(star))) == held | {(j, i) for i, j in held}


def stars_triangles(star):
    """List the triangles of each star as sets of corners."""
    triangles = []
    for i in range(star.n_points):
        row = star.indices[star.indptr[i] : star.indptr[i + 1]].tolist()
        ends = zip(row, row[1:] + ([] if star.is_open[i] else row[:1]), strict=False)
        triangles += [frozenset((i, j, k)) for j, k in ends if j != k]
    return triangles


def held_by_two(star):
    triangles = stars_triangles(star)
    return {t for t in triangles if triangles.count(t) > 1}


@settings(max_examples=20)
@given(clouds())
def test_a_link_has_full_trust_exactly_on_triangles_that_two_stars_hold(points):
    star = delaunay_star(points, nearest(points, 15))
    agreed = held_by_two(star)
    for (i, j), trust in pairs_of(link_stars(star)).items():
        assert (trust == 1.0) == any({i, j} <= t for t in agreed)


def test_inner_links_of_a_plane_are_all_trusted():
    shape = disc(300, seed=5)
    star = delaunay_star(shape.points, nearest(shape.points, 24))
    links = link_stars(star)
    inner = ~star.is_open
    rows, columns = links.neighborhoods.rows, links.neighborhoods.indices
    assert (links.trust[inner[rows] & inner[columns]] == 1.0).all()


def test_links_across_a_fold_are_trusted_less_than_those_along_it():
    shape = add_noise(fold(1.2, nx=41, ny=15), sigma_in_spacings=0.1, seed=1)
    links = links_of(shape.points, 20)
    apart = np.abs(shape.uv[links.neighborhoods.rows, 0] - shape.uv[links.neighborhoods.indices, 0]) > 4
    assert links.trust[apart].mean() < 0.5 < links.trust[~apart].mean()


def test_links_need_ordered_neighbours():
    with pytest.raises(InputError, match="only ordered neighbourhoods can agree on triangles"):
        link_stars(nearest(disc(40).points, 6))


# Disputes


@settings(max_examples=20)
@given(clouds())
def test_a_link_is_disputed_exactly_where_no_triangle_of_its_star_on_it_is_held_by_another(points):
    star = delaunay_star(points, nearest(points, 15))
    held = held_by_two(star)
    expected = []
    for i in range(star.n_points):
        row = star.indices[star.indptr[i] : star.indptr[i + 1]].tolist()
        ends = zip(row, row[1:] + ([] if star.is_open[i] else row[:1]), strict=False)
        agreed = {end for pair in ends if frozenset((i, *pair)) in held for end in pair}
        expected.append(len(set(row) - agreed))
    assert disputed_links(star).tolist() == expected


@settings(max_examples=20)
@given(clouds())
def test_a_link_keeps_full_trust_unless_both_its_stars_dispute_it(points):
    star = delaunay_star(points, nearest(points, 15))
    links = link_stars(star)
    settled = disputed_links(star) == 0
    both = settled[links.neighborhoods.rows] & settled[links.neighborhoods.indices]
    assert (links.trust[both] == 1.0).all()


def test_inside_a_plane_no_link_is_disputed():
    shape = disc(300, seed=5)
    star = delaunay_star(shape.points, nearest(shape.points, 24))
    assert disputed_links(star)[~star.is_open].sum() == 0


def test_noise_and_close_sheets_raise_the_number_of_disputed_links():
    smooth, noisy = (add_noise(relief(600, seed=2), sigma_in_spacings=sigma).points for sigma in (0.05, 0.5))
    flat, folded = (
        add_noise(shape, sigma_in_spacings=0.05).points for shape in (grid(41, 15), fold(1.2, nx=41, ny=15))
    )
    for clear, messy in ((smooth, noisy), (flat, folded)):
        few, many = (disputed_links(delaunay_star(points, nearest(points, 20))).sum() for points in (clear, messy))
        assert many > 10 * few


def test_disputes_need_ordered_neighbours():
    with pytest.raises(InputError, match="only ordered neighbourhoods can agree on triangles; use Delaunay stars"):
        disputed_links(nearest(disc(40).points, 6))


def test_links_that_are_given_besides_are_added_both_ways_and_trusted_least():
    points = relief(300, seed=1).points
    star, others = delaunay_star(points, nearest(points, 20)), nearest(points, 8)
    before, after = pairs_of(link_stars(star)), pairs_of(link_stars(star, also=others))
    assert all(after[pair] == trust for pair, trust in before.items())
    added = set(zip(others.rows.tolist(), others.indices.tolist(), strict=True))
    added |= {(j, i) for i, j in added}
    assert set(after) == set(before) | added
    assert {after[pair] for pair in added - set(before)} == {LONE_TRUST}


def with_clump(apart):
    """Return a dome and a clump of 60 points over its top, some spacings apart."""
    dome = hemisphere(2000)
    top = dome.points[np.argmax(dome.points[:, 2])]
    scatter = np.random.default_rng(0).normal(size=(60, 3)) * [2.3, 2.3, 0.2] * dome.spacing
    return np.concatenate([dome.points, top * (1.0 + apart * dome.spacing) + scatter]), dome.boundary


@pytest.mark.parametrize("apart", [3.0, 4.5])
def test_a_clump_over_the_surface_is_tied_down_and_nothing_else_changes(apart):
    points, loop = with_clump(apart)
    links = links_of(points)
    before, tied = pairs_of(links), tie_down(points, links, loop)
    after = pairs_of(tied)
    assert (cut_points(tied.neighborhoods, loop) == -1).all()
    assert before.items() <= after.items()
    hanging = set(np.flatnonzero(cut_points(links.neighborhoods, loop) != -1))
    new = after.keys() - before.keys()
    assert all((i in hanging) != (j in hanging) and after[i, j] == LONE_TRUST for i, j in new)
    assert (len(new) > 0) == (len(hanging) > 0) == (apart == 4.5)


def test_a_clump_that_hangs_on_one_point_is_meshed_as_a_part_of_a_certified_disc():
    points, loop = with_clump(4.5)
    assert reconstruct(points, loop).certificate.is_as_asked
