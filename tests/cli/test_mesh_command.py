import json
import os
import re
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest
import trimesh

from pointchart import certify, find_boundary, read_loop, read_scan, shapes, write_loop, write_mesh
from pointchart.boundary import bounded as survey

NO_FACES = np.empty((0, 3), np.int64)
FAR = shapes.grid(6, 5).points + np.array([0, 0, 50])
SCORES = ["score_total", "score_gap", "score_half_disc", "score_width", "score_uncovered"]
COMMAND = [sys.executable, "-m", "pointchart"]
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
def run(command_line, monkeypatch, tmp_path):
    """Run the command line in an empty folder; return its exit code, stdout and stderr."""
    monkeypatch.chdir(tmp_path)
    return command_line


@pytest.fixture
def cap(tmp_path):
    """Write a scan with colour and intensity to cap.ply, and return its shape."""
    shape = shapes.hemisphere(500)
    red, intensity = np.arange(500, dtype=np.uint8), np.linspace(0, 1, 500, dtype=np.float32)
    write_mesh(tmp_path / "cap.ply", shape.points, NO_FACES, attributes={"red": red, "intensity": intensity})
    return shape


@pytest.fixture
def ring(tmp_path):
    """Write a flat ring, its rows shuffled, to ring.ply; return its shape."""
    shape = shapes.shuffle(shapes.annulus(120, 5, inner_radius=0.8), seed=3)
    write_mesh(tmp_path / "ring.ply", shape.points, NO_FACES)
    return shape


@pytest.fixture
def parts(tmp_path):
    """Write a cap and a small sheet, their rows shuffled, to parts.ply; return the points and the rows of the cap."""
    order = np.random.default_rng(5).permutation(530)
    points = np.r_[shapes.hemisphere(500).points, FAR][order]
    attributes = {"id": np.arange(530, dtype=np.uint16), "point_index": np.full(530, -1, np.int32)}
    write_mesh(tmp_path / "parts.ply", points, NO_FACES, attributes=attributes)
    return points, np.flatnonzero(order < 500)


def rim_of(shape, radius):
    """Return the rows of the rim of a ring that has that radius."""
    return min(shape.loops, key=lambda loop: abs(np.linalg.norm(shape.points[loop[0]]) - radius))


def uv_of(mesh):
    return np.column_stack([mesh.attributes["u"], mesh.attributes["v"]])


def texture_of(path):
    """Return the vertices, texture coordinates and faces (vertex/texture) of an OBJ file."""
    words = [line.split() for line in path.read_text().splitlines()]
    numbers = {key: [row[1:] for row in words if row and row[0] == key] for key in ("v", "vt", "f")}
    corners = np.array([[corner.split("/")[:2] for corner in face] for face in numbers["f"]], dtype=int)
    return np.array(numbers["v"], dtype=float), np.array(numbers["vt"], dtype=float), corners


def edges_of(path):
    """Return the edges of a PLY file as another library reads them, (m, 2)."""
    table = trimesh.load(path, process=False).metadata["_ply_raw"]["edge"]["data"]
    return np.column_stack([table["vertex1"], table["vertex2"]])


def closed(loop):
    """Return the edges of a closed polyline."""
    return np.column_stack([loop, np.roll(loop, -1)])


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
    assert json.loads(Path("run.json").read_text())["points"] == {
        "read": 502,
        "distinct": 500,
        "repeated": 2,
        "left_out": 0,
    }
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
    curves = ["--ply", "loops.ply", "--picture", "loops.png"]
    assert run("boundary", "cap.ply", "-o", "loop.txt", *curves, "--quiet") == (0, "", "")
    assert run("param", "cap.ply", "-o", "uv.csv", "--quiet") == (0, "", "")


def test_quiet_commands_say_nothing_of_gaps_and_of_points_left_out(run, ring, parts):
    assert run("mesh", "ring.ply", "-o", "m.ply", "--holes", "open", "--quiet") == (0, "", "")
    assert run("check", "m.ply", "--holes", 1, "--quiet") == (0, "", "")
    assert run("boundary", "ring.ply", "-o", "loop.txt", "--quiet") == (0, "", "")
    assert run("mesh", "parts.ply", "-o", "m.ply", "--component", "largest", "--quiet") == (0, "", "")
    assert run("check", "m.ply", "--points", "parts.ply", "--quiet") == (0, "", "")


