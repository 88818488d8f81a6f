import json
import os
import re
import signal
import subprocess
import sys

import numpy as np
import pytest

from pointchart import certify, read_scan, shapes, write_loop, write_mesh
from pointchart.cad import read_cad, read_surface_json
from pointchart.surface import closest_parameters, evaluate

NO_FACES = np.empty((0, 3), np.int64)
CAP = shapes.hemisphere(500)
FAR = shapes.grid(6, 5).points + np.array([0, 0, 50])
DIAGONAL = float(np.linalg.norm(np.ptp(CAP.points, axis=0)))
# Sends itself Ctrl-C once the fit has begun.
INTERRUPTED = """
import os, signal, sys, threading, time
from contextlib import nullcontext
from pointchart import cli, clock
def interrupt():
    time.sleep(0.1)
    os.kill(os.getpid(), signal.SIGINT)
def announce(name):
    if name == "fit":
        threading.Thread(target=interrupt, daemon=True).start()
cli.commands.staged = lambda quiet: nullcontext(clock.StageClock(announce))
cli.main()
"""


@pytest.fixture
def run(command_line, monkeypatch, tmp_path):
    """Run `pointchart fit` in an empty folder; return its exit code and stderr."""
    monkeypatch.chdir(tmp_path)

    def call(*words):
        code, out, err = command_line("fit", *words)
        assert out == ""
        return code, err

    return call


@pytest.fixture
def cap(tmp_path):
    """Write half a sphere with an intensity to cap.ply."""
    attributes = {"intensity": np.linspace(0, 1, 500, dtype=np.float32)}
    write_mesh(tmp_path / "cap.ply", CAP.points, NO_FACES, attributes=attributes)


@pytest.fixture
def ring(tmp_path):
    """Write a flat ring to ring.ply."""
    write_mesh(tmp_path / "ring.ply", shapes.annulus(80, 4, inner_radius=0.8).points, NO_FACES)


@pytest.fixture
def refused(run, tmp_path):
    """Run a fit that has to fail with one sentence and leave all files as they are; return the sentence."""

    def call(*words, out="out.json"):
        (tmp_path / out).write_bytes(b"old")
        before = sorted(tmp_path.rglob("*"))
        code, err = run(*words, "-o", out, "--quiet")
        assert (code, len(err.splitlines()), err[:12]) == (1, 1, "pointchart: ")
        assert (tmp_path / out).read_bytes() == b"old"
        assert sorted(tmp_path.rglob("*")) == before
        return err.removeprefix("pointchart: ").strip()

    return call


def uv_of(scan):
    return np.column_stack([scan.attributes["u"], scan.attributes["v"]])


def never(constant):
    raise AssertionError(f"{constant} is no JSON")


def strict_json(path):
    """Read JSON as the standard has it, without NaN and Infinity."""
    return json.loads(path.read_text(), parse_constant=never)


# What is written


@pytest.mark.parametrize("suffix", ["STEP", "igs", "brep"])
def test_a_cad_file_holds_a_surface_within_the_tolerance_of_every_point(run, cap, tmp_path, suffix):
    pytest.importorskip("OCP")
    words = ["--tolerance", "0.01", "--outliers", 0, "--deviations", "d.npz"]
    assert run("cap.ply", "-o", f"cap.{suffix}", *words)[0] == 0
    surface, loops, unit = read_cad(tmp_path / f"cap.{suffix}")
    uv = closest_parameters(surface, CAP.points, uv_of(read_scan(tmp_path / "d.npz")))
    assert np.linalg.norm(evaluate(surface, uv) - CAP.points, axis=1).max() <= 0.01
    assert (len(loops), unit) == (1, "mm")


@pytest.mark.parametrize("unit", ["um", "in"])
def test_the_unit_is_that_of_the_numbers_of_the_scan(run, cap, tmp_path, unit):
    pytest.importorskip("OCP")
    assert run("cap.ply", "-o", "cap.json", "--tolerance", "1%", "--unit", unit)[0] == 0
    code, err = run("cap.ply", "-o", "cap.step", "--tolerance", "1%", "--unit", unit)
    assert code == 0
    assert f"tolerance 0.02998 {unit} " in err
    ours, _, said = read_surface_json(tmp_path / "cap.json")
    surface, _, found = read_cad(tmp_path / "cap.step")
    assert (said, found) == (unit, unit)
    assert surface.control == pytest.approx(ours.control, abs=1e-10)


