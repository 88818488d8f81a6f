"""``pointchart check``."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pointchart import PointchartError, certify, shapes, write_mesh


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


def soup_of(shape):
    """Return a mesh whose triangles share no vertices."""
    return shape.points[shape.triangles].reshape(-1, 3), np.arange(shape.triangles.size).reshape(-1, 3)


TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


@pytest.mark.parametrize(
    ("points", "triangles", "lines", "remedy"),
    [
        (
            *soup_of(shapes.hemisphere(30)),
            [f"[!!] one part: there are {len(shapes.hemisphere(30).triangles)}"],
            f"its {3 * len(shapes.hemisphere(30).triangles)} vertices stand at 30 places: merge those that coincide",
        ),
        (
            shapes.sphere(60).points,
            shapes.sphere(60).triangles,
            ["[!!] Euler characteristic 1: it is 2"],
            "it is closed, so it has no boundary to be the one of a disc",
        ),
        (
            shapes.torus(12, 8).points,
            shapes.torus(12, 8).triangles,
            ["[!!] one boundary loop: there are 0"],
            "it is closed, so it has no boundary",
        ),
        (
            np.r_[shapes.hemisphere(30).points, shapes.hemisphere(30).points + 9],
            np.r_[shapes.hemisphere(30).triangles, shapes.hemisphere(30).triangles + 30],
            ["[!!] one part: there are 2"],
            "check its parts one by one",
        ),
        (
            np.r_[np.eye(3), [[0, 0, 0], [1, 1, 1]]],
            np.r_[TETRAHEDRON, [[0, 1, 4]]],
            ["[!!] edges manifold, orientation consistent: 1 edges at fault"],
            "mesh the scan again, or repair it",
        ),
        (
            shapes.annulus(20, 4).points,
            shapes.annulus(20, 4).triangles,
            ["[!!] Euler characteristic 1: it is 0"],
            "say --holes 1",
        ),
    ],
    ids=["soup", "sphere", "torus", "two parts", "non-manifold", "annulus"],
)
def test_check_says_what_a_mesh_is_and_what_applies_to_it(run, tmp_path, points, triangles, lines, remedy):
    write_mesh(tmp_path / "mesh.ply", points, triangles)
    code, _, err = run("check", "mesh.ply")
    assert code == 1
    for line in lines:
        assert line in err
    assert remedy in err
    assert "--holes -" not in err


@given(
    corners=st.lists(st.tuples(*[st.integers(0, 6)] * 3).filter(lambda t: len(set(t)) == 3), min_size=1, max_size=12),
    places=st.lists(st.integers(0, 4), min_size=7, max_size=7),
)
def test_any_triangles_on_any_places_are_certified_or_refused(corners, places):
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 2]])[places]
    try:
        proof = certify(points, corners)
    except PointchartError:
        return
    assert proof.n_triangles == len(corners)
    assert np.isfinite(proof.longest_edge_over_spacing)