def test_holes_bridge_makes_a_disc_of_a_ring(run, ring, tmp_path):
    code, _, err = run("mesh", "ring.ply", "-o", "m.ply", "--holes", "bridge", "--report", "run.json")
    assert code == 0
    assert "1 gap of the scan, bridged, the largest " in err
    assert "m.ply: a certified disc: 600 points" in err
    mesh = read_scan(tmp_path / "m.ply")
    assert certify(mesh.points, mesh.triangles, uv=uv_of(mesh), loop=rim_of(ring, 1)).is_one_to_one
    report = json.loads(Path("run.json").read_text())
    assert report["options"]["holes"] == "bridge"
    assert len(report["boundary"]["gaps"]) == 1
    assert [loop["points"] for loop in report["boundary"]["loops"]] == [120, 120]
    assert (report["certificate"]["disc"], report["certificate"]["holes"]) == (True, 0)


def test_holes_open_leaves_the_hole_of_a_ring_and_check_passes_it_with_one_hole(run, ring, tmp_path):
    code, _, err = run("mesh", "ring.ply", "-o", "m.ply", "--holes", "open", "--report", "run.json")
    assert code == 0
    assert "1 gap of the scan, 1 left open, the largest " in err
    assert "[ok] 2 boundary loops, 1 of them round holes" in err
    assert "m.ply: a certified disc with a hole: 600 points" in err
    proof = json.loads(Path("run.json").read_text())["certificate"]
    assert (proof["disc"], proof["holes"], proof["as_asked"]) == (False, 1, True)
    assert (proof["euler"], proof["boundary_loops"], proof["every_point_used"]) == (0, 2, True)
    mesh = read_scan(tmp_path / "m.ply")
    assert np.array_equal(mesh.points, ring.points)
    corners = mesh.points[mesh.triangles]
    assert np.linalg.norm(corners.mean(axis=1), axis=1).min() > 0.7

    code, _, err = run("check", "m.ply", "--holes", 1, "--points", "ring.ply", "--report", "check.json")
    assert code == 0
    assert "m.ply: a certified disc with a hole: 600 points" in err
    assert json.loads(Path("check.json").read_text())["certificate"]["as_asked"] is True
    code, _, err = run("check", "m.ply")
    assert code == 1
    assert "m.ply is no disc: its Euler characteristic is 0 instead of 1, it has 2 boundary loops instead of 1" in err
    code, _, err = run("check", "m.ply", "--holes", 2)
    assert code == 1
    assert "its Euler characteristic is 0 instead of -1, it has 2 boundary loops instead of 3" in err


@pytest.mark.parametrize("n_gaps", [0, 1, 3])
def test_every_gap_is_bridged_unless_it_is_to_stay_open(run, tmp_path, n_gaps):
    shape = shapes.pierce(shapes.disc(1200), n_gaps=n_gaps, radius_in_spacings=3.5)
    np.save(tmp_path / "scan.npy", shape.points)
    assert len(shape.loops) == 1 + n_gaps
    said = f"{n_gaps} {'gap' if n_gaps == 1 else 'gaps'} of the scan, "
    for words, done, holes in (([], "bridged", 0), (["--holes", "open"], f"{n_gaps} left open", n_gaps)):
        code, _, err = run("mesh", "scan.npy", "-o", "m.ply", *words)
        assert code == 0
        assert (said + done in err) == (n_gaps > 0)
        assert run("check", "m.ply", "--holes", holes, "--points", "scan.npy", "--quiet")[0] == 0


def test_a_boundary_given_speaks_for_a_disc_with_gaps_that_may_stay_open(run, ring, tmp_path):
    outside = rim_of(ring, 1)
    write_loop(tmp_path / "loop.txt", outside)
    for words, holes in (([], 0), (["--holes", "open"], 1)):
        options = ["--boundary", "loop.txt", "--report", "run.json", *words]
        assert run("mesh", "ring.ply", "-o", "m.ply", *options)[0] == 0
        mesh, report = read_scan(tmp_path / "m.ply"), json.loads(Path("run.json").read_text())
        assert certify(mesh.points, mesh.triangles, loop=outside, holes=holes).is_as_asked
        assert (report["boundary"]["origin"], report["boundary"]["loops"]) == ("given", [])


