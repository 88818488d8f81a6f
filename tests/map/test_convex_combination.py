import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from strategies import flat, planar_discs, rotations, seeds, systems

from pointchart.boundary.layout import on_circle, on_square
from pointchart.boundary.steps import chord_length_steps
from pointchart.errors import InputError, SolveError
from pointchart.map.convex_combination import parameterize
from pointchart.map.weights import normalize, reciprocal_distance, uniform
from pointchart.mesh.connectivity import one_rings
from pointchart.points.neighborhoods import Neighborhoods, from_pairs
from pointchart.points.neighbors import ball, nearest
from pointchart.points.stars import delaunay_star
from pointchart.shapes import disc, relief
from pointchart.solve.factors import direct
from pointchart.solve.krylov import bicgstab
from pointchart.solve.reach import check_connected, cut_points
from pointchart.solve.systems import solve_fixed


def support_directions(corners):
    """List directions that suffice to separate any point from the hull of some corners."""
    sides = (corners[:, None] - corners[None]).reshape(-1, 2)
    return np.r_[sides, sides[:, ::-1] * [1, -1], np.eye(2), -np.eye(2)]


def solve(system):
    return solve_fixed(system.matrix, system.loop, system.layout, solver=direct).values


def is_connected(system):
    return all(system.reaches(i) for i in system.inner)


@settings(max_examples=50)
@given(systems())
def test_proposition_3_1_every_point_lies_in_the_hull_of_its_reachable_boundary(system):
    assume(is_connected(system))
    uv = solve(system)
    for i in system.inner:
        corners = uv[system.reaches(i)]
        directions = support_directions(corners)
        assert (uv[i] @ directions.T <= (corners @ directions.T).max(axis=0) + 1e-10).all()


@settings(max_examples=50)
@given(systems(), st.integers(0, 100))
def test_lemma_3_2_a_point_can_be_eliminated_and_convex_combinations_remain(system, pick):
    assume(is_connected(system) and len(system.inner) > 1)
    r = system.inner[pick % len(system.inner)]
    lam = system.matrix.toarray()
    reduced = lam + np.outer(lam[:, r], lam[r])
    reduced[np.diag_indices_from(reduced)] = 0
    others = np.setdiff1d(system.inner, r)
    reduced = reduced[others] / (1 - lam[others, r] * lam[r, others])[:, None]
    reduced[:, r] = 0
    assert (reduced >= 0).all()
    assert np.allclose(reduced.sum(axis=1), 1, rtol=0, atol=1e-13)
    uv = solve(system)
    assert np.allclose(reduced @ uv, uv[others], rtol=0, atol=1e-12)


@settings(max_examples=50)
@given(systems())
def test_proposition_3_3_the_solution_is_unique_exactly_if_all_points_are_boundary_connected(system):
    inner = system.inner
    left = np.eye(len(inner)) - system.matrix.toarray()[np.ix_(inner, inner)]
    smallest = np.linalg.svd(left, compute_uv=False)[-1]
    assert smallest > 1e-10 if is_connected(system) else smallest < 1e-14


@settings(max_examples=50)
@given(systems())
def test_cut_points_are_those_whose_removal_leaves_no_path_to_the_boundary(system):
    found = cut_points(system.neighborhoods, system.loop)
    everyone = range(len(found))
    cuts = {i: {v for v in everyone if v != i and not system.reaches(i, without=v)} for i in everyone}
    for i in everyone:
        if i in system.loop:
            assert found[i] == -1
        elif not system.reaches(i):
            assert found[i] == -2
        elif not cuts[i]:
            assert found[i] == -1
        else:
            # The nearest one along the paths: all the others cut that one off, too.
            assert found[i] in cuts[i]
            beyond = set() if found[i] in system.loop else cuts[found[i]]
            assert cuts[i] == beyond | {found[i]}


@settings(max_examples=40)
@given(systems())
def test_points_fall_into_their_cut_points(system):
    assume(is_connected(system))
    uv, cut = solve(system), cut_points(system.neighborhoods, system.loop)
    hanging = np.flatnonzero(cut >= 0)
    assert np.abs(uv[hanging] - uv[cut[hanging]]).max(initial=0.0) < 1e-10


