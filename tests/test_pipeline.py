from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import rotations, seeds

from pointchart import (
    InputError,
    SolveError,
    StageClock,
    ball,
    bicgstab,
    bridge_gaps,
    centripetal_steps,
    chord_length_steps,
    delaunay_star,
    keep_edges,
    leave_gaps_open,
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
    sharpest_places,
    survey_scan,
    swap_to_delaunay,
    swap_to_least_curvature,
    swap_to_least_turn,
    uniform,
    uniform_steps,
    uv_of_points,
    uv_on_mesh,
)
from pointchart.boundary import chord_length_on_circle, places_of
from pointchart.gaps import trials
from pointchart.mesh.connectivity import boundary_loops, half_edges
from pointchart.pipeline import TRIALS

SIMULATED = {
    "relief": lambda: shapes.relief(600, seed=2),
    "hemisphere": lambda: shapes.hemisphere(500),
    "sculpture": lambda: shapes.sculpture(1000),
}
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
SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


def lampshade(seed=0):
    """Return a wide cone cut off at the top, in any order, with its narrow and its wide rim."""
    ring = shapes.shuffle(shapes.annulus(), seed=seed)
    radius = np.linalg.norm(ring.points, axis=1)
    narrow, wide = sorted(ring.loops, key=lambda loop: radius[loop[0]])
    return ring.points - radius[:, None] * [0, 0, 1], narrow, wide


def stars(points):
    return delaunay_star(points, nearest(points, 20))


def square_layout(points, loop):
    return on_square(chord_length_steps(points, loop), sharpest_places(points, loop))


def edges(triangles):
    return set(map(tuple, np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1).tolist()))


def oriented(triangles):
    turn = np.argmin(triangles, axis=1)[:, None]
    return set(map(tuple, np.take_along_axis(triangles, (turn + np.arange(3)) % 3, axis=1).tolist()))


def in_rows(result):
    return oriented(result.rows[result.triangles])


def f1(found, truth):
    return 2 * len(found & truth) / (len(found) + len(truth))


# Methods


@pytest.mark.parametrize(("neighbors", "weights"), METHODS, ids=lambda x: x if isinstance(x, str) else x.__name__)
@pytest.mark.parametrize("name", ["relief", "hemisphere"])
def test_after_the_swaps_every_method_finds_the_edges_of_the_surface(name, neighbors, weights):
    shape = SIMULATED[name]()
    result = reconstruct(shape.points, shape.boundary, connect=NEIGHBORS[neighbors](shape), weights=weights)
    truth = swap_to_delaunay(shape.points, shape.triangles).triangles
    assert f1(edges(result.rows[result.triangles]), edges(truth)) > 0.99


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
    assert f1(edges(result.rows[result.triangles]), edges(truth)) > 0.99
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
    truth = edges(swap_to_delaunay(shape.points, shape.triangles).triangles)
    assert kept.evidence.counts.n_swaps == 0
    assert f1(edges(kept.triangles), truth) < f1(edges(swapped.triangles), truth)


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


# Parameters


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


# What does not matter


@pytest.mark.parametrize(
    ("scale", "offset"),
    [
        (1e-9, (0, 0, 0)),
        (1e9, (0, 0, 0)),
        (1, (5e5, 5.4e6, 120)),
        (1e3, (5e8, 5.4e9, 1.2e5)),
        (1, (-1e7, 3e6, 1e7)),
    ],
)
def test_units_and_offsets_do_not_change_the_triangles(scale, offset):
    shape = SIMULATED["relief"]()
    moved = reconstruct(scale * shape.points + np.array(offset))
    still = reconstruct(shape.points)
    assert in_rows(moved) == in_rows(still)
    assert moved.uv == pytest.approx(still.uv, abs=1e-6)


@given(st.integers(-60, 60))
@settings(max_examples=5)
def test_a_power_of_two_of_scale_changes_no_digit(exponent):
    shape = SIMULATED["relief"]()
    still, scaled = reconstruct(shape.points), reconstruct(2.0**exponent * shape.points)
    assert np.array_equal(still.uv, scaled.uv)
    assert np.array_equal(still.triangles, scaled.triangles)