@pytest.mark.parametrize(
    ("place", "radius"), [("0,0,0", 0.8), ("-0.8,0,0", 0.8), ("0,-0.89,0", 0.8), ("0.91, 0, 0", 1), ("0,-7,3e1", 1)]
)
def test_the_boundary_is_the_loop_nearest_to_the_place_given(run, ring, tmp_path, place, radius):
    rim = rim_of(ring, radius)
    assert run("boundary", "ring.ply", "-o", "loop.txt", "--outer", place)[0] == 0
    assert sorted(read_loop(tmp_path / "loop.txt")) == sorted(rim)
    assert run("param", "ring.ply", "-o", "uv.npy", "--outer", place)[0] == 0
    on_circle = np.isclose(np.linalg.norm(np.load(tmp_path / "uv.npy"), axis=1), 1, atol=1e-9)
    assert np.array_equal(np.flatnonzero(on_circle), np.sort(rim))
    assert run("mesh", "ring.ply", "-o", "m.ply", "--outer", place, "--report", "run.json")[0] == 0
    mesh, report = read_scan(tmp_path / "m.ply"), json.loads(Path("run.json").read_text())
    assert certify(mesh.points, mesh.triangles, uv=uv_of(mesh), loop=rim).is_one_to_one
    assert report["boundary"]["length"] == pytest.approx(2 * np.pi * radius, rel=1e-3)
    assert report["options"]["outer"] == place


def test_the_largest_part_is_meshed_as_if_it_were_alone(run, parts, tmp_path):
    points, rows = parts
    np.save(tmp_path / "alone.npy", points[rows])
    assert run("mesh", "alone.npy", "-o", "alone.ply")[0] == 0
    code, _, err = run("mesh", "parts.ply", "-o", "m.ply", "--component", "largest")
    assert code == 0
    assert "30 points in other parts left out; point_index gives each vertex's row" in err
    mesh, alone = read_scan(tmp_path / "m.ply"), read_scan(tmp_path / "alone.ply")
    assert np.array_equal(mesh.triangles, alone.triangles)
    assert np.array_equal(uv_of(mesh), uv_of(alone))
    assert np.array_equal(mesh.points, points[rows])


def test_the_largest_part_names_its_rows_and_carries_what_the_scan_had(run, parts, tmp_path):
    _, rows = parts
    assert run("mesh", "parts.ply", "-o", "m.ply", "--component", "largest")[0] == 0
    mesh = read_scan(tmp_path / "m.ply")
    assert sorted(mesh.attributes) == ["id", "point_index", "stretch", "u", "v"]
    assert mesh.attributes["point_index"].dtype == np.int32
    assert np.array_equal(mesh.attributes["point_index"], rows)
    assert mesh.attributes["id"].dtype == np.uint16
    assert np.array_equal(mesh.attributes["id"], rows)
    code, _, err = run("check", "m.ply", "--points", "parts.ply")
    assert code == 0
    assert "30 points of parts.ply are not in it" in err


def test_the_largest_part_of_a_scan_with_repeated_points_has_each_once(run, parts, tmp_path):
    points, rows = parts
    rest = np.setdiff1d(np.arange(530), rows)
    np.save(tmp_path / "scan.npy", np.r_[points, points[rows[[7, 9]]], points[rest[[1]]]])
    code, _, err = run("mesh", "scan.npy", "-o", "m.ply", "--component", "largest")
    assert code == 0
    left_out, merged = "31 points in other parts left out", "2 repeated points merged to the first"
    assert f"{left_out}, {merged}; point_index gives each vertex's row" in err
    assert np.array_equal(read_scan(tmp_path / "m.ply").attributes["point_index"], rows)
    code, _, err = run("check", "m.ply", "--points", "scan.npy")
    assert code == 0
    assert "30 points of scan.npy are not in it" in err


def test_the_largest_part_of_a_scan_in_one_piece_is_the_scan(run, cap, tmp_path):
    assert run("mesh", "cap.ply", "-o", "whole.ply")[0] == 0
    assert "left out" not in run("mesh", "cap.ply", "-o", "m.ply", "--component", "largest")[2]
    assert (tmp_path / "m.ply").read_bytes() == (tmp_path / "whole.ply").read_bytes()


def test_corners_are_rows_of_the_file_whatever_is_left_out(run, parts, tmp_path):
    _, rows = parts
    assert run("boundary", "parts.ply", "-o", "loop.txt", "--component", "largest")[0] == 0
    corners = read_loop(tmp_path / "loop.txt")[[0, 9, 20, 30]]
    words = ["--component", "largest", "--domain", "square", "--corners", ",".join(map(str, corners))]
    assert run("mesh", "parts.ply", "-o", "m.ply", *words)[0] == 0
    uv = uv_of(read_scan(tmp_path / "m.ply"))
    assert uv[np.searchsorted(rows, corners)].tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]


