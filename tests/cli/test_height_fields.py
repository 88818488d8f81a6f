"""``pointchart mesh --plane``."""

import numpy as np
import pytest

from pointchart import read_scan

FLAT = np.random.default_rng(6).uniform(0.0, 10.0, (400, 2))
HILLS = np.column_stack([FLAT, 2.0 * np.sin(3.0 * FLAT[:, 0]) * np.cos(3.0 * FLAT[:, 1])])


@pytest.mark.parametrize(
    ("plane", "columns"), [("xy", [0, 1, 2]), ("0,0,1", [0, 1, 2]), ("yz", [2, 0, 1]), ("fit", [0, 1, 2])]
)
def test_a_height_field_is_meshed_over_its_plane(run, tmp_path, plane, columns):
    np.save(tmp_path / "scan.npy", HILLS[:, columns])
    code, _, err = run("mesh", "scan.npy", "-o", "m.ply", "--plane", plane)
    assert code == 0
    assert "[ok] uv one-to-one, every triangle exactly positive" in err
    assert run("check", "m.ply", "--points", "scan.npy")[0] == 0
    if plane == "xy":
        made = read_scan(tmp_path / "m.ply")
        assert np.array_equal(made.uv, HILLS[:, :2])


def test_points_at_one_place_are_named_with_the_option(run, tmp_path):
    np.save(tmp_path / "scan.npy", np.r_[HILLS, HILLS[:5] + np.array([0, 0, 1.0])])
    code, _, err = run("mesh", "scan.npy", "-o", "m.ply", "--plane", "xy")
    assert code == 1
    assert "10 points share their places in the plane with others (0, 1, 2 and 7 more)" in err
    assert "keep the highest or the lowest (--keep highest)" in err
    code, _, err = run("mesh", "scan.npy", "-o", "m.ply", "--plane", "xy", "--keep", "lowest")
    assert code == 0
    assert "5 points left out that are not the lowest at a place; point_index gives each vertex's row" in err
    made = read_scan(tmp_path / "m.ply")
    assert np.array_equal(made.attributes["point_index"], np.arange(400))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--plane", "zz"], "--plane is 'zz'; xy, xz, yz, fit or a normal is needed, such as 0,0.1,1"),
        (["--plane", "0,0,0"], "--plane is '0,0,0'"),
        (["--keep", "highest"], "--keep needs --plane"),
        (["--plane", "xy", "--uv", "free"], "--plane and --uv exclude each other"),
        (["--plane", "xy", "--domain", "square"], "--plane and --domain exclude each other"),
        (["--plane", "xy", "--neighbors", "nearest"], "--plane and --neighbors exclude each other"),
        (["--plane", "xy", "--outer", "0,0,0"], "--plane and --outer exclude each other"),
    ],
)
def test_options_that_do_not_go_together_are_named(run, tmp_path, words, message):
    np.save(tmp_path / "scan.npy", HILLS)
    code, _, err = run("mesh", "scan.npy", "-o", "m.ply", *words)
    assert code == 2
    assert message in err
