from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree
from strategies import clouds, planar_discs, rotations, seeds

from pointchart import (
    InputError,
    PointchartError,
    angular_gaps,
    boundary_scores,
    delaunay_star,
    explore,
    find_boundary,
    hull_test,
    nearest,
    order_by_halves,
    reconstruct,
    shapes,
    spacing,
    survey_scan,
)
from pointchart.agreement.agreed_surface import agreed_patchwork, patchwork
from pointchart.boundary import anticlockwise, rims
from pointchart.boundary.loops import tightened
from pointchart.boundary.scores import corner_angles
from pointchart.mesh.connectivity import half_edges

SMOOTH = {
    "disc": lambda: shapes.disc(800, seed=1),
    "hemisphere": lambda: shapes.hemisphere(900),
    "cap of 150 degrees": lambda: shapes.hemisphere(900, angle=150),
    "tube": lambda: shapes.tube(5, n_around=24),
    "relief": lambda: shapes.relief(1000, seed=2),
    "density falling tenfold": lambda: shapes.raise_bumps(shapes.grade(shapes.disc(1000), ratio=10)),
    "density falling fortyfold": lambda: shapes.raise_bumps(shapes.grade(shapes.disc(2000), ratio=40)),
}


def bowl(sheet):
    height = ((sheet.points[:, :2] - 7) ** 2).sum(axis=1) / 40
    return shapes.Shape(np.c_[sheet.points[:, :2], height], sheet.triangles, sheet.uv)


RAGGED = {
    "sculpture": lambda: shapes.sculpture(2000),
    "noisy sculpture": lambda: shapes.add_noise(shapes.sculpture(2000)),
    "laser scan": lambda: shapes.laser_scan(shapes.sculpted_face, lines=60),
    "uneven density": lambda: shapes.thin(shapes.relief(2000, seed=3)),
    "hairpin": lambda: shapes.fold(4),
    "grid on a bowl": lambda: bowl(shapes.grid(19, 13)),
    "neck of five spacings": lambda: shapes.dumbbell(1000, neck=5),
    "rolled neck of five spacings": lambda: shapes.roll(shapes.dumbbell(1500, neck=5), 200),
    "noisy density falling tenfold": lambda: shapes.add_noise(
        shapes.raise_bumps(shapes.grade(shapes.disc(1500), ratio=10))
    ),
    "lines three times as far apart": lambda: shapes.laser_scan(
        shapes.sculpted_face, lines=30, anisotropy=3, noise=0, ragged=0
    ),
}
GRIDS = {
    "flat": lambda p: p,
    "tilted": lambda p: p @ [[1, 0, 0.7], [0, 1, -0.4], [0, 0, 1]],
    "sheared": lambda p: p @ [[1, 0, 0], [0.3, 1, 0], [0, 0, 1]],
    "twice as wide": lambda p: p * [2, 1, 1],
}
WAVES = {
    "circle": lambda t: np.c_[np.cos(t), np.sin(t), 0 * t],
    "ellipse": lambda t: np.c_[2 * np.cos(t), np.sin(t), 0 * t],
    "saddle": lambda t: np.c_[2 * np.cos(t), np.sin(t), 0.3 * np.sin(3 * t)],
    "wavy ellipse": lambda t: np.c_[2 * np.cos(t), np.sin(t), 0.3 * np.sin(5 * t)],
}


def found_loop(points):
    survey = survey_scan(points)
    return survey.cloud.rows[survey.loop]


def as_cycle(loop):
    loop = np.asarray(loop)
    return np.roll(loop, -int(np.argmin(loop))).tolist()


def either_way(loop):
    return sorted([as_cycle(loop), as_cycle(loop[::-1])])


def farthest(points, others):
    """Return the largest distance of a point from the nearest of some others."""
    return cKDTree(others).query(points)[0].max()


def oriented(triangles):
    turn = np.argmin(triangles, axis=1)[:, None]
    return set(map(tuple, np.take_along_axis(triangles, (turn + np.arange(3)) % 3, axis=1).tolist()))


def normals_of(points, triangles):
    corner = points[triangles]
    return np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


def shares_of_steps(order, n):
    """Return the share of steps of a cyclic order of 0..n-1 that go one forward, or one back, the larger one."""
    steps = np.diff(np.r_[order, order[:1]]) % n
    return max((steps == 1).mean(), (steps == n - 1).mean())


