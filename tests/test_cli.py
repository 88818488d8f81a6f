import json
import os
import signal
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest

from pointchart import certify, read_loop, read_scan, shapes, write_loop, write_mesh
from pointchart.cli import main

NO_FACES = np.empty((0, 3), np.int64)
COMMAND = [sys.executable, "-c", "from pointchart.cli import main; main()"]
# Sends itself Ctrl-C once the named stage has begun, and its workers have where it has any.
INTERRUPTED = """
import os, signal, sys, threading, time
from contextlib import nullcontext
from pointchart import cli, clock
stage, delay = sys.argv.pop(1), float(sys.argv.pop(1))
def interrupt():
    start, own = time.perf_counter(), threading.active_count()
    while threading.active_count() == own and time.perf_counter() < start + delay:
        time.sleep(0.001)
    os.kill(os.getpid(), signal.SIGINT)
def announce(name):
    if name == stage:
        threading.Thread(target=interrupt, daemon=True).start()
cli.mesh.staged = lambda quiet: nullcontext(clock.StageClock(announce))
cli.main()
"""


@pytest.fixture
def run(monkeypatch, capsys, tmp_path):
    """Run the command line in this process, in an empty folder; return its exit code, stdout and stderr."""
    monkeypatch.chdir(tmp_path)

    def call(*words):
        monkeypatch.setattr(sys, "argv", ["pointchart", *map(str, words)])
        with pytest.raises(SystemExit) as left:
            main()
        out, err = capsys.readouterr()
        return left.value.code or 0, out, err

    return call


@pytest.fixture
def cap(tmp_path):
    """Write a scan with colour and intensity to cap.ply, and return its shape."""
    shape = shapes.hemisphere(500)
    red, intensity = np.arange(500, dtype=np.uint8), np.linspace(0, 1, 500, dtype=np.float32)
    write_mesh(tmp_path / "cap.ply", shape.points, NO_FACES, attributes={"red": red, "intensity": intensity})
    return shape


def texture_of(path):
    """Return the vertices, texture coordinates and faces (vertex/texture) of an OBJ file."""
    words = [line.split() for line in path.read_text().splitlines()]
    numbers = {key: [row[1:] for row in words if row and row[0] == key] for key in ("v", "vt", "f")}
    corners = np.array([[corner.split("/")[:2] for corner in face] for face in numbers["f"]], dtype=int)
    return np.array(numbers["v"], dtype=float), np.array(numbers["vt"], dtype=float), corners


# pointchart mesh


@pytest.mark.parametrize("suffix", ["ply", "obj", "off", "npz"])
def test_mesh_writes_vertex_i_for_point_i(run, cap, tmp_path, suffix):
    assert run("mesh", "cap.ply", "-o", f"mesh.{suffix}")[0] == 0
    mesh = read_scan(tmp_path / f"mesh.{suffix}")
    assert np.array_equal(mesh.points, cap.points)
    assert certify(mesh.points, mesh.triangles, loop=cap.boundary).is_disc


def test_mesh_writes_all_points_in_single_precision_as_glb(run, cap, tmp_path):
    assert run("mesh", "cap.ply", "-o", "mesh.glb")[0] == 0
    mesh = read_scan(tmp_path / "mesh.glb")
    assert np.abs(mesh.points - cap.points).max() < 1e-6
    assert certify(mesh.points, mesh.triangles, loop=cap.boundary).is_disc


def test_mesh_writes_a_disc_of_loose_triangles_as_stl(run, cap, tmp_path):
    assert run("mesh", "cap.ply", "-o", "mesh.stl")[0] == 0
    mesh = read_scan(tmp_path / "mesh.stl")
    proof = certify(mesh.points, mesh.triangles)
    assert (proof.n_points, proof.is_disc) == (500, True)


