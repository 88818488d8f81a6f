"""``pointchart mesh``."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from pointchart import certify, read_loop, read_scan, shapes, write_loop
from pointchart.boundary import bounded as survey
from pointchart.boundary.find import search_boundary

FAR = shapes.grid(6, 5).points + np.array([0, 0, 50])


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
    assert sorted(mesh.attributes) == ["id", "point_index", "scan_point_index", "stretch", "u", "v"]
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
    monkeypatch.setattr(survey, "search_boundary", lambda *given: search_boundary(*given).beginning_with(1))
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
