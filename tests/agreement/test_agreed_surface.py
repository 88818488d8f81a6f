from dataclasses import replace

import numpy as np
import pytest
from comparisons import as_set, mixed
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import planar_discs, seeds

from pointchart import InputError, delaunay_star, nearest, shapes, spacing
from pointchart.agreement.agreed_surface import collect_agreed, patchwork
from pointchart.boundary import is_same_loop, rims
from pointchart.mesh.connectivity import half_edges
from pointchart.points.ties import break_ties

STRIPS = {
    "narrow": lambda: shapes.moebius(12, 2),
    "strip": lambda: shapes.moebius(30, 5),
    "wide": lambda: shapes.moebius(64, 9, width=1.2),
}


@st.composite
def soups(draw):
    """Triangles between a few points, many to an edge, none twice: (triangles, n_points)."""
    rng, n = np.random.default_rng(draw(seeds)), draw(st.integers(4, 12))
    corners = np.array([rng.permutation(n)[:3] for _ in range(draw(st.integers(1, 60)))])
    first = np.sort(np.unique(np.sort(corners, axis=1), axis=0, return_index=True)[1])
    return corners[first], n


def sides_by_ends(surface):
    """Return the triangles at each edge that has any."""
    found = {}
    for ends, sides in zip(surface.ends.tolist(), surface.sides.tolist(), strict=True):
        faces = [frozenset(surface.triangles[t].tolist()) for t in sides if t >= 0]
        if faces:
            found[frozenset(ends)] = set(faces)
    return found


def n_overfull(surface, of):
    """Count half-edges that share their direction, among some triangles."""
    return half_edges(surface.triangles[of], surface.n_points).n_overfull


def assert_edges_fit(surface):
    """Check that edge k lies opposite to corner k, and that its sides are the triangles that name it."""
    naming = {e: set() for e in range(len(surface.ends))}
    for t, (corners, edges) in enumerate(zip(surface.triangles.tolist(), surface.edge_of.tolist(), strict=True)):
        for k, e in enumerate(edges):
            assert surface.ends[e].tolist() == sorted(corners[:k] + corners[k + 1 :])
            naming[e].add(t)
    for e, sides in enumerate(surface.sides.tolist()):
        assert set(sides) - {-1} == naming[e]
        assert len(naming[e]) == sum(side >= 0 for side in sides)
        assert sides[0] >= 0 or sides[1] < 0


# Two triangles at an edge, the best first


@given(soups())
def test_an_edge_has_two_triangles_at_most_and_a_triangle_left_out_has_an_edge_with_two(soup):
    surface = patchwork(*soup)
    assert_edges_fit(surface)
    sides = sides_by_ends(surface)
    left = as_set(soup[0]) - as_set(surface.triangles)
    assert all(any(len(sides.get(face - {v}, ())) == 2 for v in face) for face in left)


@given(soups(), st.integers(1, 60))
def test_what_is_taken_of_the_best_does_not_depend_on_the_others(soup, count):
    triangles, n = soup
    whole, best = patchwork(triangles, n), patchwork(triangles[:count], n)
    oriented, alone = (as_set(surface.triangles[surface.part >= 0]) for surface in (whole, best))
    assert alone == oriented & as_set(triangles[:count])


def test_triangles_are_taken_in_their_order():
    fan = np.array([[0, 1, k] for k in range(2, 6)])
    for order in ([0, 1, 2, 3], [3, 2, 1, 0], [2, 0, 3, 1]):
        assert as_set(patchwork(fan[order], 6).triangles) == as_set(fan[order[:2]])


def test_without_triangles_there_is_no_surface():
    surface = patchwork([], 5)
    assert (len(surface.triangles), len(surface.ends), rims(surface)) == (0, 0, [])


def test_agreed_triangles_have_at_most_two_at_an_edge(any_disc):
    points, step = any_disc.points, spacing(any_disc.points)
    surface = collect_agreed(points, delaunay_star(break_ties(points, step), nearest(points)), step)
    assert_edges_fit(surface)
    assert n_overfull(surface, surface.part >= 0) == 0


@given(planar_discs(smallest=60))
@settings(max_examples=10)
def test_stars_of_a_planar_disc_agree_on_its_triangulation_but_for_slivers_at_the_rim(shape):
    step = spacing(shape.points)
    surface = collect_agreed(shape.points, delaunay_star(shape.points, nearest(shape.points, 30)), step)
    assert as_set(surface.triangles) <= as_set(shape.triangles)
    inner = shape.triangles[~np.isin(shape.triangles, shape.boundary).any(axis=1)]
    assert as_set(inner) <= as_set(surface.triangles)


def test_triangles_that_bridge_a_gap_are_left_out():
    sheet = shapes.grid(5, 4)
    halves = sheet.points + [3.9, 0, 0] * (sheet.points[:, :1] > 2)
    halves = break_ties(halves, np.ones(20))
    surface = collect_agreed(halves, delaunay_star(halves, nearest(halves, 19)), np.ones(20))
    is_right = halves[surface.triangles, 0] > 3
    assert (is_right.all(axis=1) | ~is_right.any(axis=1)).all()
    assert len(surface.triangles) > 12


def test_agreed_triangles_need_stars():
    sheet = shapes.grid(5, 5)
    with pytest.raises(InputError, match="only ordered neighbourhoods hold triangles; use Delaunay stars"):
        collect_agreed(sheet.points, nearest(sheet.points, 8), spacing(sheet.points))


# Orientation


