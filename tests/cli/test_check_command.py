"""``pointchart check``."""

import json
from pathlib import Path

import numpy as np
import pytest

from pointchart import shapes, write_mesh


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