# Detection


@pytest.mark.parametrize("kind", GRIDS)
def test_the_boundary_of_a_grid_is_found_exactly(kind):
    sheet = shapes.grid(17, 13)
    loop = found_loop(GRIDS[kind](sheet.points))
    assert either_way(loop) == either_way(sheet.boundary)


@pytest.mark.parametrize("angle", [5, 45, 90, 180, 270])
def test_the_boundary_of_a_grid_rolled_up_lies_within_two_spacings_of_the_true_one(angle):
    sheet = shapes.bent_sheet(angle)
    loop = found_loop(sheet.points)
    assert farthest(sheet.points[loop], sheet.points[sheet.boundary]) <= 2
    assert farthest(sheet.points[sheet.boundary], sheet.points[loop]) <= 2


@pytest.mark.parametrize("name", SMOOTH)
def test_a_cleanly_sampled_boundary_is_found_exactly(name):
    shape = SMOOTH[name]()
    assert either_way(found_loop(shape.points)) == either_way(shape.boundary)


@pytest.mark.parametrize("name", RAGGED)
def test_a_ragged_boundary_is_found_to_within_two_spacings(name):
    shape = RAGGED[name]()
    loop = found_loop(shape.points)
    assert farthest(shape.points[loop], shape.points[shape.boundary]) <= 2 * shape.spacing
    assert farthest(shape.points[shape.boundary], shape.points[loop]) <= 2 * shape.spacing


@pytest.mark.parametrize("name", ["foot5k", "fran", "demosthenes"])
def test_the_boundary_of_a_real_scan_is_found_to_within_three_spacings(scan, name):
    points, triangles, truth = scan(name)
    ends = points[triangles[:, [0, 1]]]
    step = np.median(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))
    loop = found_loop(points)
    assert farthest(points[loop], points[truth]) <= 3 * step
    assert farthest(points[truth], points[loop]) <= 3 * step


@given(rotations())
@settings(max_examples=5)
def test_the_boundary_does_not_depend_on_the_pose(rotation):
    shape = shapes.relief(500, seed=2)
    assert either_way(found_loop(shape.points @ rotation.T)) == either_way(shape.boundary)


@given(st.integers(-40, 40))
@settings(max_examples=5)
def test_a_power_of_two_of_scale_changes_nothing(exponent):
    shape = shapes.sculpture(700)
    assert np.array_equal(found_loop(2.0**exponent * shape.points), found_loop(shape.points))


@pytest.mark.parametrize("scale", [1e-9, 0.3, 1e9])
def test_the_unit_changes_the_boundary_only_where_ties_are_broken(scale):
    shape = shapes.sculpture(700)
    one, other = (set(pairwise(as_cycle(found_loop(unit * shape.points)))) for unit in (1.0, scale))
    # Rounding to another unit changes the coordinates, and so what breaks ties: a loop may take another triangle in.
    assert len(one ^ other) <= 0.05 * len(one)


@given(seeds)
@settings(max_examples=5)
def test_the_boundary_does_not_depend_on_the_numbering(seed):
    shape = shapes.sculpture(700)
    order = np.random.default_rng(seed).permutation(len(shape.points))
    assert as_cycle(order[found_loop(shape.points[order])]) == as_cycle(found_loop(shape.points))


def test_angular_gaps_are_half_turns_on_a_straight_edge_and_three_quarters_at_a_corner():
    sheet = shapes.grid(13, 11)
    gaps = angular_gaps(sheet.points, nearest(sheet.points, 30)).reshape(11, 13)
    assert gaps[0, 0] == pytest.approx(1.5 * np.pi)
    assert gaps[0, 6] == pytest.approx(np.pi)
    assert gaps[5, 6] < np.pi / 4


@pytest.mark.parametrize("k", [3, 5, 8])
@given(rotations())
@settings(max_examples=5)
def test_the_angular_gap_inside_a_regular_polygon_is_the_kth_of_a_turn(k, rotation):
    turn = 2 * np.pi * np.arange(k) / k
    points = np.r_[[[0.0, 0, 0]], np.c_[np.cos(turn), np.sin(turn), 0 * turn]] @ rotation.T
    gaps = angular_gaps(points, nearest(points, k))
    assert gaps[0] == pytest.approx(2 * np.pi / k)
    assert gaps[1:] == pytest.approx(np.full(k, 2 * np.pi - np.pi * (k - 2) / k))