def test_mesh_gives_parameters_as_doubles_and_carries_what_the_scan_had(run, cap, tmp_path):
    assert run("mesh", "cap.ply", "-o", "mesh.ply")[0] == 0
    header = (tmp_path / "mesh.ply").read_bytes().split(b"end_header")[0].decode()
    assert "property double u\n" in header
    assert "property double v\n" in header
    mesh = read_scan(tmp_path / "mesh.ply")
    assert mesh.attributes["red"].dtype == np.uint8
    assert np.array_equal(mesh.attributes["red"], np.arange(500, dtype=np.uint8))
    assert np.array_equal(mesh.attributes["intensity"], np.linspace(0, 1, 500, dtype=np.float32))
    assert "point_index" not in mesh.attributes
    uv = np.column_stack([mesh.attributes["u"], mesh.attributes["v"]])
    assert certify(mesh.points, mesh.triangles, uv=uv).is_one_to_one


def test_mesh_writes_parameters_as_vt_into_obj(run, cap, tmp_path):
    assert run("mesh", "cap.ply", "-o", "mesh.obj")[0] == 0
    assert run("mesh", "cap.ply", "-o", "mesh.ply")[0] == 0
    points, texture, corners = texture_of(tmp_path / "mesh.obj")
    mesh = read_scan(tmp_path / "mesh.ply")
    uv = np.column_stack([mesh.attributes["u"], mesh.attributes["v"]])
    assert np.array_equal(points, cap.points)
    assert np.array_equal(texture[corners[..., 1] - 1], uv[corners[..., 0] - 1])


def test_mesh_merges_repeated_points_says_so_and_gives_their_rows(run, tmp_path):
    points = shapes.hemisphere(500).points
    np.save(tmp_path / "scan.npy", np.r_[points[[7]], points, points[[3]]])
    code, _, err = run("mesh", "scan.npy", "-o", "mesh.ply", "--report", "run.json")
    assert code == 0
    assert "2 repeated points merged to the first; point_index gives each vertex's row" in err
    mesh = read_scan(tmp_path / "mesh.ply")
    rows = mesh.attributes["point_index"]
    assert rows.dtype == np.int32
    assert rows.tolist() == [i for i in range(501) if i != 8]
    assert np.array_equal(mesh.points, np.r_[points[[7]], points][rows])
    assert json.loads(Path("run.json").read_text())["points"] == {"read": 502, "distinct": 500, "repeated": 2}
    assert run("check", "mesh.ply", "--points", "scan.npy")[0] == 0


def test_mesh_reports_its_run_with_the_options_given(run, cap, tmp_path):
    write_loop(tmp_path / "loop.txt", cap.boundary)
    words = ["--neighbors", "nearest", "-k", 15, "--weights", "reciprocal", "--swap", "none", "--uv", "paper"]
    assert run("mesh", "cap.ply", "-o", "m.ply", *words, "--boundary", "loop.txt", "--report", "run.json")[0] == 0
    report = json.loads((tmp_path / "run.json").read_text())
    contract = {"points", "options", "stages", "peak_memory_mb", "boundary", "solve", "certificate", "quality"}
    assert contract <= set(report)
    assert {"neighbors": "nearest", "k": 15, "weights": "reciprocal", "swap": "none", "uv": "paper"}.items() <= report[
        "options"
    ].items()
    assert report["options"]["domain"] == "circle"
    assert report["boundary"]["origin"] == "given"
    assert report["boundary"]["points"] == len(cap.boundary)
    assert report["swaps"]["count"] == 0


@pytest.mark.parametrize("neighbors", [["nearest", "-k", "20"], ["ball", "--radius", "0.4"], ["delaunay"]])
@pytest.mark.parametrize("weights", ["uniform", "reciprocal", "shape-preserving", "mean-value"])
def test_mesh_knows_the_methods_of_the_paper(run, cap, tmp_path, neighbors, weights):
    code, _, err = run("mesh", "cap.ply", "-o", "m.ply", "--neighbors", *neighbors, "--weights", weights, "--quiet")
    if neighbors[0] != "delaunay" and weights in ("shape-preserving", "mean-value"):
        assert code == 1
        assert "use Delaunay stars" in err
        assert not (tmp_path / "m.ply").exists()
    else:
        assert code == 0
        assert len(read_scan(tmp_path / "m.ply").triangles) == 2 * 500 - 2 - len(cap.boundary)