@given(planar_discs(), seeds)
@settings(max_examples=30)
def test_a_disc_of_mixed_orientation_becomes_one_part_oriented_alike(shape, seed):
    surface = patchwork(mixed(shape.triangles, np.random.default_rng(seed)), len(shape.points))
    assert as_set(surface.triangles) == as_set(shape.triangles)
    assert len(np.unique(surface.part)) == 1
    assert surface.largest.all()
    assert n_overfull(surface, surface.part >= 0) == 0
    assert is_same_loop(rims(surface)[0], shape.boundary)


@given(soups(), seeds)
def test_neighbours_are_oriented_alike_in_each_part_of_any_soup(soup, seed):
    surface = patchwork(mixed(soup[0], np.random.default_rng(seed)), soup[1])
    assert n_overfull(surface, surface.part >= 0) == 0
    for one, other in surface.sides[surface.sides[:, 1] >= 0].tolist():
        assert surface.part[one] == surface.part[other] or -1 in surface.part[[one, other]]


@given(planar_discs(), planar_discs(), seeds)
@settings(max_examples=10)
def test_surfaces_apart_are_parts_and_the_largest_is_the_one_of_most_triangles(one, other, seed):
    n = len(one.points)
    both = np.r_[one.triangles, other.triangles + n]
    surface = patchwork(mixed(both, np.random.default_rng(seed)), n + len(other.points))
    is_first = (surface.triangles < n).all(axis=1)
    assert [len(np.unique(surface.part[of])) for of in (is_first, ~is_first)] == [1, 1]
    if len(one.triangles) != len(other.triangles):
        assert np.array_equal(surface.largest, is_first == (len(one.triangles) > len(other.triangles)))


@pytest.mark.parametrize("closed", [shapes.sphere(100), shapes.torus(12, 8)], ids=["sphere", "torus"])
def test_a_closed_surface_is_one_part_without_a_rim(closed):
    surface = patchwork(mixed(closed.triangles, np.random.default_rng(1)), len(closed.points))
    assert len(surface.triangles) == len(closed.triangles)
    assert n_overfull(surface, surface.largest) == 0
    assert rims(surface) == []


@pytest.mark.parametrize("name", STRIPS)
@pytest.mark.parametrize("seed", range(4))
def test_a_moebius_strip_keeps_twisted_triangles_and_its_one_rim(name, seed):
    strip = STRIPS[name]()
    surface = patchwork(mixed(strip.triangles, np.random.default_rng(seed)), len(strip.points))
    assert_edges_fit(surface)
    assert as_set(surface.triangles) == as_set(strip.triangles)
    assert (surface.part < 0).any()
    assert n_overfull(surface, surface.part >= 0) == 0
    (rim,) = rims(surface)
    assert is_same_loop(rim, strip.boundary)


# Without some triangles, and with further ones


@given(soups() | st.builds(lambda shape: (shape.triangles, len(shape.points)), planar_discs()), seeds)
@settings(max_examples=60)
def test_without_some_triangles_edges_and_sides_are_those_of_the_patchwork_of_the_others(soup, seed):
    whole = patchwork(*soup)
    dropped = np.random.default_rng(seed).random(len(whole.triangles)) < 0.3
    left, again = whole.without(dropped), patchwork(whole.triangles[~dropped], whole.n_points)
    assert_edges_fit(left)
    assert np.array_equal(left.triangles, whole.triangles[~dropped])
    assert sides_by_ends(left) == sides_by_ends(again)
    assert np.array_equal(left.part, whole.part[~dropped])


def test_without_nothing_it_is_the_same():
    surface = patchwork([[0, 1, 2], [2, 1, 3]], 4)
    assert surface.without(np.zeros(2, bool)) is surface


def spared(surface, dropped, rng):
    """Take triangles out, but keep them to spare, of either orientation."""
    spare, edges = surface.triangles[dropped], surface.edge_of[dropped]
    is_turned = rng.random(len(spare)) < 0.5
    for array in (spare, edges):
        array[is_turned] = array[is_turned, ::-1]
    return replace(surface.without(dropped), spare=spare, spare_edges=edges)


@given(planar_discs(), seeds)
@settings(max_examples=30)
def test_spare_triangles_fill_the_gaps_of_a_disc_oriented_as_their_neighbours(shape, seed):
    rng = np.random.default_rng(seed)
    whole = patchwork(mixed(shape.triangles, rng), len(shape.points))
    on_boundary = np.isin(whole.triangles, shape.boundary).sum(axis=1) > 1
    dropped = ~on_boundary & (rng.random(len(whole.triangles)) < 0.3)
    filled = spared(whole, dropped, rng).extended(shape.boundary)
    assert_edges_fit(filled)
    assert as_set(filled.triangles) == as_set(shape.triangles)
    assert filled.largest.all()
    assert n_overfull(filled, filled.largest) == 0
    assert len(filled.spare) == 0


@given(planar_discs(), seeds)
@settings(max_examples=10)
def test_spare_triangles_do_not_cross_a_boundary(shape, seed):
    whole = patchwork(shape.triangles, len(shape.points))
    is_tip = np.isin(whole.triangles, shape.boundary).sum(axis=1) > 1
    # With the outer triangles to spare, the rim of the others is asked for as the boundary.
    (rim,) = rims(whole.without(is_tip))[:1]
    inner = spared(whole, is_tip, np.random.default_rng(seed))
    filled = inner.extended(rim)
    ahead = {frozenset(step) for step in zip(rim.tolist(), np.roll(rim, -1).tolist(), strict=True)}
    sides = sides_by_ends(filled)
    assert all(len(sides[step]) == 1 for step in ahead)