def test_neighbours_straight_above_and_below_do_not_narrow_an_angular_gap():
    sheet = shapes.grid(13, 11)
    pole = np.array([[6, 0, 1.5], [6, 0, -1.5]])
    alone = angular_gaps(sheet.points, nearest(sheet.points, 20))
    assert np.allclose(angular_gaps(np.r_[sheet.points, pole], nearest(np.r_[sheet.points, pole], 20))[6], alone[6])


@pytest.mark.parametrize("apart", [3, 3.5, 4])
def test_a_second_sheet_three_spacings_away_changes_no_angular_gap_inside_and_keeps_those_of_the_edge_open(apart):
    sheet = shapes.disc(1200, seed=1)
    sheets = np.r_[sheet.points, sheet.points + sheet.spacing * np.array([0.3, 0.2, apart])]
    alone, gaps = (angular_gaps(points, nearest(points, 20))[:1200] for points in (sheet.points, sheets))
    on_edge = np.isin(np.arange(1200), sheet.boundary)
    assert np.allclose(gaps[~on_edge], alone[~on_edge])
    assert gaps[on_edge].min() > np.pi


def test_the_hull_test_finds_convex_boundaries_and_misses_concave_bends():
    convex, hollow = shapes.disc(400, seed=1), shapes.annulus(60, 8)
    is_found = hull_test(delaunay_star(convex.points, nearest(convex.points, 20)))
    assert set(np.flatnonzero(is_found)) == set(convex.boundary)
    is_found = hull_test(delaunay_star(hollow.points, nearest(hollow.points, 20)))
    radius = np.linalg.norm(hollow.points, axis=1)
    assert is_found[radius > 1 - 1e-9].all()
    assert not is_found[radius < 1 - 1e-9].any()


def test_the_hull_test_needs_stars():
    sheet = shapes.grid(5, 5)
    with pytest.raises(
        InputError,
        match="the neighbourhoods are not ordered, so no star is known to be open; use Delaunay stars",
    ):
        hull_test(nearest(sheet.points, 8))


# Scores


PARTS = ["gap", "half_disc", "width", "uncovered"]


def scores_of(points, k=20):
    """Score points without smoothing them or breaking ties."""
    around, step = nearest(points, k), spacing(points)
    star = delaunay_star(points, nearest(points, 20))
    return boundary_scores(points, around, star, agreed_patchwork(points, star, step).triangles, step)


def depths(sheet, nx, ny):
    """Return how far the points of a grid lie from its nearer edge, and from the next one."""
    edges = np.c_[
        np.minimum(sheet.uv[:, 0], nx - 1 - sheet.uv[:, 0]), np.minimum(sheet.uv[:, 1], ny - 1 - sheet.uv[:, 1])
    ]
    return np.sort(edges, axis=1).T


def test_scores_of_a_grid_are_nothing_inside_and_full_on_a_straight_edge_and_at_a_corner():
    sheet = shapes.grid(21, 17)
    vicinity = explore(sheet.points)
    agreed = agreed_patchwork(vicinity.smoothed, vicinity.star, vicinity.spacing).triangles
    scores = boundary_scores(vicinity.smoothed, vicinity.around, vicinity.star, agreed, vicinity.spacing)
    near, far = depths(sheet, 21, 17)
    inside, edge, corner = near >= 2, (near == 0) & (far >= 4), far == 0
    for part in ("half_disc", "width", "uncovered"):
        assert getattr(scores, part)[inside] == pytest.approx(0, abs=1e-12)
    # The twenty nearest on a grid leave atan(1/2) free at most, spread evenly a tenth of pi.
    assert scores.gap[inside] == pytest.approx((np.arctan(0.5) - 0.1 * np.pi) / (0.9 * np.pi))
    for part in ("gap", "width", "uncovered"):
        assert getattr(scores, part)[edge] == pytest.approx(1)
    for part in PARTS:
        assert getattr(scores, part)[corner] == pytest.approx(1)
    assert np.array_equal(scores.is_boundary, near == 0)


@pytest.mark.parametrize("name", SMOOTH)
def test_the_scores_of_an_even_sampling_tell_its_boundary_exactly(name):
    shape = SMOOTH[name]()
    scores = find_boundary(shape.points).scores
    on_edge = np.isin(np.arange(len(shape.points)), shape.boundary)
    assert np.array_equal(scores.is_boundary, on_edge)
    assert scores.total[on_edge].min() > 0.8
    assert scores.total[~on_edge].max() < 0.4
    for part in ("width", "uncovered"):
        assert getattr(scores, part)[on_edge].min() > 0.9