@pytest.mark.parametrize("spacing", ["chord", "uniform", "centripetal"])
def test_mesh_lays_the_boundary_out_on_a_square(run, cap, tmp_path, spacing):
    corners = ",".join(map(str, cap.boundary[[0, 9, 20, 30]]))
    words = ["--domain", "square", "--spacing", spacing, "--corners", corners]
    assert run("mesh", "cap.ply", "-o", "m.ply", *words)[0] == 0
    mesh = read_scan(tmp_path / "m.ply")
    uv = np.column_stack([mesh.attributes["u"], mesh.attributes["v"]])
    assert uv[cap.boundary[[0, 9, 20, 30]]].tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert certify(mesh.points, mesh.triangles, uv=uv).is_one_to_one


def test_mesh_prints_the_certificate_on_stderr_and_nothing_on_stdout(run, cap):
    code, out, err = run("mesh", "cap.ply", "-o", "m.ply")
    assert (code, out) == (0, "")
    assert "[ok] Euler characteristic 1" in err
    assert "[!!]" not in err
    assert f"boundary of {len(cap.boundary)} points, found" in err
    assert err.splitlines()[-1].startswith("m.ply: a certified disc: 500 points")


def test_mesh_says_what_a_format_cannot_hold(run, cap):
    assert "pointchart writes no u, v, red, intensity to OFF" in run("mesh", "cap.ply", "-o", "m.off")[2]


def test_quiet_commands_print_nothing(run, cap):
    assert run("mesh", "cap.ply", "-o", "m.ply", "--quiet") == (0, "", "")
    assert run("check", "m.ply", "--points", "cap.ply", "--quiet") == (0, "", "")
    assert run("boundary", "cap.ply", "-o", "loop.txt", "--quiet") == (0, "", "")
    assert run("param", "cap.ply", "-o", "uv.csv", "--quiet") == (0, "", "")


# pointchart param


@pytest.mark.parametrize("suffix", ["csv", "txt", "xyz", "npy", "npz", "ply"])
def test_param_writes_one_row_of_parameters_for_each_point(run, cap, tmp_path, suffix):
    path = tmp_path / f"uv.{suffix}"
    assert run("param", "cap.ply", "-o", path)[0] == 0
    if suffix == "npy":
        uv = np.load(path)
    elif suffix in ("npz", "ply"):
        scan = read_scan(path)
        uv = np.column_stack([scan.attributes["u"], scan.attributes["v"]])
        assert np.array_equal(scan.points, cap.points)
    else:
        uv = np.loadtxt(path, delimiter="," if suffix == "csv" else None, skiprows=int(suffix == "csv"))
    assert uv.shape == (500, 2)
    assert np.linalg.norm(uv[cap.boundary], axis=1) == pytest.approx(1)
    assert np.linalg.norm(np.delete(uv, cap.boundary, axis=0), axis=1).max() < 1


def test_param_gives_repeated_points_the_same_parameters(run, tmp_path):
    points = shapes.hemisphere(500).points
    np.save(tmp_path / "scan.npy", np.r_[points, points[[3, 7]]])
    assert run("param", "scan.npy", "-o", "uv.npy")[0] == 0
    uv = np.load(tmp_path / "uv.npy")
    assert np.array_equal(uv[500:], uv[[3, 7]])


def test_param_reports_its_solve(run, cap, tmp_path):
    words = ["--neighbors", "nearest", "-k", 12, "--weights", "uniform", "--report", "run.json"]
    code, _, err = run("param", "cap.ply", "-o", "uv.npy", *words)
    assert code == 0
    assert "parameters of 500 points, 0 of which coincide" in err
    report = json.loads((tmp_path / "run.json").read_text())
    assert report["solve"]["unknowns"] == 500 - len(cap.boundary)
    assert report["options"]["weights"] == "uniform"
    assert report["coinciding_uv"] == 0


# pointchart boundary