@given(rotations())
@settings(max_examples=5)
def test_the_pose_does_not_change_the_edges(rotation):
    shape = SIMULATED["sculpture"]()
    assert (
        f1(edges(reconstruct(shape.points @ rotation.T).triangles), edges(reconstruct(shape.points).triangles)) > 0.999
    )


@given(seeds)
@settings(max_examples=5)
def test_the_numbering_does_not_change_the_triangles(seed):
    shape = SIMULATED["relief"]()
    order = np.random.default_rng(seed).permutation(len(shape.points))
    assert oriented(order[reconstruct(shape.points[order]).triangles]) == in_rows(reconstruct(shape.points))


def test_the_points_given_are_not_touched():
    points = shapes.hemisphere(300).points
    before = points.copy()
    points.setflags(write=False)
    reconstruct(points)
    assert np.array_equal(points, before)


# Small and awkward scans


@pytest.mark.parametrize("n_inner", [0, 1, 2])
def test_four_to_six_points_with_their_boundary_are_a_disc(n_inner):
    points = np.r_[SQUARE, [[0.4, 0.5, 0.1], [0.7, 0.6, 0.1]][:n_inner]] if n_inner else SQUARE
    result = reconstruct(points, [0, 1, 2, 3])
    assert len(result.triangles) == 2 + 2 * n_inner
    assert result.certificate.is_one_to_one


@pytest.mark.parametrize("n", [4, 5, 6, 9])
def test_a_boundary_of_all_points_needs_no_inner_one(n):
    turn = 2 * np.pi * np.arange(n) / n
    ring = np.c_[np.cos(turn), np.sin(turn), 0.2 * np.cos(2 * turn)]
    result = reconstruct(ring, np.arange(n))
    assert len(result.triangles) == n - 2
    assert result.certificate.is_one_to_one


@pytest.mark.parametrize("n", range(4))
def test_fewer_than_four_points_are_refused(n):
    with pytest.raises(InputError, match=f"the scan has {n} points; a surface patch needs at least 4"):
        reconstruct(SQUARE[:n].reshape(-1, 3))


@pytest.mark.parametrize("n", [4, 5, 6])
def test_a_handful_of_points_without_a_boundary_asks_for_one(n):
    points = np.r_[SQUARE, [[0.4, 0.5, 0.1], [0.7, 0.6, 0.1]]][:n]
    with pytest.raises(InputError, match=r"no boundary was found.*too few.*give the boundary"):
        reconstruct(points)


@pytest.mark.parametrize("axes", [[0, 1, 2], [2, 0, 1], [1, 2, 0]])
def test_planar_points_in_a_coordinate_plane_are_a_disc(axes):
    sheet = shapes.grid(8, 6)
    result = reconstruct(sheet.points[:, axes])
    assert result.certificate.is_one_to_one
    assert set(result.loop) == set(sheet.boundary)


def test_repeated_points_are_merged_to_the_first():
    points = shapes.relief(300, seed=2).points
    repeated = np.r_[points[[7]], points, points[[3, 7]]]
    result = reconstruct(repeated)
    assert result.rows.tolist() == [i for i in range(301) if i != 8]
    first_of = np.r_[7, np.arange(300)]
    assert oriented(first_of[result.rows][result.triangles]) == in_rows(reconstruct(points))


def test_a_boundary_may_name_a_repeated_point_by_any_of_its_rows():
    shape = shapes.hemisphere(300)
    corner = shape.boundary[5]
    loop = np.where(shape.boundary == corner, 300, shape.boundary)
    result = reconstruct(np.r_[shape.points, shape.points[[corner]]], loop)
    assert in_rows(result) == in_rows(reconstruct(shape.points, shape.boundary))


def test_points_one_digit_apart_stay_two_points():
    points = shapes.relief(300, seed=2).points
    twin = np.nextafter(points[40], 9)
    result = reconstruct(np.r_[points, [twin]], shapes.relief(300, seed=2).boundary)
    assert len(result.rows) == 301
    assert result.certificate.is_disc