def test_the_centroid_of_neighbours_on_an_edge_nears_that_of_half_a_disc_with_the_spacing_over_its_radius():
    radii, missing = np.array([5, 10, 20]), []
    for radius in radii:
        sheet, middle = shapes.grid(4 * radius + 1, 2 * radius + 1), 2 * radius
        # As many as lie in half a disc, so that no other ones are as near as the last.
        count = (np.linalg.norm(sheet.points - sheet.points[middle], axis=1) <= radius).sum() - 1
        missing.append(1 - scores_of(sheet.points, int(count)).half_disc[middle])
    assert np.polyfit(np.log(radii), np.log(missing), 1)[0] == pytest.approx(-1, abs=0.1)


@pytest.mark.parametrize(
    ("apart", "width"), [(1, 0), (np.sqrt(3), 0), (2, np.sqrt(5) / 2 - 1), (3, np.sqrt(10) / 2 - 1)]
)
def test_the_width_is_the_circumradius_of_the_star_beyond_one_spacing(apart, width):
    sheet = shapes.grid(21, 9)
    points = sheet.points * [1, apart, 1]
    star = delaunay_star(points, nearest(points, 60))
    scores = boundary_scores(points, nearest(points, 20), star, sheet.triangles, np.ones(len(points)))
    middle = 4 * 21 + 10
    assert scores.width[middle] == pytest.approx(width, abs=1e-9)


@given(planar_discs(smallest=60))
@settings(max_examples=10)
def test_inside_a_planar_disc_nothing_is_uncovered_and_no_star_wide(shape):
    scores = boundary_scores(
        shape.points,
        nearest(shape.points, 20),
        delaunay_star(shape.points, nearest(shape.points, 30)),
        shape.triangles,
        spacing(shape.points),
    )
    on_edge = np.isin(np.arange(len(shape.points)), shape.boundary)
    assert np.abs(scores.uncovered[~on_edge]).max(initial=0) < 1e-9
    assert scores.uncovered[on_edge] == pytest.approx(1)
    assert scores.width[on_edge] == pytest.approx(1)


@given(clouds(smallest=60))
@settings(max_examples=10)
def test_scores_lie_between_none_and_one_and_their_total_is_their_mean(points):
    scores = scores_of(points)
    parts = np.array([getattr(scores, part) for part in PARTS])
    assert parts.min() >= 0
    assert parts.max() <= 1
    assert scores.total == pytest.approx(parts.mean(axis=0))
    assert np.array_equal(scores.is_boundary, scores.total >= 0.5)


@given(clouds(smallest=60), rotations(), st.floats(-6, 6), seeds)
@settings(max_examples=10)
def test_scores_do_not_depend_on_pose_scale_and_numbering(points, rotation, exponent, seed):
    order = np.random.default_rng(seed).permutation(len(points))
    moved = 10.0**exponent * (points[order] @ rotation.T + 1)
    still, others = scores_of(points), scores_of(moved)
    for part in PARTS:
        assert getattr(others, part) == pytest.approx(getattr(still, part)[order], abs=1e-6)


@pytest.mark.parametrize("sigma", [0.25, 0.5])
def test_scores_of_smoothed_points_tell_the_edge_from_the_inside_through_noise(sigma):
    shape = shapes.relief(1500, seed=3)
    noisy = shapes.add_noise(shape, sigma_in_spacings=sigma, seed=3).points
    scoring = shape.points[find_boundary(noisy).scores.is_boundary]
    edge = shape.points[shape.boundary]
    assert np.quantile(cKDTree(edge).query(scoring)[0], 0.95) < 2 * shape.spacing
    assert farthest(edge, scoring) < 2 * shape.spacing


@pytest.mark.parametrize(
    ("shape", "euler"), [(shapes.sphere(300), 2), (shapes.torus(24, 12), 0)], ids=["sphere", "torus"]
)
def test_the_angles_that_a_closed_mesh_lacks_add_up_to_its_euler_characteristic_in_turns(shape, euler):
    lacking = 2 * np.pi - corner_angles(shape.points, shape.triangles)
    assert lacking.sum() == pytest.approx(2 * np.pi * euler, abs=1e-9)