@pytest.mark.parametrize("suffix", ["ply", "stl", "glb"])
def test_a_mesh_of_the_surface_is_a_disc_as_near_to_the_sphere(run, cap, tmp_path, monkeypatch, suffix):
    monkeypatch.setattr("pointchart.cad.surface_writer.TESSELLATED", 1000)
    assert run("cap.ply", "-o", f"mesh.{suffix}", "--tolerance", "1%", "--quiet") == (0, "")
    mesh = read_scan(tmp_path / f"mesh.{suffix}")
    assert certify(mesh.points, mesh.triangles).is_disc
    assert np.abs(np.linalg.norm(mesh.points, axis=1) - 1).max() < 0.01 * DIAGONAL


@pytest.mark.parametrize("suffix", ["csv", "ply", "npz"])
def test_deviations_are_the_distances_of_points_from_their_feet(run, cap, tmp_path, suffix):
    code, _ = run("cap.ply", "-o", "cap.json", "--tolerance", "1%", "--deviations", f"d.{suffix}")
    assert code == 0
    table = read_scan(tmp_path / f"d.{suffix}")
    signed, uv = table.attributes["deviation"], uv_of(table)
    surface, _, _ = read_surface_json(tmp_path / "cap.json")
    assert np.array_equal(table.points, CAP.points)
    assert np.linalg.norm(evaluate(surface, uv) - CAP.points, axis=1) == pytest.approx(np.abs(signed), abs=1e-15)
    assert suffix == "csv" or np.array_equal(table.attributes["intensity"], np.linspace(0, 1, 500, dtype=np.float32))


def test_repeated_points_and_other_parts_keep_their_rows(run, tmp_path):
    np.save(tmp_path / "scan.npy", np.r_[CAP.points[[7]], FAR, CAP.points])
    words = ["--component", "largest", "--tolerance", 0.03, "--deviations", "d.ply"]
    assert run("scan.npy", "-o", "s.json", *words)[0] == 0
    table = read_scan(tmp_path / "d.ply")
    assert table.attributes["point_index"].tolist() == [0, *(i for i in range(31, 531) if i != 38)]
    assert np.array_equal(table.points, np.load(tmp_path / "scan.npy")[table.attributes["point_index"]])


def test_the_report_is_json_of_what_was_done_and_how_far_the_scan_is(run, cap, tmp_path):
    words = ["--tolerance", "0.1%", "--outliers", "0.4%", "--report", "run.json", "--deviations", "d.csv"]
    assert run("cap.ply", "-o", "cap.json", *words)[0] == 0
    report = strict_json(tmp_path / "run.json")
    assert {"points", "options", "stages", "boundary", "certificate", "quality", "surface"} <= set(report)
    assert [stage["name"] for stage in report["stages"]][-3:] == ["fit", "quality", "self-intersections"]
    assert report["options"]["tolerance"] == "0.1%"
    table, held = read_scan(tmp_path / "d.csv"), report["surface"]
    signed = table.attributes["deviation"]
    assert (held["met"], held["tolerance"]) == (True, pytest.approx(0.001 * DIAGONAL))
    assert np.sort(np.abs(signed))[-3] <= held["tolerance"]
    assert held["worst_at"] == table.points[np.argmax(np.abs(signed))].tolist()
    surface, loops, _ = read_surface_json(tmp_path / "cap.json")
    assert held["control_points"] == list(surface.control.shape[:2])
    assert held["trimming_loops"] == [len(loop) for loop in loops]


def test_pictures_are_drawn_of_deviations_and_reflections(run, cap, tmp_path, monkeypatch):
    monkeypatch.setattr("pointchart.look.surface_pictures.PIXELS", 20_000)
    words = ["--tolerance", "1%", "--picture", "d.png", "--reflections", "r.png"]
    assert run("cap.ply", "-o", "cap.json", *words)[0] == 0
    assert all((tmp_path / name).read_bytes()[:8] == b"\x89PNG\r\n\x1a\n" for name in ("d.png", "r.png"))


# What is said