# Errors and evidence


def test_errors_name_the_rows_of_the_scan():
    shape = shapes.shuffle(shapes.grid(12, 10), seed=5)
    culprit = int(np.flatnonzero((shape.uv == [4, 6]).all(axis=1))[0])
    points = shape.points + np.eye(3)[2] * (np.arange(120) == culprit)[:, None] / 4

    def broken(points, around):
        return np.where(around.rows == np.argmax(points[:, 2]), -1, 1) * uniform(points, around)

    with pytest.raises(InputError, match=rf"the weights at point {culprit} are no convex combination"):
        reconstruct(points, shape.boundary, connect=partial(nearest, k=8), weights=broken)


def test_points_without_a_path_to_the_boundary_are_named_by_their_rows():
    sheet = shapes.grid(12, 10)
    island = np.array([[5.4, 4.4, 0], [5.6, 4.4, 0], [5.5, 4.6, 0]])
    order = np.random.default_rng(1).permutation(123)
    points = np.r_[sheet.points, island][order]
    place = np.argsort(order)
    with pytest.raises(InputError, match=r"have no path to the boundary.*median size is 2") as caught:
        reconstruct(points, place[sheet.boundary], connect=partial(nearest, k=2), weights=uniform)
    assert set(place[[120, 121, 122]]) <= set(caught.value.points["lost"])


def test_repeated_boundary_points_are_named_by_their_rows():
    shape = shapes.shuffle(shapes.grid(8, 6), seed=3)
    loop = np.r_[shape.boundary[:9], shape.boundary[3:]]
    with pytest.raises(InputError, match="are named more than once") as caught:
        reconstruct(shape.points, loop)
    assert set(caught.value.points["repeated"]) == set(shape.boundary[3:9])


def test_a_repeated_boundary_point_in_the_rows_of_repeated_points_is_named():
    shape = shapes.grid(8, 6)
    points = np.r_[shape.points, shape.points[:2], shape.points[:2]]
    loop = np.r_[50, shape.boundary[1:], 50, 49]
    with pytest.raises(InputError, match="boundary points 50 are named more than once"):
        reconstruct(points, np.roll(loop, 3))


def test_two_rows_of_one_point_on_the_boundary_are_the_same_point_twice():
    shape = shapes.grid(8, 6)
    with pytest.raises(InputError, match="boundary points 0 are named more than once"):
        reconstruct(np.r_[shape.points, shape.points[:1]], np.insert(shape.boundary, 5, 48))


def test_corners_off_the_boundary_are_named_by_their_rows():
    shape = shapes.shuffle(shapes.grid(8, 6), seed=3)
    inner = int(np.flatnonzero((shape.uv == [4, 3]).all(axis=1))[0])
    corners = [inner, *shape.boundary[[3, 9, 15]]]
    with pytest.raises(InputError, match=f"corners {inner} are not on the boundary; choose boundary points"):
        reconstruct(
            shape.points,
            layout=lambda points, loop: on_square(chord_length_steps(points, loop), places_of(corners, loop)),
        )


# Which loop, and what becomes of gaps


def test_the_next_loop_is_tried_where_a_mesh_is_torn_and_the_failure_is_kept_with_rows_of_the_scan(monkeypatch):
    points, narrow, wide = lampshade(seed=4)
    asked = []

    def not_the_first(rims, *_, **__):
        asked.append(rims)
        if len(asked) == 1:
            raise SolveError("not round point {here}", here=rims.loop[0])

    monkeypatch.setattr(trials, "check_torn", not_the_first)
    result = reconstruct(points, gaps=bridge_gaps)
    (failure,) = result.evidence.failures
    assert set(result.loop) == set(narrow)
    assert failure.points["here"][0] in wide
    assert str(failure) == f"not round point {failure.points['here'][0]}"
    assert set(result.evidence.candidates[0].loop) == set(narrow)
    assert set(result.evidence.candidates[1].loop) == set(wide)


