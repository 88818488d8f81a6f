"""``pointchart boundary``."""

import re

import numpy as np
import pytest
import trimesh

from pointchart import certify, read_loop, read_scan, write_loop, write_mesh

NO_FACES = np.empty((0, 3), np.int64)
SCORES = ["score_total", "score_gap", "score_half_disc", "score_width", "score_uncovered"]


def rim_of(shape, radius):
    """Return the rows of the rim of a ring that has that radius."""
    return min(shape.loops, key=lambda loop: abs(np.linalg.norm(shape.points[loop[0]]) - radius))


def edges_of(path):
    """Return the edges of a PLY file as another library reads them, (m, 2)."""
    table = trimesh.load(path, process=False).metadata["_ply_raw"]["edge"]["data"]
    return np.column_stack([table["vertex1"], table["vertex2"]])


def closed(loop):
    """Return the edges of a closed polyline."""
    return np.column_stack([loop, np.roll(loop, -1)])


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
