import json
import re
from dataclasses import replace

import numpy as np
import pytest

from pointchart import FormatError, SolveError, StageClock, leave_gaps_open, reconstruct, shapes
from pointchart.gaps.bridges import Bridge
from pointchart.report.as_json import as_json, writing_json
from pointchart.report.mesh_facts import mesh_facts
from pointchart.report.mesh_notes import boundary_notes, intersection_notes
from pointchart.report.record import RunReport
from pointchart.runs.execution.measured import measure_mesh
from pointchart.runs.execution.written import stages_of

CONTRACT = {
    "boundary": {"points", "length", "origin", "loops", "gaps", "doubts", "tried_before"},
    "solve": {"unknowns", "nonzeros", "method", "iterations", "residual"},
    "swaps": {"count", "settled", "closed_pockets", "recovered_links", "relocated_points"},
    "certificate": {
        "disc",
        "holes",
        "as_asked",
        "every_point_used",
        "euler",
        "boundary_loops",
        "boundary_as_given",
        "uv_distinct",
        "uv_positive",
        "longest_edge_over_spacing",
        "folds",
    },
}


def facts_of(points, result, clock=None, options=None, *, boundary_given=False):
    """Return what is told of a mesh of a whole scan."""
    clock = clock or StageClock()
    meshed = measure_mesh(points, np.arange(len(points)), result, clock, is_boundary_given=boundary_given)
    return as_json(RunReport("mesh", stages=stages_of(clock), facts=mesh_facts(meshed, options or {})))


def boundary_lines(result, points, *, found):
    return [note.text for note in boundary_notes(result, points, found=found)]


@pytest.fixture(scope="module")
def run():
    """Return a run on a shuffled disc with a gap and two repeated points: scan, result, report."""
    shape = shapes.disc(1200, seed=4)
    keep = np.linalg.norm(shape.uv - [0.1, 0.2], axis=1) > 0.2
    points = np.r_[shape.points[keep], shape.points[keep][[5, 9]]]
    points = points[np.random.default_rng(1).permutation(len(points))]
    clock = StageClock()
    result = reconstruct(points, clock=clock)
    return points, result, facts_of(points, result, clock, {"k": 12})


@pytest.fixture(scope="module")
def sheet():
    """Return a grid and its reconstruction."""
    shape = shapes.grid(9, 7)
    return shape.points, reconstruct(shape.points)


def with_evidence(result, **changes):
    """Return a result with other evidence."""
    return replace(result, evidence=replace(result.evidence, **changes))


def test_a_report_has_the_keys_of_the_contract(run):
    report = run[2]
    top = {"points", "options", "stages", "peak_memory_mb", "boundary", "solve", "certificate", "quality"}
    assert top <= set(report)
    for part, keys in CONTRACT.items():
        assert keys <= set(report[part])
    assert all(set(stage) == {"name", "seconds"} for stage in report["stages"])


def test_a_report_says_what_the_run_did(run):
    points, result, report = run
    n = len(result.rows)
    assert report["points"] == {"read": len(points), "distinct": n, "repeated": 2, "left_out": 0}
    assert report["options"] == {"k": 12}
    assert report["boundary"]["points"] == len(result.loop)
    assert report["boundary"]["origin"] == "found"
    assert report["boundary"]["length"] == pytest.approx(2 * np.pi, rel=1e-2)
    assert report["solve"]["unknowns"] == n - len(result.loop)
    assert report["solve"]["residual"] < 1e-10
    assert report["certificate"]["points"] == n
    assert report["certificate"]["triangles"] == 2 * n - 2 - len(result.loop)
    assert report["certificate"]["disc"] is True
    assert 0 < report["quality"]["radius_ratio"]["least"] <= report["quality"]["radius_ratio"]["median"] <= 1
    assert report["quality"]["l2_stretch"] >= 1 - 1e-12
    assert report["quality"]["least_uv_distance"] > 0