def test_the_figures_go_to_stderr_and_the_file_is_named_last(run, cap):
    code, err = run("cap.ply", "-o", "cap.json", "--tolerance", "1%")
    lines = err.splitlines()
    assert (code, lines[0], lines[-1]) == (0, f"boundary of {len(CAP.boundary)} points, found", "cap.json")
    assert "B-spline surface of degree 3, 7 x 7 control points for 500 points" in lines[1]
    assert lines[2] == "tolerance 0.02998 mm but for 0.5 % outliers: met"
    assert {"max", "95 %", "RMS", "mean"} <= {line.split(":")[0].strip() for line in lines[3:]}
    assert run("cap.ply", "-o", "cap.json", "--tolerance", "1%", "--explain", "--quiet") == (0, "")


def test_explain_says_level_by_level_where_refinement_ended(run, cap):
    code, err = run("cap.ply", "-o", "cap.json", "--tolerance", "1%", "--explain")
    assert code == 0
    assert "  1: 49 control points, fairness " in err
    assert "ended because the tolerance is met" in err
    code, err = run("cap.ply", "-o", "cap.json", "--tolerance", 1e-9, "--max-control-points", 60, "--explain")
    assert code == 1
    assert "ended because no more control points are allowed" in err


# Options


@pytest.mark.parametrize("degree", [2, 5])
def test_the_surface_has_the_degree_asked_for(run, cap, tmp_path, degree):
    assert run("cap.ply", "-o", "cap.json", "--tolerance", "1%", "--degree", degree)[0] == 0
    assert read_surface_json(tmp_path / "cap.json")[0].degree == degree


def test_a_fairness_given_is_that_of_all_levels(run, cap, tmp_path):
    words = ["--fairness", "1e-4", "--tolerance", "0.05%", "--best-effort", "--report", "run.json"]
    assert run("cap.ply", "-o", "cap.json", *words)[0] == 0
    assert {level["fairness"] for level in strict_json(tmp_path / "run.json")["surface"]["levels"]} == {1e-4}


def test_robust_fits_come_nearer_to_the_surface_under_outliers(run, tmp_path):
    rng = np.random.default_rng(2)
    off = np.where(rng.random(500) < 0.08, 0.06, 0.0) * (np.arange(500) >= len(CAP.boundary))
    np.save(tmp_path / "scan.npy", CAP.points * (1 + off + 0.001 * rng.normal(size=500))[:, None])
    far = {}
    for words in ([], ["--robust"]):
        assert run("scan.npy", "-o", "s.json", "--tolerance", "1%", "--outliers", "10%", *words)[0] == 0
        surface, loops, _ = read_surface_json(tmp_path / "s.json")
        inside = loops[0].mean(axis=0) + 0.7 * (loops[0] - loops[0].mean(axis=0))
        far[len(words)] = np.abs(np.linalg.norm(evaluate(surface, inside), axis=1) - 1).mean()
    assert far[1] < 0.6 * far[0]


def test_gaps_are_cut_out_or_bridged_as_asked_for(run, ring, refused, tmp_path):
    assert "the surface has a second boundary" in refused("ring.ply", "--tolerance", "1%")
    for holes, n_loops in (("open", 2), ("bridge", 1)):
        assert run("ring.ply", "-o", "r.json", "--tolerance", "1%", "--holes", holes)[0] == 0
        assert len(read_surface_json(tmp_path / "r.json")[1]) == n_loops


def test_small_gaps_are_cut_out_if_nothing_is_said(run, tmp_path):
    shape = shapes.pierce(shapes.relief(700), n_gaps=1, radius_in_spacings=3.5)
    np.save(tmp_path / "scan.npy", shape.points)
    code, err = run("scan.npy", "-o", "s.json", "--tolerance", "1%")
    assert code == 0
    assert "1 gap of the scan, 1 left open" in err
    assert "trimmed by its boundary and a gap" in err
    assert len(read_surface_json(tmp_path / "s.json")[1]) == 2


def test_a_boundary_given_trims_the_surface(run, cap, tmp_path):
    write_loop(tmp_path / "loop.txt", CAP.boundary)
    words = ["--tolerance", "1%", "--boundary", "loop.txt", "--report", "run.json"]
    code, err = run("cap.ply", "-o", "cap.json", *words)
    assert code == 0
    assert f"boundary of {len(CAP.boundary)} points, as given" in err
    assert strict_json(tmp_path / "run.json")["boundary"]["origin"] == "given"