def test_no_more_than_three_loops_are_tried_and_the_first_failure_is_told(monkeypatch):
    # On a sphere with gaps every gap may be the boundary.
    scan = shapes.pierce(shapes.sphere(3000), n_gaps=5, radius_in_spacings=4)
    asked = []

    def none_will_do(rims, *_, **__):
        asked.append(rims.loop)
        raise SolveError(f"refused {len(asked)}")

    monkeypatch.setattr(trials, "check_torn", none_will_do)
    with pytest.raises(SolveError, match="refused 1"):
        reconstruct(scan.points)
    candidates = survey_scan(scan.points).candidates
    assert len(asked) == TRIALS < len(candidates)
    assert [set(loop) for loop in asked] == [set(candidate.loop) for candidate in candidates[:TRIALS]]


@pytest.mark.parametrize("says", ["loop", "outer"])
def test_the_loop_that_was_asked_for_is_the_only_one_tried(says):
    points, narrow, wide = lampshade()
    asked = []

    def none_will_do(rims):
        asked.append(rims.loop)
        raise SolveError("refused")

    for rim in (narrow, wide):
        with pytest.raises(SolveError, match="refused"):
            reconstruct(points, gaps=none_will_do, **{says: rim if says == "loop" else points[rim[0]]})
        assert [len(loop) for loop in asked] == [len(rim)]
        asked.clear()


def test_a_sound_scan_has_no_failures():
    assert reconstruct(SIMULATED["sculpture"]().points).evidence.failures == []


def test_a_boundary_and_a_place_of_it_are_not_taken_together():
    points, narrow, wide = lampshade()
    for stage in (reconstruct, parameterize_scan):
        with pytest.raises(InputError, match="both a boundary and a place of the boundary are given"):
            stage(points, wide, outer=points[narrow[0]])


@pytest.mark.parametrize("rim", [0, 1])
def test_the_papers_parameters_take_the_loop_that_a_place_says(rim):
    points, *loops = lampshade()
    survey, mapped = parameterize_scan(points, outer=points[loops[rim][5]], weights=uniform)
    assert set(survey.cloud.rows[mapped.loop]) == set(loops[rim])
    assert np.linalg.norm(mapped.uv[mapped.loop], axis=1) == pytest.approx(1)


@pytest.mark.parametrize("rule", [bridge_gaps, leave_gaps_open])
@pytest.mark.parametrize(("scale", "offset"), [(1e-6, (0, 0, 0)), (2.0**10, (0, 0, 0)), (1e3, (4e5, 5e6, 100))])
def test_units_and_offsets_change_neither_triangles_nor_holes(rule, scale, offset):
    scan = shapes.pierce(shapes.relief(2000, seed=1), n_gaps=2, seed=1)
    still, moved = (reconstruct(points, gaps=rule) for points in (scan.points, scale * scan.points + np.array(offset)))
    assert in_rows(moved) == in_rows(still)
    assert moved.certificate.holes == still.certificate.holes == (2 if rule is leave_gaps_open else 0)
    for one, other in zip(still.evidence.bridges, moved.evidence.bridges, strict=True):
        assert np.array_equal(one.points, other.points)
        assert other.rim_length == pytest.approx(scale * one.rim_length, rel=1e-6)
        assert other.rim_in_spacings == pytest.approx(one.rim_in_spacings, rel=1e-6)


@given(seeds)
@settings(max_examples=3)
def test_the_numbering_changes_no_hole(seed):
    scan = shapes.pierce(shapes.relief(2000, seed=1), n_gaps=2, seed=1)
    order = np.random.default_rng(seed).permutation(len(scan.points))
    mixed = reconstruct(scan.points[order], gaps=leave_gaps_open)
    assert oriented(order[mixed.triangles]) == in_rows(reconstruct(scan.points, gaps=leave_gaps_open))