def test_boundary_writes_the_loop_one_index_a_line(run, cap, tmp_path):
    code, out, err = run("boundary", "cap.ply", "-o", "loop.txt")
    assert (code, out) == (0, "")
    lines = (tmp_path / "loop.txt").read_text().splitlines()
    assert set(map(int, lines)) == set(cap.boundary)
    assert len(lines) == len(cap.boundary)
    assert f"a loop of {len(lines)} points" in err


def test_an_edited_boundary_is_the_boundary_of_the_mesh(run, cap, tmp_path):
    assert run("boundary", "cap.ply", "-o", "loop.txt")[0] == 0
    lines = (tmp_path / "loop.txt").read_text().splitlines()
    edited = [line for place, line in enumerate(lines) if place != 4]
    (tmp_path / "loop.txt").write_text("# without the fifth\n" + "\n".join(edited) + "\n")
    code, _, err = run("mesh", "cap.ply", "-o", "m.ply", "--boundary", "loop.txt")
    assert code == 0
    assert f"boundary of {len(edited)} points, as given" in err
    mesh = read_scan(tmp_path / "m.ply")
    assert certify(mesh.points, mesh.triangles, loop=read_loop(tmp_path / "loop.txt")).is_disc


# pointchart check


def test_check_passes_a_good_mesh_with_its_scan(run, cap):
    run("mesh", "cap.ply", "-o", "m.ply")
    code, out, err = run("check", "m.ply", "--points", "cap.ply", "--report", "check.json")
    assert (code, out) == (0, "")
    assert "[ok] uv distinct" in err
    assert json.loads(Path("check.json").read_text())["certificate"]["disc"] is True


@pytest.mark.parametrize(
    ("shape", "fault"),
    [
        (shapes.annulus(20, 4), "its Euler characteristic is 0 instead of 1, it has 2 boundary loops instead of 1"),
        (shapes.sphere(60), "its Euler characteristic is 2 instead of 1, it has 0 boundary loops instead of 1"),
        (shapes.torus(12, 8), "its Euler characteristic is 0 instead of 1"),
        (shapes.moebius(24, 4), "edges have more than two triangles or turn over"),
    ],
    ids=["annulus", "sphere", "torus", "Moebius strip"],
)
def test_check_fails_a_mesh_that_is_no_disc(run, tmp_path, shape, fault):
    write_mesh(tmp_path / "mesh.ply", shape.points, shape.triangles)
    code, _, err = run("check", "mesh.ply")
    assert code == 1
    assert fault in err
    assert run("check", "mesh.ply", "--quiet")[0] == 1


def test_check_fails_a_mesh_whose_parameters_fold(run, cap, tmp_path):
    write_mesh(tmp_path / "mesh.ply", cap.points, cap.triangles, uv=cap.uv * [-1, 1])
    code, _, err = run("check", "mesh.ply")
    assert code == 1
    assert f"uv folded at {len(cap.triangles)} triangles" in err


def test_check_fails_an_unused_point(run, cap, tmp_path):
    write_mesh(tmp_path / "mesh.ply", np.r_[cap.points, [[0, 0, 0.5]]], cap.triangles)
    code, _, err = run("check", "mesh.ply")
    assert code == 1
    assert "[!!] every point used: 1 unused" in err


def test_check_refuses_a_cloud_and_a_mesh_of_another_scan(run, cap, tmp_path):
    code, _, err = run("check", "cap.ply")
    assert code == 1
    assert "the file has 500 points and no triangles; give a mesh" in err
    np.save(tmp_path / "other.npy", shapes.hemisphere(200).points)
    run("mesh", "cap.ply", "-o", "m.ply")
    code, _, err = run("check", "m.ply", "--points", "other.npy")
    assert code == 1
    assert "m.ply has 500 vertices, other.npy 200 points; they do not belong together" in err
    moved = cap.points.copy()
    moved[[4, 9]] += 0.01
    np.save(tmp_path / "other.npy", moved)
    code, _, err = run("check", "m.ply", "--points", "other.npy")
    assert code == 1
    assert "2 vertices of m.ply are not where other.npy has them (points 4, 9)" in err


