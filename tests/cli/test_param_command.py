"""``pointchart param``."""

import json

import numpy as np
import pytest

from pointchart import read_scan, shapes


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
