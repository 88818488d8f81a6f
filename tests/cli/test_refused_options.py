import re

import numpy as np
import pytest
from scans import FAR, NO_FACES, RIM, SHEET

from pointchart import shapes, write_mesh


def test_a_radius_that_leaves_points_alone_is_refused_with_one_that_does_not(refused, folder, sheet):
    said = refused("mesh", sheet, "--neighbors", "ball", "--radius", 0.5, "--weights", "uniform")
    assert said.startswith("the radius leaves points ")
    assert said.endswith("the loneliest has its nearest at 1: use a larger radius, or the nearest k")


@pytest.mark.parametrize("radius", [0, -1, "nan", "inf"])
def test_a_radius_that_is_not_positive_is_wrong_usage(misused, sheet, radius):
    said = misused("mesh", sheet, "--neighbors", "ball", "--radius", radius, "--weights", "uniform")
    assert "it has to be positive and finite" in said


def test_too_few_neighbours_leave_points_without_a_path(refused, folder):
    write_mesh(folder / "scan.ply", shapes.relief(300, seed=2).points, NO_FACES)
    said = refused("mesh", "scan.ply", "--neighbors", "nearest", "-k", 2, "--weights", "uniform")
    assert "have no path to the boundary, so their position is undetermined; use a larger neighbourhood" in said


def test_points_without_a_path_are_named_by_the_rows_of_the_file_whatever_is_left_out(refused, folder):
    shape = shapes.relief(300, seed=2)
    np.save(folder / "scan.npy", np.r_[FAR, shape.points])
    options = ["--neighbors", "nearest", "-k", 2, "--weights", "uniform"]
    said = refused("mesh", "scan.npy", "--component", "largest", *options)
    named = np.array([int(row) for row in re.findall(r"\b\d+\b", said.split(" and ")[0])])
    inner = np.setdiff1d(np.arange(300), shape.boundary) + len(FAR)
    assert said.startswith("interior points ")
    assert len(named) == 3
    assert np.isin(named, inner).all()
    np.save(folder / "scan.npy", shape.points)
    assert refused("mesh", "scan.npy", *options).startswith(f"interior points {', '.join(map(str, named - len(FAR)))}")


def test_points_that_hang_on_one_point_are_named(refused, folder):
    shape = shapes.disc(400, seed=1)
    tuft = shape.points[40] + [[0, 0, 0.01], [0.002, 0, 0.02], [0, 0.002, 0.03], [0.002, 0, 0.035]]
    np.save(folder / "scan.npy", np.r_[shape.points, tuft])
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in shape.boundary))
    words = ["--boundary", "loop.txt", "--neighbors", "nearest", "-k", 4, "--weights", "uniform"]
    said = refused("mesh", "scan.npy", *words)
    assert "reach the boundary only through point 40, into which they would collapse" in said or "have no path" in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--neighbors", "ball"], "--neighbors ball needs --radius and no -k"),
        (["--neighbors", "ball", "--radius", "3", "-k", "5"], "--neighbors ball needs --radius and no -k"),
        (["--neighbors", "nearest", "--radius", "3"], "takes -k and no --radius; for a ball say --neighbors ball"),
        (["--radius", "3", "-k", "5"], "-k and --radius exclude each other"),
        (["--corners", "0,1,2,3"], "--corners needs --domain square"),
        (["--domain", "square", "--corners", "0,1,2"], "--corners is '0,1,2'; four boundary points are needed"),
        (["--domain", "square", "--corners", "a,b,c,d"], "--corners is 'a,b,c,d'; four boundary points are needed"),
        (["--holes", "closed"], "--holes"),
        (["--component", "2"], "--component"),
    ],
)
def test_options_that_do_not_fit_are_wrong_usage(misused, sheet, words, said):
    assert said in misused("mesh", sheet, *words)


@pytest.mark.parametrize("place", ["", "1,2", "1,2,3,4", "1;2;3", "x,y,z", "1,,3", "0.5,-12,3.25m"])
@pytest.mark.parametrize("command", ["mesh", "param", "boundary"])
def test_a_place_that_is_not_three_numbers_is_wrong_usage(misused, sheet, command, place):
    out = {"mesh": "out.ply", "param": "out.csv", "boundary": "out.txt"}[command]
    said = misused(command, sheet, "--outer", place, out=out)
    assert f"--outer is '{place}'; a place is needed, such as 0.5,-12,3.25" in said


@pytest.mark.parametrize("place", ["nan,0,0", "0,inf,0", "0,0,-inf"])
def test_a_place_that_is_not_finite_is_refused(misused, sheet, place):
    said = misused("mesh", sheet, "--outer", place, out="out.ply")
    assert f"--outer is '{place}'; a place is needed" in said


@pytest.mark.parametrize("command", ["mesh", "param"])
def test_a_boundary_and_a_place_of_it_exclude_each_other(misused, folder, sheet, command):
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in RIM))
    out = {"mesh": "out.ply", "param": "out.csv"}[command]
    said = misused(command, sheet, "--boundary", "loop.txt", "--outer", "0,0,0", out=out)
    assert "--boundary and --outer exclude each other" in said


@pytest.mark.parametrize("command", ["mesh", "param"])
@pytest.mark.parametrize("repeated", [0, 20], ids=["as it is", "with repeated points"])
def test_corners_off_the_boundary_are_refused(refused, folder, command, repeated):
    np.save(folder / "scan.npy", np.r_[np.repeat(SHEET.points[[40]], repeated, axis=0), SHEET.points])
    corners = ",".join(str(i + repeated) for i in (0, 11, 107, 94))
    out = {"mesh": "out.ply", "param": "out.csv"}[command]
    said = refused(command, "scan.npy", "--domain", "square", "--corners", corners, out=out)
    assert said == f"corners {94 + repeated} are not on the boundary; choose boundary points"


def test_corners_off_the_boundary_are_named_by_the_rows_of_the_file_whatever_is_left_out(refused, folder):
    np.save(folder / "scan.npy", np.r_[FAR, SHEET.points])
    words = ["--component", "largest", "--domain", "square", "--corners", "30,41,137,70"]
    assert refused("mesh", "scan.npy", *words) == "corners 70 are not on the boundary; choose boundary points"


@pytest.mark.parametrize("holes", [-1, "one", 0.5])
def test_a_number_of_holes_that_is_none_is_wrong_usage(attempt, sheet, holes):
    code, err = attempt("check", sheet, "--holes", holes)
    assert code == 2
    assert "--holes" in err


def test_a_report_never_replaces_what_is_checked(attempt, folder, sheet):
    attempt("mesh", sheet, "-o", "mesh.ply", "--quiet")
    for report in ("mesh.ply", sheet):
        before = (folder / report).read_bytes()
        code, err = attempt("check", "mesh.ply", "--points", sheet, "--report", report)
        assert code == 1
        assert "the suffix '.ply' cannot be written here; choose one of .json" in err
        assert (folder / report).read_bytes() == before


def test_a_demo_in_an_impossible_folder_is_refused(attempt, sheet):
    code, err = attempt("demo", "-o", f"{sheet}/inside")
    assert code == 1
    assert "the folder cannot be made" in err
