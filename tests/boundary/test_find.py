from itertools import pairwise

import numpy as np
import pytest
from comparisons import as_cycle, either_way, farthest
from hypothesis import given, settings
from hypothesis import strategies as st
from scans import SMOOTH
from strategies import rotations, seeds

from pointchart import explore, find_boundary, reconstruct, shapes, survey_scan


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


def found_loop(points):
    survey = survey_scan(points)
    return survey.cloud.rows[survey.loop]


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