def test_the_angles_round_inner_points_of_a_plane_are_a_full_turn(any_disc):
    flat = np.c_[any_disc.uv, np.zeros(len(any_disc.uv))]
    inner = np.setdiff1d(np.arange(len(flat)), any_disc.boundary)
    assert corner_angles(flat, any_disc.triangles)[inner] == pytest.approx(2 * np.pi, abs=1e-6)


def test_scores_need_stars():
    sheet = shapes.grid(6, 5)
    around = nearest(sheet.points, 8)
    with pytest.raises(InputError, match="the neighbourhoods are no stars, so they have no width; use Delaunay stars"):
        boundary_scores(sheet.points, around, around, sheet.triangles, spacing(sheet.points))


# Rims of agreeing triangles


def test_the_rims_of_a_disc_are_its_boundary(any_disc):
    (rim,) = rims(patchwork(any_disc.triangles, len(any_disc.points)))
    assert either_way(rim) == either_way(any_disc.boundary)


def test_a_surface_with_two_boundaries_has_two_rims():
    ring = shapes.annulus(30, 5)
    found = rims(patchwork(ring.triangles, len(ring.points)))
    assert sorted(map(either_way, found)) == sorted(map(either_way, ring.loops))


def test_a_closed_surface_has_no_rim():
    ball = shapes.sphere(100)
    assert rims(patchwork(ball.triangles, 100)) == []


@given(seeds)
def test_rims_are_simple_however_many_triangles_are_missing(seed):
    shape = shapes.disc(60)
    rng = np.random.default_rng(seed)
    for rim in rims(patchwork(shape.triangles[rng.random(len(shape.triangles)) < rng.random()], 60)):
        assert len(rim) >= 3
        assert len(set(rim.tolist())) == len(rim)


# Tightening


def euler_of(triangles):
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    return len(np.unique(triangles)) - len(edges) + len(triangles)


def some_of(shape, rng):
    """Return some triangles of a shape as a surface, and some points."""
    kept = rng.random(len(shape.triangles)) < rng.uniform(0.7, 1)
    return patchwork(shape.triangles[kept], len(shape.points)), rng.random(len(shape.points)) < rng.random()


@given(planar_discs(), seeds)
@settings(max_examples=30)
def test_tightening_changes_no_topology_and_loses_no_point(shape, seed):
    surface, is_boundary = some_of(shape, np.random.default_rng(seed))
    tight = tightened(shape.points, surface, is_boundary)
    assert np.array_equal(np.unique(tight.triangles), np.unique(surface.triangles))
    assert euler_of(tight.triangles) == euler_of(surface.triangles)
    assert len(rims(tight)) == len(rims(surface))


@given(planar_discs(), seeds)
@settings(max_examples=30)
def test_tightening_brings_boundary_points_onto_the_rims_and_takes_none_off(shape, seed):
    surface, is_boundary = some_of(shape, np.random.default_rng(seed))
    tight = tightened(shape.points, surface, is_boundary)
    before, after = (set(np.concatenate([*rims(patches), []]).tolist()) for patches in (surface, tight))
    assert before <= after
    assert len(after - before) == len(surface.triangles) - len(tight.triangles)
    assert is_boundary[np.array(sorted(after - before), dtype=int)].all()
    assert set(map(tuple, tight.triangles.tolist())) <= set(map(tuple, surface.triangles.tolist()))
    again = tightened(shape.points, tight, is_boundary)
    assert np.array_equal(again.triangles, tight.triangles)


def test_without_boundary_points_nothing_is_tightened(any_disc):
    surface = patchwork(any_disc.triangles, len(any_disc.points))
    assert tightened(any_disc.points, surface, np.zeros(len(any_disc.points), bool)) is surface


@pytest.mark.parametrize(("angle", "n_left"), [(89, 5), (91, 4)])
def test_a_rim_is_drawn_to_a_point_that_sees_it_under_more_than_a_right_angle(angle, n_left):
    half = np.deg2rad(angle / 2)
    turn = np.r_[0, np.linspace(half, 2 * np.pi - half, 5)]
    points = np.c_[np.cos(turn), np.sin(turn), 0 * turn] * (np.arange(6) > 0)[:, None]
    fan = patchwork([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1]], 6)
    assert len(tightened(points, fan, np.ones(6, bool)).triangles) == n_left