def test_a_loop_that_did_not_do_is_reported_by_the_rows_of_the_file(run, monkeypatch, tmp_path):
    # Were the rim of a gap taken for the boundary, the mesh would have to bridge the longer one.
    cap = shapes.hemisphere(2000).points
    np.save(tmp_path / "scan.npy", np.r_[FAR, cap[np.linalg.norm(cap - [0, 0, 1], axis=1) > 0.2]])
    monkeypatch.setattr(survey, "find_boundary", lambda *a, **k: find_boundary(*a, **k).beginning_with(1))
    code, _, err = run("mesh", "scan.npy", "-o", "m.ply", "--component", "largest", "--report", "run.json")
    assert code == 0
    boundary = json.loads(Path("run.json").read_text())["boundary"]
    assert boundary["length"] == pytest.approx(2 * np.pi, rel=0.01)
    assert "loop 2 of 2 by its scores: no mesh stood with 1 before it" in err
    (failure,) = boundary["tried_before"]
    rows = re.findall(r"through point (\d+) at \((.*?)\)", failure)
    assert len(rows) == 2
    for row, place in rows:
        at = np.load(tmp_path / "scan.npy")[int(row)]
        assert [float(x) for x in place.split(", ")] == pytest.approx(at, abs=1e-5)


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


def test_a_boundary_that_was_found_and_given_back_gives_the_same_mesh(run, parts, tmp_path):
    largest = ["--component", "largest"]
    assert run("boundary", "parts.ply", "-o", "loop.txt", *largest)[0] == 0
    assert run("mesh", "parts.ply", "-o", "found.ply", *largest)[0] == 0
    assert run("mesh", "parts.ply", "-o", "given.ply", *largest, "--boundary", "loop.txt")[0] == 0
    assert (tmp_path / "given.ply").read_bytes() == (tmp_path / "found.ply").read_bytes()


def test_a_boundary_may_name_any_of_the_rows_that_repeat_a_point(run, parts, tmp_path):
    points, rows = parts
    np.save(tmp_path / "scan.npy", np.r_[points, points])
    largest = ["--component", "largest"]
    assert run("boundary", "scan.npy", "-o", "loop.txt", *largest)[0] == 0
    loop = read_loop(tmp_path / "loop.txt")
    assert np.isin(loop, rows).all()
    loop[::3] += 530
    write_loop(tmp_path / "again.txt", loop)
    for name in ("loop", "again"):
        assert run("mesh", "scan.npy", "-o", f"{name}.ply", *largest, "--boundary", f"{name}.txt")[0] == 0
    assert (tmp_path / "again.ply").read_bytes() == (tmp_path / "loop.ply").read_bytes()


def test_boundary_names_every_loop_with_its_size_and_place(run, ring, tmp_path):
    code, _, err = run("boundary", "ring.ply", "-o", "loop.txt")
    assert code == 0
    first, second = err.splitlines()
    assert first == "loop.txt: a loop of 120 points, 6.282 long, 100% of it where the scores speak for a boundary"
    row, place = re.fullmatch(
        r"another loop of 120 points, 5.026 long, 100%, through point (\d+) at \((.*)\)", second
    ).groups()
    assert int(row) in rim_of(ring, 0.8)
    assert [float(x) for x in place.split(", ")] == pytest.approx(ring.points[int(row)], abs=1e-5)


def test_boundary_writes_all_points_their_scores_and_the_loops_as_polylines(run, ring, tmp_path):
    assert run("boundary", "ring.ply", "-o", "loop.txt", "--ply", "loops.ply")[0] == 0
    scan, loop = read_scan(tmp_path / "loops.ply"), read_loop(tmp_path / "loop.txt")
    assert np.array_equal(scan.points, ring.points)
    assert len(scan.triangles) == 0
    assert list(scan.attributes) == ["loop", *SCORES]
    for name in SCORES:
        assert scan.attributes[name].dtype == np.float64
        assert 0 <= scan.attributes[name].min() <= scan.attributes[name].max() <= 1
    number = scan.attributes["loop"]
    assert np.array_equal(np.flatnonzero(number == 1), np.sort(loop))
    assert np.array_equal(np.flatnonzero(number == 2), np.sort(rim_of(ring, 0.8)))
    assert np.count_nonzero(number) == 240
    edges = edges_of(tmp_path / "loops.ply")
    assert np.array_equal(edges[:120], closed(loop))
    assert np.array_equal(edges[120:], closed(edges[120:, 0]))
    assert np.array_equal(np.sort(edges[120:, 0]), np.sort(rim_of(ring, 0.8)))
    inside = np.setdiff1d(np.arange(600), np.concatenate(ring.loops))
    assert scan.attributes["score_total"][number > 0].min() > scan.attributes["score_total"][inside].max()


