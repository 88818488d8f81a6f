import json
import re

import numpy as np
import pytest

from pointchart import FormatError, StageClock, certify, reconstruct, shapes
from pointchart.report import certificate_lines, certificate_report, peak_memory_mb, run_report, summary, write_json

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
WHOLE = [[0, 1, 2], [0, 2, 3]]
CONTRACT = {
    "boundary": {"points", "length", "origin", "gaps"},
    "solve": {"unknowns", "nonzeros", "method", "iterations", "residual"},
    "certificate": {
        "disc",
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


@pytest.fixture(scope="module")
def run():
    """Return a run on a shuffled disc with a gap and two repeated points: scan, result, report."""
    shape = shapes.disc(1200, seed=4)
    keep = np.linalg.norm(shape.uv - [0.1, 0.2], axis=1) > 0.2
    points = np.r_[shape.points[keep], shape.points[keep][[5, 9]]]
    points = points[np.random.default_rng(1).permutation(len(points))]
    clock = StageClock()
    result = reconstruct(points, clock=clock)
    return points, result, run_report(points, result, clock, {"k": 12}, boundary_given=False)


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
    assert report["points"] == {"read": len(points), "distinct": n, "repeated": 2}
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


def test_a_report_comes_back_from_its_file(run, tmp_path):
    write_json(tmp_path / "run.json", run[2])
    assert json.loads((tmp_path / "run.json").read_text(encoding="utf-8")) == run[2]


def test_a_report_into_a_missing_folder_is_refused(tmp_path):
    with pytest.raises(FormatError, match="it cannot be written"):
        write_json(tmp_path / "none" / "run.json", {})


def test_a_good_mesh_passes_every_line():
    proof = certify(SQUARE, WHOLE, uv=SQUARE[:, :2], loop=[0, 1, 2, 3])
    lines = certificate_lines(proof)
    assert all(line.startswith("[ok] ") for line in lines[:-1])
    assert re.fullmatch(r"\[--\] longest edge \d\.\d local spacings, 0 folds", lines[-1])
    assert summary(proof) == "a certified disc: 4 points, 2 triangles, uv one-to-one"


@pytest.mark.parametrize(
    ("triangles", "uv", "loop", "fault"),
    [
        ([[0, 1, 2]], None, None, r"\[!!\] every point used: 1 unused"),
        ([[0, 1, 2], [0, 3, 2]], None, None, r"\[!!\] edges manifold, orientation consistent: 1 edges at fault"),
        (WHOLE, None, [0, 1, 2], r"\[!!\] boundary as asked for: another loop"),
        (WHOLE, SQUARE[:, :2] * [0, 1], None, r"\[!!\] uv distinct: 4 points coincide"),
        (WHOLE, SQUARE[:, :2] * [-1, 1], None, r"\[!!\] uv one-to-one, .*: 2 triangles flat or folded"),
    ],
)
def test_every_fault_has_its_line(triangles, uv, loop, fault):
    text = "\n".join(certificate_lines(certify(SQUARE, triangles, uv=uv, loop=loop)))
    assert re.search(fault, text)


def test_the_summary_of_a_bad_mesh_names_all_faults():
    ring = shapes.annulus(12, 3)
    assert summary(certify(ring.points, ring.triangles)) == (
        "no disc: its Euler characteristic is 0 instead of 1, it has 2 boundary loops instead of 1"
    )


def test_a_folded_disc_is_called_folded():
    proof = certify(SQUARE, WHOLE, uv=SQUARE[:, :2] * [-1, 1])
    assert summary(proof) == "a certified disc: 4 points, 2 triangles, uv folded at 2 triangles"


def test_what_was_not_checked_is_null():
    report = certificate_report(certify(SQUARE, WHOLE))
    assert report["boundary_as_given"] is None
    assert report["uv_distinct"] is None
    assert report["uv_positive"] is None


def test_the_peak_memory_never_falls_and_holds_the_largest_array():
    before = peak_memory_mb()
    size_mb = np.ones(2**24).nbytes // 2**20
    assert peak_memory_mb() >= max(before, size_mb)
    assert before < 10**6