def test_tightening_finds_the_teeth_of_a_ragged_edge():
    teeth = shapes.grid(12, 6)
    is_tooth = (teeth.uv[:, 1] == 0) & (teeth.uv[:, 0] % 2 == 1)
    points = teeth.points - 0.6 * np.eye(3)[1] * is_tooth[:, None]
    hull = np.array([[i, i + 2, i + 1] for i in range(1, 10, 2)])
    (loop,) = rims(tightened(points, patchwork(np.r_[teeth.triangles, hull], 72), np.ones(72, bool)))
    assert set(range(12)) <= set(loop.tolist())


# The boundary found


def test_a_vicinity_that_is_known_already_gives_the_same_boundary():
    points = shapes.sculpture(1000).points
    one, other = find_boundary(points), find_boundary(points, vicinity=explore(points))
    assert np.array_equal(one.loop, other.loop)
    assert np.array_equal(one.scores.total, other.scores.total)


def test_beginning_with_a_candidate_only_permutes():
    scan = shapes.pierce(shapes.disc(1500, seed=1), n_gaps=3, seed=1)
    found = find_boundary(scan.points)
    assert len(found.candidates) == 4
    for k, candidate in enumerate(found.candidates):
        turned = found.beginning_with(k)
        assert turned.loop is candidate.loop
        assert turned.candidates[0] is candidate
        assert turned.candidates[1:] == [other for other in found.candidates if other is not candidate]
        assert turned.scores is found.scores
    assert found.candidates[0].loop is found.loop


def test_every_gap_of_a_scan_is_a_candidate_and_runs_between_boundary_points():
    scan = shapes.pierce(shapes.relief(2000, seed=1), n_gaps=3, seed=1)
    found = find_boundary(scan.points)
    assert len(found.candidates) == len(scan.loops)
    for candidate in found.candidates:
        nearest_loop = min(scan.loops, key=lambda loop: farthest(scan.points[candidate.loop], scan.points[loop]))
        assert farthest(scan.points[candidate.loop], scan.points[nearest_loop]) < 1.5 * scan.spacing
        steps = np.diff(scan.points[np.r_[candidate.loop, candidate.loop[0]]], axis=0)
        assert candidate.length == pytest.approx(np.linalg.norm(steps, axis=1).sum())
        assert candidate.share == pytest.approx(1)


@pytest.mark.parametrize("sigma", [0, 0.25, 0.5])
@pytest.mark.parametrize("name", ["disc", "relief"])
def test_through_gaps_and_noise_the_outer_loop_is_found_and_the_mesh_stands(name, sigma):
    whole = getattr(shapes, name)(1500, seed=1)
    scan = shapes.add_noise(shapes.pierce(whole, n_gaps=3, seed=1), sigma_in_spacings=sigma, seed=1)
    result = reconstruct(scan.points)
    assert result.certificate.is_disc
    assert result.certificate.is_one_to_one
    assert result.evidence.failures == []
    assert farthest(scan.points[result.loop], scan.points[scan.boundary]) <= 2 * scan.spacing
    assert farthest(scan.points[scan.boundary], scan.points[result.loop]) <= 2 * scan.spacing


# What is no disc


@pytest.mark.parametrize("name", ["disc", "relief"])
def test_a_gap_in_the_scan_is_bridged_and_reported_and_the_outer_loop_kept(name):
    shape = getattr(shapes, name)(1500, seed=4)
    keep = np.linalg.norm(shape.uv - [0.1, 0.2], axis=1) > 0.2
    result = reconstruct(shape.points[keep])
    loop = np.flatnonzero(keep)[result.rows[result.loop]]
    assert result.certificate.is_disc
    assert either_way(loop) == either_way(shape.boundary)
    (gap,) = result.evidence.bridges
    distance = np.linalg.norm(shape.uv[keep][gap.points] - [0.1, 0.2], axis=1)
    assert distance.max() < 0.2 + 3 * shape.spacing
    assert gap.rim_length == pytest.approx(2 * np.pi * 0.2, rel=0.3)


@pytest.mark.parametrize("closed", [shapes.sphere(1000), shapes.torus(64, 24)], ids=["sphere", "torus"])
@pytest.mark.parametrize("sigma", [0, 0.1, 0.25, 0.5])
def test_a_closed_surface_is_refused_as_closed(closed, sigma):
    with pytest.raises(
        InputError, match=r"no boundary was found: .* closed surface; give the boundary, or cut the scan open"
    ):
        reconstruct(shapes.add_noise(closed, sigma_in_spacings=sigma).points)