def test_curves_hold_every_row_of_the_file_and_no_score_where_nothing_was_looked_at(run, parts, tmp_path):
    points, rows = parts
    np.save(tmp_path / "scan.npy", np.r_[points, points])
    words = ["--component", "largest", "--ply", "loops.ply"]
    assert run("boundary", "scan.npy", "-o", "loop.txt", *words)[0] == 0
    scan, loop = read_scan(tmp_path / "loops.ply"), read_loop(tmp_path / "loop.txt")
    assert np.array_equal(scan.points, np.r_[points, points])
    assert np.array_equal(np.flatnonzero(scan.attributes["loop"]), np.sort(loop))
    assert np.array_equal(edges_of(tmp_path / "loops.ply"), closed(loop))
    for name in SCORES:
        score = scan.attributes[name]
        assert np.array_equal(score[530:], score[:530])
        assert not np.delete(score[:530], rows).any()
        assert score[loop].min() > 0


def test_curves_carry_what_the_scan_had_save_what_they_say_anew(run, cap, tmp_path):
    attributes = {name: np.full(500, 7.5, np.float32) for name in ("loop", "score_total", "score_old", "point_index")}
    write_mesh(tmp_path / "scan.ply", cap.points, NO_FACES, attributes=attributes)
    for name in ("cap", "scan"):
        assert run("boundary", f"{name}.ply", "-o", "loop.txt", "--ply", f"{name}-loops.ply")[0] == 0
    fresh, anew = (read_scan(tmp_path / f"{name}-loops.ply").attributes for name in ("cap", "scan"))
    assert set(anew) == {"loop", *SCORES, "score_old", "point_index"}
    for name in ("loop", *SCORES):
        assert anew[name].dtype == fresh[name].dtype
        assert np.array_equal(anew[name], fresh[name])
    for name in ("score_old", "point_index"):
        assert anew[name].dtype == np.float32
        assert (anew[name] == 7.5).all()


def test_curves_are_a_scan_that_is_meshed_with_its_scores(run, cap, tmp_path):
    assert run("boundary", "cap.ply", "-o", "loop.txt", "--ply", "loops.ply")[0] == 0
    assert run("mesh", "loops.ply", "-o", "m.ply", "--boundary", "loop.txt")[0] == 0
    mesh, curves = read_scan(tmp_path / "m.ply"), read_scan(tmp_path / "loops.ply")
    assert set(mesh.attributes) == {"u", "v", "stretch", "red", "intensity", "loop", *SCORES}
    assert np.array_equal(mesh.attributes["score_total"], curves.attributes["score_total"])
    assert run("check", "m.ply", "--points", "cap.ply", "--quiet")[0] == 0


def test_boundary_draws_a_picture(run, ring, tmp_path):
    assert run("boundary", "ring.ply", "-o", "loop.txt", "--picture", "loops.png")[0] == 0
    picture = (tmp_path / "loops.png").read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert (int.from_bytes(picture[16:20]), int.from_bytes(picture[20:24])) == (1650, 814)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["loop.txt", "loops.png", "ring.ply"]


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


def test_check_passes_a_mesh_of_a_mesh_with_repeated_points(run, tmp_path):
    points = shapes.hemisphere(500).points
    np.save(tmp_path / "scan.npy", np.r_[points[[7]], points])
    assert run("mesh", "scan.npy", "-o", "first.ply")[0] == 0
    assert run("mesh", "first.ply", "-o", "second.ply")[0] == 0
    code, _, err = run("check", "second.ply", "--points", "first.ply")
    assert (code, "holds" in err) == (0, False)


