import numpy as np
import pytest
from scipy.spatial import cKDTree

from pointchart import InputError, StageClock, shapes, survey_scan

PIERCED = shapes.pierce(shapes.disc(1500, seed=1), n_gaps=3, seed=1)
PARTS = ("gap", "half_disc", "width", "uncovered")


def as_set(loop):
    return frozenset(np.asarray(loop).tolist())


def in_rows(survey):
    return as_set(survey.cloud.rows[survey.loop])


# The boundary


def test_a_boundary_that_was_given_is_kept_in_the_direction_of_the_surface():
    cap = shapes.hemisphere(300)
    for given in (cap.boundary, cap.boundary[::-1], np.append(cap.boundary, cap.boundary[0])):
        survey = survey_scan(cap.points, given)
        assert survey.found is None
        assert survey.candidates == []
        rows = survey.cloud.rows[survey.loop]
        assert np.roll(rows, -np.argmin(rows)).tolist() == np.roll(cap.boundary, -np.argmin(cap.boundary)).tolist()


def test_the_scores_do_not_depend_on_whether_the_boundary_was_given():
    found, given = survey_scan(PIERCED.points), survey_scan(PIERCED.points, PIERCED.boundary)
    for part in PARTS:
        assert np.array_equal(getattr(found.score(), part), getattr(given.score(), part))


def test_the_trials_are_the_candidates_each_once_the_best_first():
    survey = survey_scan(PIERCED.points)
    assert [trial.loop.tolist() for trial in survey.trials(9)] == [c.loop.tolist() for c in survey.candidates]
    assert [trial.found.candidates[0].loop.tolist() for trial in survey.trials(9)] == [
        c.loop.tolist() for c in survey.candidates
    ]
    assert all(trial.vicinity is survey.vicinity for trial in survey.trials(9))


def test_a_boundary_that_was_given_is_the_only_trial():
    survey = survey_scan(PIERCED.points, PIERCED.boundary)
    assert survey.trials(3) == [survey]


# The outer loop


@pytest.mark.parametrize("k", range(4))
@pytest.mark.parametrize("unit", [1.0, 1000.0])
def test_a_place_on_a_loop_makes_that_loop_the_boundary_and_keeps_the_others(k, unit):
    points = unit * (PIERCED.points + np.array([5, -3, 2]))
    wanted = PIERCED.loops[k]
    survey = survey_scan(points, outer=points[wanted].mean(axis=0) if k else points[wanted[3]])
    away = cKDTree(points[wanted]).query(survey.points[survey.loop])[0]
    assert away.max() < 2 * unit * PIERCED.spacing
    assert np.array_equal(survey.candidates[0].loop, survey.loop)
    plain = survey_scan(points)
    assert {as_set(c.loop) for c in survey.candidates} == {as_set(c.loop) for c in plain.candidates}


@pytest.mark.parametrize("far", [1.2, 50.0])
def test_the_place_of_the_boundary_may_be_off_the_loop(far):
    survey = survey_scan(PIERCED.points, outer=[0, far, 0])
    assert in_rows(survey) == as_set(PIERCED.boundary)


@pytest.mark.parametrize(("place", "loop"), [((0, 0, 0), 0.5), ((0, 0, 9), 0.5), ((3, 0, 0), 1.0)])
def test_of_the_rims_of_an_annulus_the_nearer_one_is_the_boundary(place, loop):
    ring = shapes.annulus()
    survey = survey_scan(ring.points, outer=place)
    assert np.linalg.norm(survey.points[survey.loop], axis=1) == pytest.approx(loop)


def test_the_nearest_candidate_is_the_one_with_the_nearest_point():
    survey = survey_scan(PIERCED.points)
    for place in np.random.default_rng(4).uniform(-1, 1, (20, 3)):
        distance = [np.linalg.norm(survey.points[c.loop] - place, axis=1).min() for c in survey.candidates]
        assert distance[survey.found.nearest_to(survey.points, place)] == min(distance)


def test_a_boundary_and_a_place_of_it_together_are_refused():
    with pytest.raises(InputError, match="both a boundary and a place of the boundary are given; give one of them"):
        survey_scan(PIERCED.points, PIERCED.boundary, outer=[1, 0, 0])


@pytest.mark.parametrize(
    ("place", "told"),
    [
        ([1, 0], r"\[1.0, 0.0\]"),
        ([[1, 0, 0]], r"\[\[1.0, 0.0, 0.0\]\]"),
        (1.0, "1.0"),
        ([0, np.nan, 0], r"\[0.0, nan, 0.0\]"),
    ],
)
def test_a_place_that_is_none_is_refused(place, told):
    with pytest.raises(InputError, match=f"the place is {told}; three finite numbers x, y, z are needed"):
        survey_scan(PIERCED.points, outer=place)


# Rows of the scan


def test_the_points_of_a_survey_are_those_of_the_scan_in_its_unit():
    points = 1e3 * PIERCED.points + [4e5, 5e6, 100]
    survey = survey_scan(points)
    assert np.array_equal(survey.points, points[survey.cloud.rows])
    assert np.array_equal(survey.scan, points)
    assert in_rows(survey) == as_set(PIERCED.boundary)


def test_rows_that_repeat_a_point_may_name_it_on_the_boundary():
    sheet = shapes.grid(9, 7)
    points = np.r_[sheet.points, sheet.points[:3]]
    survey = survey_scan(points, np.where(np.isin(sheet.boundary, [0, 1, 2]), sheet.boundary + 63, sheet.boundary))
    assert in_rows(survey) == as_set(sheet.boundary)


def test_parts_are_named_by_the_rows_of_the_scan():
    apart = np.r_[shapes.grid(12, 9).points, shapes.grid(8, 7).points + np.array([0, 0, 50])]
    order = np.random.default_rng(2).permutation(len(apart))
    with pytest.raises(InputError, match="2 separate parts, of 108 and 56 points") as caught:
        survey_scan(apart[order])
    first, second = caught.value.points["seeds"]
    assert order[first] < 108 <= order[second]


def test_a_survey_takes_the_time_of_its_stages():
    clock = StageClock()
    survey_scan(shapes.grid(9, 7).points, clock=clock)
    assert list(clock.seconds) == ["prepare", "neighbours", "boundary"]