@pytest.mark.parametrize("size", [(64, 24), (96, 32)])
@pytest.mark.parametrize("sigma", [0, 0.25, 0.5])
def test_a_torus_with_a_gap_is_refused(size, sigma):
    scan = shapes.pierce(shapes.torus(*size), n_gaps=1, radius_in_spacings=4)
    with pytest.raises(PointchartError, match="the surface is no disc"):
        reconstruct(shapes.add_noise(scan, sigma_in_spacings=sigma).points)


@pytest.mark.parametrize("apart", [(0, 0, 100), (40, 0, 0)])
def test_two_sheets_are_refused_with_the_sizes_and_a_point_of_each(apart):
    points = np.r_[shapes.grid(12, 9).points, shapes.grid(8, 7).points + np.array(apart)]
    with pytest.raises(InputError, match="2 separate parts, of 108 and 56 points") as caught:
        reconstruct(points)
    first, second = caught.value.points["seeds"]
    assert first < 108 <= second


@pytest.mark.parametrize(
    "strip",
    [
        {},
        {"n_around": 64, "n_across": 7},
        {"n_around": 96, "n_across": 5, "width": 0.3},
        {"n_around": 128, "n_across": 13, "width": 0.8},
        {"n_around": 64, "n_across": 11, "width": 1.2},
        {"n_around": 80, "n_across": 16, "width": 1.6},
    ],
    ids=str,
)
@pytest.mark.parametrize("sigma", [0, 0.4])
def test_a_moebius_strip_is_refused(strip, sigma):
    with pytest.raises(PointchartError, match=r"no disc|no boundary was found"):
        reconstruct(shapes.add_noise(shapes.moebius(**strip), sigma_in_spacings=sigma).points)


@pytest.mark.parametrize("name", ["x_annulus", "x_closed_hand", "x_torus", "x_two_feet"])
def test_real_scans_of_no_disc_are_refused(name, request):
    folder = request.path.parents[3] / "shared" / "data" / name
    if not folder.is_dir():
        pytest.skip(f"the real scan {name} is not in {folder.parent}")
    from pointchart import read_scan

    with pytest.raises(PointchartError, match=r"no disc|no boundary was found|separate parts"):
        reconstruct(read_scan(folder / "points.ply").points)


@pytest.mark.parametrize("seed", range(3))
def test_noise_of_a_quarter_of_the_spacing_still_gives_a_disc(seed):
    noisy = shapes.add_noise(shapes.sculpture(1500), sigma_in_spacings=0.25, seed=seed)
    proof = reconstruct(noisy.points).certificate
    assert proof.is_disc
    assert proof.is_one_to_one


@pytest.mark.parametrize("name", RAGGED)
def test_the_candidates_are_ranked_by_marked_length(name):
    points = RAGGED[name]().points
    found = find_boundary(points)
    lengths = [candidate.share * candidate.length for candidate in found.candidates]
    assert lengths == sorted(lengths, reverse=True)
    assert np.array_equal(found.loop, found.candidates[0].loop)


# The paper's ordering


@pytest.mark.parametrize("curve", WAVES)
@pytest.mark.parametrize("n", [40, 41, 200])
def test_ordering_by_halves_restores_the_order_of_a_closed_curve(curve, n):
    turn = 2 * np.pi * np.arange(n) / n
    members = np.random.default_rng(n).permutation(n)
    assert shares_of_steps(order_by_halves(WAVES[curve](turn), members), n) == 1.0


def test_ordering_by_halves_takes_the_plane_it_is_given():
    turn = 2 * np.pi * np.arange(60) / 60
    for normal in ([0, 1, 0], [1, 1, 0], [1, 0, 0]):
        loop = order_by_halves(WAVES["circle"](turn), np.arange(60), normal=normal)
        assert shares_of_steps(loop, 60) == 1.0


def test_ordering_by_halves_returns_its_members_once():
    shape = shapes.hemisphere(300)
    members = shape.boundary[::2]
    assert sorted(order_by_halves(shape.points, members)) == sorted(members)