@pytest.mark.parametrize(
    "point_index",
    [np.arange(1, 501), np.arange(500) - 1, np.arange(500.0), np.full(500, np.nan)],
    ids=["beyond the end", "before the start", "no whole numbers", "no numbers"],
)
def test_check_refuses_a_mesh_whose_rows_are_none_of_the_scan(run, cap, tmp_path, point_index):
    write_mesh(tmp_path / "m.ply", cap.points, cap.triangles, attributes={"point_index": point_index})
    code, _, err = run("check", "m.ply", "--points", "cap.ply")
    assert code == 1
    assert "m.ply has a point_index that names no point of cap.ply; they do not belong together" in err


def test_check_refuses_a_part_that_is_not_where_the_scan_has_it(run, parts, tmp_path):
    points, _ = parts
    assert run("mesh", "parts.ply", "-o", "m.ply", "--component", "largest")[0] == 0
    np.save(tmp_path / "other.npy", np.roll(points, 1, axis=0))
    code, _, err = run("check", "m.ply", "--points", "other.npy")
    assert code == 1
    assert "500 vertices of m.ply are not where other.npy has them (points 0, 1, 2 and 497 more)" in err


def test_check_refuses_a_disc_where_a_hole_is_due(run, cap, tmp_path):
    write_mesh(tmp_path / "m.ply", cap.points, cap.triangles)
    code, _, err = run("check", "m.ply", "--holes", 1)
    assert code == 1
    assert "its Euler characteristic is 1 instead of 0, it has 1 boundary loops instead of 2" in err


# pointchart demo


def test_demo_writes_scan_mesh_picture_and_page(run, tmp_path):
    code, out, err = run("demo", "-o", "shown")
    assert (code, out) == (0, "")
    assert "a certified disc" in err
    scan, mesh = read_scan(tmp_path / "shown/scan.ply"), read_scan(tmp_path / "shown/mesh.ply")
    assert np.array_equal(scan.points, mesh.points)
    assert certify(mesh.points, mesh.triangles).is_disc
    picture = (tmp_path / "shown/picture.png").read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert len(picture) > 50_000
    written = sorted(path.name for path in (tmp_path / "shown").iterdir())
    assert written == ["mesh.ply", "page.html", "picture.png", "scan.ply"]


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
        *((["mesh", "cap.ply", "-o", "m.ply", "--threads", n], "'--threads': ") for n in ("0", "-1", "many", "1.5")),
        (["param", "cap.ply", "-o", "m.csv", "--threads", "0"], "'--threads': "),
        (["boundary", "cap.ply", "-o", "m.txt", "--threads", "0"], "'--threads': "),
        (["fit", "cap.ply", "-o", "m.json", "--threads", "0"], "'--threads': "),
        (["mash"], "mash"),
        (["demo", "-o", "cap.ply"], "cap.ply is a file; name a folder"),
    ],
)
def test_wrong_usage_exits_with_2_and_writes_nothing(run, cap, tmp_path, words, said):
    code, out, err = run(*words)
    assert (code, out) == (2, "")
    assert said in err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cap.ply"]


@pytest.mark.parametrize(
    ("command", "options"),
    [
        ("mesh", ["--boundary", "--outer", "--holes", "bridge", "open", "--component", "largest", "--threads"]),
        ("param", ["--boundary", "--outer", "--threads"]),
        ("boundary", ["--picture", "--ply", "--outer", "--component", "largest", "--threads"]),
        ("fit", ["--tolerance", "--threads"]),
        ("check", ["--points", "--holes"]),
        ("demo", ["--out"]),
    ],
)
def test_every_command_explains_itself_and_its_options(run, command, options):
    code, out, _ = run(command, "--help")
    assert code == 0
    assert f"pointchart {command}" in out
    assert [option for option in options if option not in out] == []


@pytest.mark.parametrize(
    "words",
    [["mesh", "-o", "m.ply"], ["param", "-o", "m.csv"], ["boundary", "-o", "m.txt"], ["fit", "-o", "m.json"]],
    ids=lambda words: words[0],
)
def test_commands_run_on_the_threads_asked_for(run, cap, monkeypatch, words):
    pools = []

    def counted(n):
        pools.append(n)
        return ThreadPoolExecutor(n)

    monkeypatch.setattr("pointchart._parallel.ThreadPoolExecutor", counted)
    monkeypatch.setattr("pointchart._parallel.LEAST_CHUNK", 50)
    command, *out = words
    assert run(command, "cap.ply", *out, "--threads", 3)[0] == 0
    assert set(pools) == {3}


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


@pytest.mark.parametrize(("stage", "delay"), [("prepare", 0.05), ("boundary", 0.5), ("parameters", 0.1)])
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