# pointchart demo


def test_demo_writes_scan_mesh_and_picture(run, tmp_path):
    code, out, err = run("demo", "-o", "shown")
    assert (code, out) == (0, "")
    assert "a certified disc" in err
    scan, mesh = read_scan(tmp_path / "shown/scan.ply"), read_scan(tmp_path / "shown/mesh.ply")
    assert np.array_equal(scan.points, mesh.points)
    assert certify(mesh.points, mesh.triangles).is_disc
    picture = (tmp_path / "shown/picture.png").read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert len(picture) > 50_000
    assert sorted(path.name for path in (tmp_path / "shown").iterdir()) == ["mesh.ply", "picture.png", "scan.ply"]


# Usage


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["mesh", "cap.ply"], "Missing option"),
        (["mesh", "-o", "m.ply"], "Missing argument"),
        (["mesh", "cap.ply", "-o", "m.ply", "--weights", "heavy"], "--weights"),
        (["mesh", "cap.ply", "-o", "m.ply", "--nonsense"], "--nonsense"),
        (["mesh", "cap.ply", "-o", "m.ply", "-k", "0"], "-k"),
        (["mesh", "cap.ply", "-o", "m.ply", "-k", "many"], "-k"),
        (["mash"], "mash"),
        (["demo", "-o", "cap.ply"], "cap.ply is a file; name a folder"),
    ],
)
def test_wrong_usage_exits_with_2_and_writes_nothing(run, cap, tmp_path, words, said):
    code, out, err = run(*words)
    assert (code, out) == (2, "")
    assert said in err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cap.ply"]


@pytest.mark.parametrize("command", ["mesh", "param", "boundary", "check", "demo"])
def test_every_command_explains_itself(run, command):
    code, out, _ = run(command, "--help")
    assert code == 0
    assert f"pointchart {command}" in out


# As a process of its own


def test_a_process_meshes_a_scan_and_exits_with_0(cap, tmp_path):
    done = subprocess.run([*COMMAND, "mesh", "cap.ply", "-o", "m.ply"], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, "")
    assert "a certified disc: 500 points" in done.stderr
    assert len(read_scan(tmp_path / "m.ply").triangles) == 2 * 500 - 2 - len(cap.boundary)


def test_a_process_ends_a_bad_run_with_1_and_one_sentence(tmp_path):
    np.save(tmp_path / "ball.npy", shapes.sphere(400).points)
    done = subprocess.run(
        [*COMMAND, "mesh", "ball.npy", "-o", "m.ply", "--quiet"], cwd=tmp_path, capture_output=True, text=True
    )
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("pointchart: no boundary was found")
    assert len(done.stderr.splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["ball.npy"]


@pytest.mark.parametrize(("stage", "delay"), [("prepare", 0.05), ("neighbours", 1.0), ("boundary", 0.5), ("map", 0.1)])
def test_ctrl_c_ends_a_run_with_130_and_leaves_the_old_file(tmp_path, stage, delay):
    uv = np.random.default_rng(0).random((100_000, 2))
    np.save(tmp_path / "scan.npy", np.c_[uv, 0.1 * np.sin(6 * uv[:, 0]) * np.cos(5 * uv[:, 1])])
    (tmp_path / "m.ply").write_text("old")
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, stage, str(delay), "mesh", "scan.npy", "-o", "m.ply"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONWARNINGS": "default"},
        capture_output=True,
        text=True,
        # A shell's background job ignores Ctrl-C, and its children would inherit that.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    assert done.returncode == 130
    assert "Traceback" not in done.stderr
    assert (tmp_path / "m.ply").read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["m.ply", "scan.npy"]


def test_the_version_is_that_of_the_package(run):
    assert run("--version") == (0, f"pointchart {version('pointchart')}\n", "")


def test_help_has_a_short_name_and_lists_the_commands(run):
    code, out, _ = run("-h")
    assert code == 0
    assert all(command in out for command in ("mesh", "param", "boundary", "check", "demo"))