@pytest.mark.parametrize("layout", [chord_length_on_circle, square_layout])
@pytest.mark.parametrize("weights", [None, mean_value])
def test_holes_are_left_open_whatever_the_domain_and_the_weights(layout, weights):
    scan = shapes.pierce(shapes.disc(2000, seed=2), n_gaps=2, seed=2)
    result = reconstruct(scan.points, gaps=leave_gaps_open, layout=layout, weights=weights)
    assert result.certificate.holes == 2
    assert result.certificate.is_as_asked
    assert result.certificate.is_one_to_one


# Evidence


@pytest.mark.parametrize(
    ("shape", "options", "between"),
    [
        (SIMULATED["hemisphere"](), {}, ["assemble", "swap", "relocate"]),
        (shapes.fold(1.5), {}, ["assemble", "map", "triangulate", "recover", "swap", "relocate"]),
        (SIMULATED["hemisphere"](), {"weights": mean_value}, ["map", "triangulate", "swap"]),
    ],
    ids=["assembled", "mapped where stars do not agree", "mapped by the weights asked for"],
)
def test_the_stages_are_timed_in_order(shape, options, between):
    heard = []
    clock = StageClock(heard.append)
    reconstruct(shape.points, shape.boundary, clock=clock, **options)
    assert list(clock.seconds) == list(dict.fromkeys(heard))
    assert list(clock.seconds) == ["prepare", "neighbours", "boundary", *between, "parameters", "certify"]


def test_the_evidence_is_in_the_numbers_and_the_unit_of_the_scan():
    shape = shapes.shuffle(shapes.disc(1500, seed=4), seed=1)
    keep = np.linalg.norm(shape.uv - [0.1, 0.2], axis=1) > 0.2
    result = reconstruct(1000 * shape.points[keep])
    chosen = result.evidence.candidates[0]
    assert np.array_equal(np.sort(chosen.loop), np.sort(result.loop))
    assert chosen.length == pytest.approx(2000 * np.pi, rel=1e-2)
    (gap,) = result.evidence.bridges
    assert gap.rim_length == pytest.approx(400 * np.pi, rel=0.3)
    assert np.linalg.norm(shape.uv[keep][gap.points] - [0.1, 0.2], axis=1).max() < 0.2 + 3 * shape.spacing


def test_the_survey_holds_the_boundary_given():
    shape = shapes.hemisphere(300)
    survey = survey_scan(shape.points, shape.boundary)
    assert survey.candidates == []
    assert set(survey.cloud.rows[survey.loop]) == set(shape.boundary)


@pytest.mark.parametrize("layout", [chord_length_on_circle, square_layout])
def test_a_finger_of_sixty_radii_is_opened_one_to_one(layout):
    finger = shapes.tube(60, n_around=12)
    assert reconstruct(finger.points, finger.boundary, layout=layout).certificate.is_one_to_one


def test_a_part_so_long_that_doubles_cannot_hold_its_parameters_is_refused():
    finger = shapes.add_noise(shapes.tube(300, n_around=16), sigma_in_spacings=0.25, seed=2)
    with pytest.raises(SolveError, match=r"not one-to-one: .* too long for its neck in double precision"):
        reconstruct(finger.points, finger.boundary)


@pytest.mark.parametrize("swap", [swap_to_least_turn, swap_to_least_curvature])
def test_gaps_left_open_stay_open_under_other_swaps(swap):
    scan = shapes.pierce(shapes.relief(3000, seed=2), n_gaps=1, radius_in_spacings=8, seed=2)
    meshes = [reconstruct(scan.points, gaps=leave_gaps_open, swap=rule) for rule in (swap_to_delaunay, swap)]
    assert [mesh.certificate.holes for mesh in meshes] == [1, 1]
    rims = [sorted(len(loop) for loop in boundary_loops(half_edges(m.triangles, len(scan.points)))) for m in meshes]
    assert rims[0] == rims[1]


def test_gaps_of_a_real_scan_left_open_share_no_edge_with_the_mesh_beside_them(scan):
    mesh = reconstruct(scan("face").points, gaps=leave_gaps_open)
    assert mesh.certificate.is_as_asked
    assert mesh.certificate.holes > 10
