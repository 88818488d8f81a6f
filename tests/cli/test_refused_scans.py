import os
import re

import numpy as np
import pytest
from scans import FAR, SHEET, SQUARE, texts

from pointchart import shapes


def with_values(points, *places):
    """Return a copy of the points with some coordinates replaced: (row, axis, value)."""
    changed = points.copy()
    for row, axis, value in places:
        changed[row, axis] = value
    return changed


def places_named(sentence):
    """Return each point that a sentence names together with its place: (row, [x, y, z])."""
    return [
        (int(row), [float(x) for x in place.split(", ")])
        for row, place in re.findall(r"point (\d+) at \(([^)]*)\)", sentence)
    ]


@pytest.mark.parametrize("suffix", ["ply", "obj", "off", "stl", "glb", "xyz", "txt", "csv", "pts", "npy", "npz", "las"])
def test_an_empty_file_is_refused_by_its_name(refused, folder, suffix):
    (folder / f"scan.{suffix}").write_bytes(b"")
    assert refused("mesh", f"scan.{suffix}").startswith(f"scan.{suffix}: ")


@pytest.mark.parametrize("suffix", ["ply", "off", "stl", "glb", "npy", "npz", "las"])
def test_a_file_of_rubbish_is_refused_by_its_name(refused, folder, suffix):
    (folder / f"scan.{suffix}").write_bytes(bytes(range(256)) * 3)
    assert refused("mesh", f"scan.{suffix}").startswith(f"scan.{suffix}: ")


def test_a_missing_file_is_refused(refused):
    assert refused("mesh", "none.ply") == "none.ply: there is no such file; check the name and the folder"


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="the superuser may read everything")
def test_an_unreadable_file_is_refused(refused, folder, sheet):
    (folder / sheet).chmod(0)
    assert refused("mesh", sheet).startswith("sheet.ply: ")


def test_an_unknown_suffix_is_refused_with_those_known(refused, folder):
    (folder / "scan.docx").write_text("points")
    assert refused("mesh", "scan.docx").startswith(
        "scan.docx: the suffix '.docx' is none of the 26 that can be read: .ply, "
    )


@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize("command", ["mesh", "param", "boundary"])
def test_fewer_than_four_points_are_refused(refused, folder, command, n):
    (folder / "scan.xyz").write_text(texts(SQUARE[:n]))
    out = {"mesh": "out.ply", "param": "out.csv", "boundary": "out.txt"}[command]
    said = refused(command, "scan.xyz", out=out)
    assert said == f"the scan has {n} points; a surface patch needs at least 4"


@pytest.mark.parametrize("words", [[], ["--component", "largest"]], ids=["whole", "largest"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_broken_coordinates_are_counted_and_the_first_is_named(refused, folder, value, words):
    np.save(folder / "scan.npy", with_values(SHEET.points, (17, 0, value), (40, 2, value), (40, 1, value)))
    said = refused("mesh", "scan.npy", *words)
    assert said == (
        "there are 2 rows without coordinates, the first is row 17, as where nothing was measured; leave such rows out "
        "(--drop-invalid)"
    )


@pytest.mark.parametrize("direction", [(1, 0, 0), (1, 2, -3)])
def test_points_on_a_line_are_refused(refused, folder, direction):
    np.save(folder / "scan.npy", np.outer(np.arange(20.0), direction) + 5)
    assert refused("mesh", "scan.npy").startswith("all 20 points lie on one line, which bounds no surface")


def test_points_that_are_all_the_same_are_refused(refused, folder):
    np.save(folder / "scan.npy", np.full((20, 3), 5.4e6))
    assert refused("mesh", "scan.npy").startswith("all 20 points are the same")


def test_three_points_that_repeat_are_too_few(refused, folder):
    np.save(folder / "scan.npy", SQUARE[[0, 1, 2, 0, 1, 2]])
    assert refused("mesh", "scan.npy").startswith("the scan has 3 ")


def test_repeated_points_are_merged_and_said(attempt, folder):
    np.save(folder / "scan.npy", np.r_[SHEET.points, SHEET.points[[4, 30, 4]]])
    code, err = attempt("mesh", "scan.npy", "-o", "out.ply")
    assert code == 0
    assert "3 repeated points merged to the first; point_index gives each vertex's row" in err


def test_coordinates_in_millimetres_far_from_the_origin_are_no_trouble(attempt, folder):
    np.save(folder / "scan.npy", 1000 * SHEET.points + np.array([5e8, 5.4e9, 1e5]))
    assert attempt("mesh", "scan.npy", "-o", "out.ply", "--quiet") == (0, "")


def test_two_parts_are_refused_with_their_sizes_and_a_point_of_each(refused, folder):
    np.save(folder / "scan.npy", np.r_[shapes.grid(6, 5).points + np.array([0, 0, 50]), SHEET.points])
    said = refused("mesh", "scan.npy")
    assert said.startswith("the points fall into 2 separate parts, of 108 and 30 points")
    assert said.endswith("in one piece; take the largest (--component largest), or take them one by one")
    in_large, in_small = map(int, re.search(r"\(some of them: (\d+), (\d+)\)", said).groups())
    assert in_small < 30 <= in_large < 138


@pytest.mark.parametrize("closed", [shapes.sphere(500), shapes.torus(48, 20)], ids=["sphere", "torus"])
@pytest.mark.parametrize("command", ["mesh", "param", "boundary"])
def test_a_closed_surface_is_refused(refused, folder, closed, command):
    np.save(folder / "scan.npy", closed.points)
    out = {"mesh": "out.ply", "param": "out.csv", "boundary": "out.txt"}[command]
    said = refused(command, "scan.npy", out=out)
    assert said.startswith("no boundary was found: ")
    assert said.endswith("lie on a closed surface; give the boundary, or cut the scan open")


@pytest.mark.parametrize("words", [[], ["--component", "largest"]], ids=["alone", "largest of two parts"])
def test_an_annulus_is_refused_with_both_loops_and_four_remedies(refused, folder, words):
    ring = shapes.shuffle(shapes.annulus(), seed=2)
    points = ring.points if not words else np.r_[FAR, ring.points]
    np.save(folder / "scan.npy", points)
    said = refused("mesh", "scan.npy", *words)
    assert said.startswith(
        "the surface has a second boundary, so it is no disc: besides the loop of 96 points, 6.282 long, through point "
    )
    assert said.endswith(
        "; bridge it (--holes bridge), leave it open (--holes open), say which is the outer one (--outer x,y,z), "
        "or give the boundary (--boundary)"
    )
    (here, _), (there, _) = named = places_named(said)
    assert [np.linalg.norm(points[row]) for row in (here, there)] == pytest.approx([1, 0.5])
    for row, place in named:
        assert place == pytest.approx(points[row], abs=1e-5)
    assert float(re.search(r"there is one of 96 points, ([0-9.]+) long", said)[1]) == pytest.approx(np.pi, rel=0.01)


def test_a_moebius_strip_is_refused(refused, folder):
    np.save(folder / "scan.npy", shapes.moebius(64, 7).points)
    assert "no disc" in refused("mesh", "scan.npy")