def test_a_surface_out_of_tolerance_is_written_where_the_best_is_asked_for(run, cap, tmp_path):
    words = ["--tolerance", 1e-9, "--best-effort", "--report", "run.json"]
    code, err = run("cap.ply", "-o", "cap.json", *words)
    assert code == 0
    assert "tolerance 1e-09 mm but for 0.5 % outliers: NOT met" in err
    held = strict_json(tmp_path / "run.json")["surface"]
    assert (held["met"], len(read_surface_json(tmp_path / "cap.json")[1])) == (False, 1)


# What is refused


def test_a_tolerance_that_is_not_met_is_said_with_figures_and_options(refused, cap):
    words = ["--tolerance", 1e-9, "--report", "run.json", "--deviations", "d.csv", "--max-control-points", 60]
    said = refused("cap.ply", *words)
    assert said.startswith("the surface of 49 control points deviates by 0.00")
    assert "more than the tolerance of 1e-09" in said
    assert said.endswith(
        "; allow more control points (--max-control-points), take a larger tolerance (--tolerance), or take the best "
        "that there is (--best-effort)"
    )


def test_noise_is_not_followed_and_the_tolerance_it_allows_is_named(refused, tmp_path):
    noise = 0.01 * np.random.default_rng(0).normal(size=(500, 3))
    np.save(tmp_path / "scan.npy", CAP.points + noise)
    said = refused("scan.npy", "--tolerance", "0.1%", "--max-control-points", 500)
    assert "finer knots would follow noise" in said
    assert re.search(r"which allows a tolerance of about 0\.0\d+; take a larger tolerance \(--tolerance\), or ", said)
    assert "--max-control-points" not in said


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--tolerance", "0"], "--tolerance is '0'; it has to be above 0 and finite"),
        (["--tolerance", "0%"], "--tolerance is '0%'; it has to be above 0 and finite"),
        (["--tolerance=-1"], "--tolerance is '-1'; it has to be above 0 and finite"),
        (["--tolerance", "nan"], "--tolerance is 'nan'; it has to be above 0 and finite"),
        (["--tolerance", "inf%"], "--tolerance is 'inf%'; it has to be above 0 and finite"),
        (["--tolerance", "abc"], "--tolerance is 'abc'; a number is needed, or one with %, such as 0.1%"),
        (["--tolerance", "%"], "--tolerance is '%'; a number is needed, or one with %, such as 0.1%"),
        (["--outliers", "200%"], "--outliers is '200%'; it has to be at least 0 and below 100%"),
        (["--outliers", "1"], "--outliers is '1'; it has to be at least 0 and below 100%"),
        (["--outliers=-0.1"], "--outliers is '-0.1'; it has to be at least 0 and below 100%"),
        (["--fairness=-1"], "--fairness is '-1'; auto is needed, or a finite number from 0, such as 1e-5"),
        (["--fairness", "much"], "--fairness is 'much'; auto is needed, or a finite number from 0, such as 1e-5"),
        (["--degree", "6"], "--degree"),
        (["--max-control-points", "0"], "--max-control-points"),
        (["--unit", "km"], "'km' is not one of 'mm', 'cm', 'm', 'um', 'in', 'ft'"),
        (["--boundary", "loop.txt", "--outer", "0,0,0"], "--boundary and --outer exclude each other"),
    ],
)
def test_wrong_usage_is_said_before_the_scan_is_read(run, tmp_path, words, sentence):
    code, err = run("none.ply", "-o", "cap.json", *words)
    assert code == 2
    assert sentence in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("words", "out", "sentence"),
    [
        ([], "cap.docx", "cap.docx: the suffix '.docx' cannot be written here; choose one of .step, "),
        ([], "cap.ply", "cap.ply: the output is also cap.ply, which would be lost; choose another output"),
        (["--deviations", "d.xyz"], "o.json", "d.xyz: the suffix '.xyz' cannot be written here; choose one of .csv"),
        (["--report", "o.json"], "o.json", "o.json: the output is also o.json, which would be lost"),
        (["--picture", "p.jpg"], "o.json", "p.jpg: the suffix '.jpg' cannot be written here; choose one of .png"),
        (["--deviations", "no/d.csv"], "o.json", "no/d.csv: the folder "),
        (["--tolerance", "200%"], "o.json", "the tolerance of 5.99552 is 2 times the scan, 2.998 across"),
        (["--tolerance", "1e9"], "o.json", "the tolerance of 1e+09 is "),
        (["--max-control-points", "3"], "o.json", "3 control points are too few"),
    ],
)
def test_what_cannot_be_done_is_said_in_one_sentence(run, cap, tmp_path, words, out, sentence):
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    code, err = run("cap.ply", "-o", out, *words, "--quiet")
    assert (code, len(err.splitlines())) == (1, 1)
    assert err.startswith(f"pointchart: {sentence}")
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_a_boundary_file_is_not_replaced_by_the_deviations(refused, cap, tmp_path):
    write_loop(tmp_path / "loop.csv", CAP.boundary)
    said = refused("cap.ply", "--boundary", "loop.csv", "--deviations", "loop.csv")
    assert said == "loop.csv: the output is also loop.csv, which would be lost; choose another output"


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        (CAP.points[:3], "the scan has 3 points; a surface patch needs at least 4"),
        (shapes.hemisphere(20).points, "no boundary was found"),
        (shapes.hemisphere(60).points, "30 control points, half as many as points, are too few"),
        (shapes.sphere(400).points, "no boundary was found"),
        (np.zeros((100, 3)), "all 100 points are the same"),
        (np.r_[CAP.points, [[np.nan, 0, 0]]], "there is 1 row without coordinates, the first is row 500"),
        (np.r_[CAP.points, [[0, np.inf, 0]]], "there is 1 row without coordinates, the first is row 500"),
    ],
)
def test_scans_that_hold_no_patch_are_refused_whatever_the_tolerance(refused, tmp_path, points, sentence):
    np.save(tmp_path / "scan.npy", points)
    assert refused("scan.npy", "--tolerance", "1%").startswith(sentence)