@settings(max_examples=40)
@given(systems())
def test_unconnected_points_are_refused_by_name(system):
    lost = [int(i) for i in system.inner if not system.reaches(i)]
    hanging = np.flatnonzero(cut_points(system.neighborhoods, system.loop) >= 0)
    if lost:
        with pytest.raises(InputError, match=r"have no path to the boundary, so their position is undeter") as error:
            check_connected(system.neighborhoods, system.loop)
        assert error.value.points["lost"].tolist() == lost
        assert f"interior points {lost[0]}" in str(error.value)
    elif len(hanging):
        with pytest.raises(InputError, match=r"reach the boundary only through point \d+, into which they") as error:
            check_connected(system.neighborhoods, system.loop)
        assert np.array_equal(error.value.points["hanging"], hanging)
    else:
        check_connected(system.neighborhoods, system.loop)


def test_a_second_patch_far_away_is_named_as_unconnected():
    shape = disc(100)
    both = np.r_[shape.points, shape.points[:20] + np.array([50, 0, 0])]
    rim = on_circle(np.ones(len(shape.boundary)))
    with pytest.raises(InputError, match=r"points 100, 101, 102 and 17 more have no path .* median size is 6"):
        parameterize(both, shape.boundary, rim, nearest(both, 6), weights=uniform)


def test_a_cluster_behind_one_point_is_named_with_that_point():
    shape = disc(100)
    rim = on_circle(np.ones(len(shape.boundary)))
    around = nearest(shape.points, 6)
    cluster = from_pairs(np.repeat([100, 101, 102], 3), np.array([3, 101, 102, 3, 100, 102, 3, 100, 101]), 103)
    indices = np.r_[around.indices, cluster.indices]
    points = np.r_[shape.points, shape.points[3] + 1e-3 * np.eye(3)]
    hood = Neighborhoods(np.r_[around.indptr, around.indptr[-1] + cluster.indptr[-3:]], indices)
    with pytest.raises(InputError, match="interior points 100, 101, 102 reach the boundary only through point 3, into"):
        parameterize(points, shape.boundary, rim, hood, weights=uniform)


@settings(max_examples=20)
@given(
    planar_discs(smallest=60), st.sampled_from([on_circle, on_square]), st.sampled_from([uniform, reciprocal_distance])
)
def test_all_points_stay_inside_the_domain(shape, layout, scheme):
    steps = chord_length_steps(shape.points, shape.boundary)
    found = parameterize(shape.points, shape.boundary, layout(steps), nearest(shape.points, 12), weights=scheme)
    if layout is on_circle:
        inner = np.setdiff1d(np.arange(len(shape.points)), shape.boundary)
        assert np.hypot(*found.uv[inner].T).max() < 1
    assert found.uv.min() >= (-1 if layout is on_circle else 0)
    assert found.uv.max() <= 1


@settings(max_examples=20)
@given(st.integers(0, 1000), rotations(), st.floats(-6, 6), seeds)
def test_parameters_do_not_depend_on_place_size_and_numbering(seed, rotation, exponent, order_seed):
    shape = relief(200, seed=seed)
    order = np.random.default_rng(order_seed).permutation(200)
    place = np.argsort(order)
    moved = 10.0**exponent * (shape.points @ rotation.T + [1, 2, 3])[order]
    results = []
    for points, loop in ((shape.points, shape.boundary), (moved, place[shape.boundary])):
        rim = on_circle(chord_length_steps(points, loop))
        results.append(parameterize(points, loop, rim, delaunay_star(points, nearest(points, 20))).uv)
    assert np.abs(results[1][place] - results[0]).max() < 1e-9


@settings(max_examples=20)
@given(st.integers(0, 1000), seeds)
def test_parameters_follow_an_affine_map_of_the_boundary(seed, map_seed):
    shape = relief(150, seed=seed)
    star = delaunay_star(shape.points, nearest(shape.points, 20))
    rim = on_circle(chord_length_steps(shape.points, shape.boundary))
    matrix, shift = np.random.default_rng(map_seed).normal(size=(2, 2)), [3, -4]
    one = parameterize(shape.points, shape.boundary, rim, star).uv
    other = parameterize(shape.points, shape.boundary, rim @ matrix + shift, star).uv
    assert np.allclose(other, one @ matrix + shift, rtol=0, atol=1e-12 * (4 + np.abs(matrix).sum()))


def test_boundary_points_go_exactly_where_they_were_laid_out():
    shape = relief(300, seed=1)
    rim = on_circle(chord_length_steps(shape.points, shape.boundary))
    found = parameterize(shape.points, shape.boundary, rim, nearest(shape.points), weights=reciprocal_distance)
    assert np.array_equal(found.uv[shape.boundary], rim)
    assert np.array_equal(found.loop, shape.boundary)
    assert found.solution.residual < 1e-13
    assert found.solution.unknowns == 300 - len(shape.boundary)


