import numpy as np
import pytest
from scans import SIMULATED, square_layout

from pointchart import SolveError, StageClock, mean_value, reconstruct, shapes, survey_scan
from pointchart.boundary import chord_length_on_circle


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