def test_a_gap_is_reported_with_its_size_and_place(run):
    points, result, report = run
    (gap,) = report["boundary"]["gaps"]
    assert gap["length"] == pytest.approx(2 * np.pi * 0.2, rel=0.3)
    assert gap["points"] == len(result.evidence.bridges[0].points)
    distance = np.linalg.norm(points[result.rows][gap["at_vertex"], :2] - [0.1, 0.2])
    assert distance == pytest.approx(0.2, abs=0.15)


def test_a_gap_that_stars_agree_round_is_a_pocket_that_was_closed(run):
    _, result, report = run
    assert result.evidence.first_solve is None
    assert report["swaps"]["closed_pockets"] == len(report["boundary"]["gaps"]) == 1


def test_a_mesh_without_a_map_of_its_own_is_reported_with_the_system_of_its_parameters(run):
    _, result, report = run
    assert report["solve"] == report["solve_uv"]
    assert report["solve"]["unknowns"] == len(result.rows) - len(result.loop)


def test_a_report_names_every_loop_the_chosen_one_first(run):
    points, result, report = run
    boundary, vertices = report["boundary"], points[result.rows]
    chosen, other = boundary["loops"]
    for loop, candidate in zip(boundary["loops"], result.evidence.candidates, strict=True):
        assert set(loop) == {"points", "length", "closed", "confidence", "at_vertex"}
        assert loop["at_vertex"] in candidate.loop
        assert 0.5 <= loop["confidence"] <= 1
    assert (chosen["points"], chosen["length"]) == (boundary["points"], pytest.approx(boundary["length"], rel=0.01))
    assert np.linalg.norm(vertices[chosen["at_vertex"], :2]) == pytest.approx(1, abs=1e-6)
    assert np.linalg.norm(vertices[other["at_vertex"], :2] - [0.1, 0.2]) == pytest.approx(0.2, abs=0.1)
    assert boundary["doubts"] == boundary["tried_before"] == []


def test_a_report_on_a_boundary_that_was_given_has_no_loops_to_choose_from():
    shape, clock = shapes.grid(9, 7), StageClock()
    result = reconstruct(shape.points, shape.boundary, clock=clock)
    boundary = facts_of(shape.points, result, clock, boundary_given=True)["boundary"]
    assert boundary == {
        "points": 28,
        "length": 28.0,
        "origin": "given",
        "loops": [],
        "gaps": [],
        "doubts": [],
        "tried_before": [],
    }


def test_a_gap_left_open_is_a_hole_of_the_certificate_and_still_a_gap(run):
    points, bridged, report = run
    clock = StageClock()
    opened = reconstruct(points, gaps=leave_gaps_open, clock=clock)
    with_hole = facts_of(points, opened, clock)
    assert with_hole["boundary"]["gaps"] == report["boundary"]["gaps"]
    closed, proof = report["certificate"], with_hole["certificate"]
    assert (closed["disc"], closed["as_asked"], closed["holes"]) == (True, True, 0)
    assert (proof["disc"], proof["as_asked"], proof["holes"]) == (False, True, 1)
    assert (proof["euler"], proof["boundary_loops"]) == (0, 2)
    assert proof["uv_positive"] is proof["uv_boundary_simple"] is True
    # Round the hole, triangles with all corners on the rim go with the bridge.
    n_over_gap = bridged.evidence.bridges[0].n_triangles
    assert closed["triangles"] - 3 * n_over_gap <= proof["triangles"] <= closed["triangles"] - n_over_gap


def test_every_bridge_is_a_gap_where_the_scan_ends_and_a_doubt_where_it_does_not(run):
    points, result, _ = run
    (gap,) = result.evidence.bridges
    (line,) = boundary_lines(result, points, found=False)[1:]
    assert line == f"1 gap of the scan, bridged, the largest {gap.rim_in_spacings:.0f} spacings round"
    doubt = replace(gap, share=0.49)
    doubtful = with_evidence(result, bridges=[doubt, gap, replace(gap, share=0.5)])
    report = facts_of(points, doubtful, boundary_given=True)["boundary"]
    assert (len(report["gaps"]), len(report["doubts"])) == (2, 1)
    assert report["doubts"][0] == {
        "points": len(gap.points),
        "length": gap.rim_length,
        "spacings": round(gap.rim_in_spacings, 1),
        "at_vertex": int(gap.points[0]),
    }