def test_the_solver_can_be_chosen():
    shape = relief(300, seed=1)
    rim = on_circle(chord_length_steps(shape.points, shape.boundary))
    star = delaunay_star(shape.points, nearest(shape.points))
    one, other = (parameterize(shape.points, shape.boundary, rim, star, solver=s) for s in (direct, bicgstab))
    assert (one.solution.method, other.solution.method) == ("direct", "bicgstab")
    assert np.abs(one.uv - other.uv).max() < 1e-10


PATCH = disc(80, seed=4)
RIM = on_circle(np.ones(len(PATCH.boundary)))


def map_with(scheme, **changes):
    arguments = {"loop": PATCH.boundary, "boundary_uv": RIM, "neighborhoods": nearest(PATCH.points, 8)} | changes
    return parameterize(PATCH.points, weights=scheme, **arguments)


def test_any_positive_weights_that_sum_to_one_are_accepted():
    def square_distance(points, neighborhoods):
        offset = points[neighborhoods.indices] - points[neighborhoods.rows]
        return normalize(1 / (offset**2).sum(axis=1), neighborhoods)

    uv = map_with(square_distance).uv
    around = nearest(PATCH.points, 8)
    weights = square_distance(PATCH.points, around)
    mean = np.column_stack([np.bincount(around.rows, weights * uv[around.indices, axis]) for axis in range(2)])
    inner = np.setdiff1d(np.arange(80), PATCH.boundary)
    assert np.abs(mean - uv)[inner].max() < 1e-14


def change(weights, entry, value):
    return np.where(np.arange(len(weights)) == entry, value, weights)


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (
            lambda w: change(w, 5 * 8 + 2, -0.5),
            r"at point 5 are no convex combination \(smallest -0\.5, sum",
        ),
        (lambda w: change(w, 5 * 8 + 2, np.nan), "the weights at point 5 are no convex combination"),
        (
            lambda w: change(w, 7 * 8 + 1, 0.5),
            r"at point 7 .* sum 1\.375\); they have to be positive and",
        ),
        (lambda w: w[:-1], r"the weights have shape \(639,\); the neighbourhoods have 640 entries"),
        (lambda w: w[:, None], r"the weights have shape \(640, 1\)"),
        (lambda w: 8.0, r"the weights have shape \(\)"),
    ],
)
def test_weights_that_are_no_convex_combination_are_refused(spoil, message):
    with pytest.raises(InputError, match=message):
        map_with(lambda points, neighborhoods: spoil(uniform(points, neighborhoods)))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"boundary_uv": RIM[:-1]}, r"boundary_uv has shape \(\d+, 2\); the loop of \d+ points needs"),
        ({"boundary_uv": flat(RIM)}, r"the domain has shape \(\d+, 3\); at least 3 finite corners"),
        ({"neighborhoods": nearest(PATCH.points[:-1], 8)}, "the neighbourhoods are those of 79 points, not of 80"),
        ({"loop": np.r_[PATCH.boundary[:-1], 80]}, "1 boundary entries name no point, the first is 80"),
    ],
)
def test_arguments_that_do_not_fit_together_are_refused(changes, message):
    with pytest.raises(InputError, match=message):
        map_with(uniform, **changes)


def test_a_boundary_that_is_not_finite_is_refused():
    with pytest.raises((InputError, SolveError), match="finite"):
        map_with(uniform, boundary_uv=RIM * np.nan)


def test_points_outside_the_domain_tell_that_the_system_was_not_solved():
    def careless(left, right):
        return np.full_like(right, 7.0), ()

    with pytest.raises(SolveError, match=r"careless left a relative residual of .* so it did not solve the system"):
        map_with(uniform, solver=careless)


def test_neighbours_of_boundary_points_do_not_matter():
    around = ball(PATCH.points, 3 * PATCH.spacing)
    kept = ~np.isin(around.rows, PATCH.boundary)
    sizes = np.where(np.isin(np.arange(80), PATCH.boundary), 0, around.sizes)
    bare = Neighborhoods(np.r_[0, np.cumsum(sizes)], around.indices[kept])
    one, other = (map_with(uniform, neighborhoods=hood).uv for hood in (around, bare))
    assert np.array_equal(one, other)


def test_the_map_of_a_mesh_with_its_rings_solves_the_same_system_as_the_stars_of_a_plane():
    shape = disc(300, seed=7)
    rim = on_square(chord_length_steps(shape.points, shape.boundary))
    star = delaunay_star(shape.points, nearest(shape.points, 40))
    rings = one_rings(shape.triangles, 300)
    one, other = (parameterize(shape.points, shape.boundary, rim, hood).uv for hood in (star, rings))
    assert np.abs(one - other).max() < 1e-12