def test_a_half_without_points_is_refused():
    points = np.array([[0.0, 0, 0], [0.1, 1, 0], [0.2, 2, 0], [0.1, 3, 0], [-9.0, 1.5, 0], [0.0, 4, 0]])
    with pytest.raises(InputError, match="the plane leaves 1 boundary points on one side; each half needs at least 3"):
        order_by_halves(points, np.arange(6), normal=[1, 0, 0])
    with pytest.raises(InputError, match="5 boundary points cannot be put in order by halves"):
        order_by_halves(points, np.arange(5), normal=[1, 0, 0])


def test_boundary_points_in_clusters_ask_for_a_larger_k():
    turn = np.deg2rad([0, 1, 2, 3, 50, 51, 52, 53, 140, 141, 142, 200, 201, 202, 300, 301, 302])
    with pytest.raises(InputError, match="have no path to both ends of their half; use a larger k"):
        order_by_halves(WAVES["circle"](turn), np.arange(len(turn)), k=2)


def test_paper_boundary_of_the_bunny_by_hull_test_and_halves(scan):
    points, _, truth = scan("bunny30571")
    is_found = hull_test(delaunay_star(points, nearest(points, 20)))
    members = truth[is_found[truth]]
    assert 0.2 <= len(members) / len(truth) <= 0.35
    place = np.full(len(points), -1)
    place[members] = np.arange(len(members))
    order = order_by_halves(points, np.sort(members))
    assert shares_of_steps(place[order], len(members)) == 1.0


# Orientation


@pytest.mark.parametrize("name", ["hemisphere", "relief"])
def test_a_loop_reversed_turned_or_closed_gives_the_same_mesh(name):
    shape = SMOOTH[name]()
    loop = shape.boundary
    meshes = [
        oriented(reconstruct(shape.points, given).triangles)
        for given in (loop, loop[::-1], np.roll(loop, 17), np.append(loop, loop[0]), loop.tolist())
    ]
    assert all(mesh == meshes[0] for mesh in meshes)


@given(rotations())
@settings(max_examples=5)
def test_triangles_of_a_cap_face_away_from_its_centre_in_any_pose(rotation):
    cap = shapes.hemisphere(300)
    points = cap.points @ rotation.T
    triangles = reconstruct(points).triangles
    assert (np.einsum("ij,ij->i", normals_of(points, triangles), points[triangles].mean(axis=1)) > 0).all()


@pytest.mark.parametrize("upside_down", [1, -1])
@pytest.mark.parametrize("seed", range(3))
def test_triangles_of_level_terrain_face_upwards(upside_down, seed):
    points = shapes.relief(800, seed=seed).points * [1, 1, upside_down]
    assert (normals_of(points, reconstruct(points).triangles)[:, 2] > 0).all()


def test_the_parameters_turn_the_way_the_triangles_do(any_disc):
    result = reconstruct(any_disc.points, any_disc.boundary)
    corner = result.uv[result.triangles]
    first, second = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    assert (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] > 0).all()
    edges = half_edges(result.triangles, len(result.rows))
    ahead = dict(zip(edges.origins[edges.twins < 0].tolist(), edges.targets[edges.twins < 0].tolist(), strict=True))
    assert [ahead[i] for i in result.loop.tolist()] == np.roll(result.loop, -1).tolist()


def test_a_mirrored_cap_turns_the_other_way():
    tent = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 2]])
    assert anticlockwise(tent, np.array([0, 1, 2, 3])).tolist() == [0, 1, 2, 3]
    assert anticlockwise(tent * [1, 1, -1], np.array([0, 1, 2, 3])).tolist() == [0, 3, 2, 1]


def test_a_relief_on_a_tilted_boundary_faces_its_bulge_whichever_way_it_is_turned():
    cap = shapes.hemisphere(400, angle=40)
    axis = np.array([1.0, 2.0, 0.5]) / np.linalg.norm([1.0, 2.0, 0.5])
    for tilt in np.deg2rad([40, 75, 110, 150, 200, 250]):
        cross = np.cross(np.eye(3), axis)
        rotation = np.cos(tilt) * np.eye(3) + np.sin(tilt) * cross + (1 - np.cos(tilt)) * np.outer(axis, axis)
        points = cap.points @ rotation.T
        assert np.array_equal(anticlockwise(points, cap.boundary), cap.boundary)
        assert np.array_equal(anticlockwise(points, cap.boundary[::-1])[1:], np.roll(cap.boundary, 1)[1:])
