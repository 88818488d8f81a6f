"""Columns, classes and rows that are points, chosen on the command line."""

import json

import numpy as np
import pytest

from pointchart import read_scan, shapes, write_mesh

CAP = shapes.hemisphere(500)


def write_rows(path, *columns, header=""):
    np.savetxt(path, np.column_stack(columns), header=header, comments="", fmt="%.17g")


def test_columns_are_chosen_in_every_command_that_reads_a_scan(run, tmp_path):
    write_rows(tmp_path / "scan.txt", 0.1 * np.arange(500), CAP.points)
    code, _, err = run("mesh", "scan.txt", "-o", "m.ply")
    assert code == 1
    assert "as a time or a counter does, not x; say which columns are x, y, z (--columns)" in err
    for command, out in (("mesh", "m.ply"), ("param", "uv.ply"), ("boundary", "loop.txt")):
        assert run(command, "scan.txt", "-o", out, "--columns", "2,3,4")[0] == 0
    np.testing.assert_array_equal(read_scan(tmp_path / "m.ply").points, CAP.points)


@pytest.mark.parametrize("columns", ["1,2", "1,2,2", "1,,3"])
def test_columns_that_are_not_three_are_refused(run, cap, columns):
    code, _, err = run("mesh", "cap.ply", "-o", "m.ply", "--columns", columns)
    assert code == 2
    assert f"--columns is '{columns}'; three different columns are needed" in err


def test_rows_that_are_no_points_are_named_and_left_out_if_asked_for(run, tmp_path):
    points = np.insert(CAP.points + 5.0, [7, 100], [[0, 0, 0], [np.nan] * 3], axis=0)
    points = np.r_[points, [[0, 0, 0]]]
    np.save(tmp_path / "scan.npy", points)
    code, _, err = run("mesh", "scan.npy", "-o", "m.ply")
    assert code == 1
    assert "there is 1 row without coordinates, the first is row 101" in err
    assert "leave such rows out (--drop-invalid)" in err
    code, _, err = run("mesh", "scan.npy", "-o", "m.ply", "--drop-invalid", "--report", "run.json")
    assert code == 0
    assert "1 row without coordinates left out" in err
    assert "2 rows of exactly 0 0 0 left out" in err
    made = read_scan(tmp_path / "m.ply")
    np.testing.assert_array_equal(made.points, points[made.attributes["point_index"]])
    assert len(made.points) == 500
    assert json.loads((tmp_path / "run.json").read_text())["options"]["drop_invalid"] is True
    assert run("check", "m.ply", "--points", "scan.npy")[0] == 0


def test_classes_are_chosen(run, tmp_path):
    above = CAP.points[:100] + np.array([0, 0, 3.0])
    classes = np.repeat([2, 5], [500, 100]).astype(np.uint8)
    write_mesh(
        tmp_path / "scan.ply", np.r_[CAP.points, above], np.empty((0, 3), int), attributes={"classification": classes}
    )
    code, _, err = run("mesh", "scan.ply", "-o", "m.ply", "--classes", "2")
    assert code == 0
    assert "100 points of other classes left out; the scan holds 2 (500), 5 (100)" in err
    assert len(read_scan(tmp_path / "m.ply").points) == 500
    code, _, err = run("mesh", "scan.ply", "-o", "m.ply", "--classes", "ground")
    assert code == 2
    assert "--classes is 'ground'; whole numbers are needed, such as 2 or 2,6" in err


def test_degrees_are_named_before_anything_is_computed(run, tmp_path):
    lon, lat = np.meshgrid(np.linspace(8.0, 8.1, 30), np.linspace(47.0, 47.1, 30))
    write_rows(
        tmp_path / "scan.xyz", lon.ravel(), lat.ravel(), 400 + 900 * np.sin(20 * lon.ravel()) * (lat.ravel() - 46)
    )
    code, _, err = run("mesh", "scan.xyz", "-o", "m.ply")
    assert code == 1
    assert "x and y span 0.1 and 0.1, z" in err
    assert "as degrees and metres do" in err
    assert "Warning" not in err


def test_what_a_scan_carries_under_names_of_the_result_is_kept(run, tmp_path):
    carried = {"u": np.arange(500.0), "v": -np.arange(500.0), "point_index": np.arange(500, dtype=np.int32)[::-1]}
    write_mesh(tmp_path / "scan.ply", CAP.points, np.empty((0, 3), int), attributes=carried)
    assert run("mesh", "scan.ply", "-o", "m.ply")[0] == 0
    made = read_scan(tmp_path / "m.ply").attributes
    for name, values in carried.items():
        np.testing.assert_array_equal(made[f"scan_{name}"], values)
    assert np.abs(made["u"]).max() <= 1