def test_cad_files_need_the_extra_and_say_so_at_once(refused, monkeypatch):
    for name in ("OCP", "OCP.collections"):
        monkeypatch.setitem(sys.modules, name, None)
    said = refused("none.ply", out="out.step")
    assert said.startswith("out.step: the package OCP 8 (Open CASCADE) is not installed; pip install ")


def test_a_full_disk_leaves_everything_as_it_was(refused, cap, full_disk):
    said = refused("cap.ply", "--tolerance", "1%", "--report", "run.json", "--deviations", "d.csv")
    assert "No space left on device" in said


# As a process of its own


def test_ctrl_c_during_the_fit_ends_with_130_and_leaves_the_old_file(tmp_path):
    np.save(tmp_path / "scan.npy", shapes.relief(2000).points)
    (tmp_path / "s.step").write_text("old")
    words = ["scan.npy", "-o", "s.step", "--tolerance", "0.001%", "--report", "run.json", "--deviations", "d.csv"]
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, "fit", *words],
        cwd=tmp_path,
        env={**os.environ, "PYTHONWARNINGS": "default"},
        capture_output=True,
        text=True,
        # A shell's background job ignores Ctrl-C, and its children would inherit that.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    assert (done.returncode, done.stdout) == (130, "")
    assert "Traceback" not in done.stderr
    assert (tmp_path / "s.step").read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["s.step", "scan.npy"]


def test_a_four_sided_patch_has_its_own_border_and_the_corners_that_are_named(run, tmp_path):
    np.save(tmp_path / "scan.npy", shapes.bent_sheet(90, nx=25, ny=17).points)
    words = ["--tolerance", "2%", "--domain", "square", "--corners", "0,24,424,400"]
    assert run("scan.npy", "-o", "o.json", *words)[0] == 0
    surface, loops, _ = read_surface_json(tmp_path / "o.json")
    assert [loop.tolist() for loop in loops] == [[[0, 0], [1, 0], [1, 1], [0, 1]]]
    corners = np.load(tmp_path / "scan.npy")[[0, 24, 424, 400]]
    nearest = np.linalg.norm(surface.control[[0, 0, -1, -1], [0, -1, -1, 0]][:, None] - corners, axis=2).argmin(axis=1)
    assert sorted(nearest) == [0, 1, 2, 3]
