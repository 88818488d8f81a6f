import numpy as np
import pytest
from scans import SIMULATED, lampshade, square_layout

from pointchart import (
    InputError,
    SolveError,
    bridge_gaps,
    leave_gaps_open,
    mean_value,
    parameterize_scan,
    reconstruct,
    shapes,
    survey_scan,
    swap_to_delaunay,
    swap_to_least_curvature,
    swap_to_least_turn,
    uniform,
)
from pointchart.boundary import chord_length_on_circle
from pointchart.gaps import trials
from pointchart.mesh.connectivity import boundary_loops, half_edges
from pointchart.pipeline import TRIALS


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


@pytest.mark.parametrize("layout", [chord_length_on_circle, square_layout])
@pytest.mark.parametrize("weights", [None, mean_value])
def test_holes_are_left_open_whatever_the_domain_and_the_weights(layout, weights):
    scan = shapes.pierce(shapes.disc(2000, seed=2), n_gaps=2, seed=2)
    result = reconstruct(scan.points, gaps=leave_gaps_open, layout=layout, weights=weights)
    assert result.certificate.holes == 2
    assert result.certificate.is_as_asked
    assert result.certificate.is_one_to_one


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