def test_the_boundary_has_one_line_where_nothing_is_to_be_said(sheet):
    points, result = sheet
    assert boundary_lines(result, points, found=True) == ["boundary of 28 points, found"]
    assert boundary_lines(result, points, found=False) == ["boundary of 28 points, as given"]


def test_the_loops_that_did_not_do_are_counted_and_reported_as_they_were_refused(sheet):
    points, result = sheet
    failures = [SolveError("the surface is no disc at point {there}", there=7), SolveError("no solver")]
    tried = with_evidence(result, candidates=result.evidence.candidates * 3, failures=failures)
    (line,) = boundary_lines(tried, points, found=True)
    assert line == "boundary of 28 points, found, loop 3 of 3 by its scores: no mesh stood with 2 before it"
    report = facts_of(points, tried)
    assert report["boundary"]["tried_before"] == ["the surface is no disc at point 7", "no solver"]


@pytest.mark.parametrize(
    ("holes", "done"),
    [
        (0, "bridged"),
        (1, "1 left open and the others, which touch the boundary or another gap, bridged"),
        (2, "2 left open"),
    ],
)
def test_gaps_and_doubts_have_a_line_each_with_the_size_and_place_of_the_largest(sheet, holes, done):
    points, result = sheet
    large, small = (
        Bridge(corners, 2, length, length, 1.0) for corners, length in ((np.arange(20, 25), 9.0), (np.arange(3), 4.0))
    )
    bridges = [replace(large, points=np.array([31, 40, 41]), share=0.2), large, small, replace(small, share=0.0)]
    proof = replace(result.certificate, holes=holes)
    said = boundary_lines(with_evidence(replace(result, certificate=proof), bridges=bridges), points, found=True)
    assert said == [
        "boundary of 28 points, found",
        f"2 gaps of the scan, {done}, the largest 9 spacings round",
        "look at 2 places that the mesh spans by edges of over four spacings although the scan has no gap there, the "
        "largest at vertex 31 (4, 3, 0)",
    ]


def test_a_mesh_that_passes_through_itself_is_reported_with_the_place(sheet):
    points, result = sheet
    turn = points[:, 0] / 8 * (np.pi + 1.0) - 0.5
    eight = np.c_[np.sin(turn), points[:, 1], np.sin(turn) * np.cos(turn)]
    for scan, count in ((points, 0), (eight, 1)):
        meshed = measure_mesh(scan, np.arange(len(scan)), result, StageClock())
        found = mesh_facts(meshed, {})["quality"]["self_intersections"]
        assert (found["pairs"] > 0, found["count"], len(found["places"])) == (count > 0, count, count)
        assert len(intersection_notes(meshed.intersections)) == count
    line = intersection_notes(meshed.intersections)[0].text
    assert np.abs(np.array(found["places"])[0, [0, 2]]).max() < 0.5
    assert re.fullmatch(r"look at 1 place where the mesh passes through itself, the first at \(.*, .*, .*\)", line)


def test_a_report_comes_back_from_its_file(run, tmp_path):
    report = RunReport("mesh", facts=run[2])
    with writing_json(tmp_path / "run.json", report):
        assert not (tmp_path / "run.json").exists()
    assert json.loads((tmp_path / "run.json").read_text(encoding="utf-8")) == run[2]


def test_a_report_into_a_missing_folder_is_refused(tmp_path):
    with (
        pytest.raises(FormatError, match="it cannot be written"),
        writing_json(tmp_path / "none" / "run.json", RunReport("mesh")),
    ):
        pass
