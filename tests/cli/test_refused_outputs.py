import os
import re

import numpy as np
import pytest
from scans import RIM, SHEET, texts

from pointchart import shapes


def test_the_output_must_not_be_the_input(attempt, folder, sheet):
    before = (folder / sheet).read_bytes()
    for out in (sheet, folder / sheet, f"./{sheet}"):
        code, err = attempt("mesh", sheet, "-o", out)
        assert code == 1
        assert "the output is also sheet.ply, which would be lost; choose another output" in err
    assert (folder / sheet).read_bytes() == before


def test_the_output_must_not_be_the_boundary_nor_the_report_an_input(attempt, folder, sheet):
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in RIM))
    before = (folder / "loop.txt").read_bytes()
    code, err = attempt("param", sheet, "--boundary", "loop.txt", "-o", "loop.txt")
    assert code == 1
    assert "the output is also loop.txt" in err
    assert (folder / "loop.txt").read_bytes() == before


@pytest.mark.parametrize(
    ("out", "said"),
    [
        ("none/out.ply", "the folder .*none does not exist; create it first"),
        ("sheet.ply/out.ply", "is a file and not a folder"),
        ("out.docx", "the suffix '.docx' cannot be written here; choose one of .ply, .obj, .off, .stl, .glb, .npz"),
        ("out", "the suffix '' cannot be written here; choose one of"),
        ("folder.ply", "this is a folder; name a file in it"),
    ],
)
def test_an_output_that_cannot_be_written_is_refused_before_the_run(attempt, folder, sheet, out, said):
    (folder / "folder.ply").mkdir()
    before = sorted(folder.rglob("*"))
    code, err = attempt("mesh", sheet, "-o", out)
    assert code == 1
    assert re.search(said, err)
    assert sorted(folder.rglob("*")) == before


def test_a_report_that_cannot_be_written_is_refused_before_the_run(attempt, folder, sheet):
    code, err = attempt("mesh", sheet, "-o", "out.ply", "--report", "none/run.json")
    assert code == 1
    assert "does not exist; create it first" in err
    code, err = attempt("mesh", sheet, "-o", "out.ply", "--report", "run.txt")
    assert code == 1
    assert "the suffix '.txt' cannot be written here; choose one of .json" in err
    assert sorted(path.name for path in folder.iterdir()) == [sheet]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--ply", "none/out.ply"], "the folder .*none does not exist; create it first"),
        (["--picture", "none/out.png"], "the folder .*none does not exist; create it first"),
        (["--ply", "out.obj"], r"the suffix '.obj' cannot be written here; choose one of .ply"),
        (["--picture", "out.jpg"], r"the suffix '.jpg' cannot be written here; choose one of .png"),
        (["--ply", "folder.ply"], "this is a folder; name a file in it"),
        (["--ply", "sheet.ply"], "sheet.ply: the output is also sheet.ply, which would be lost"),
        (["--ply", "link.ply"], "link.ply: the output is also sheet.ply, which would be lost"),
        (["--picture", "link.png"], "link.png: the output is also sheet.ply, which would be lost"),
        (["--ply", "twin.ply"], "twin.ply: the output is .*loop.txt, which would be lost"),
        (["--picture", "twin.png"], "twin.png: the output is .*loop.txt, which would be lost"),
    ],
)
def test_a_boundary_run_whose_outputs_cannot_all_be_written_writes_none(attempt, folder, sheet, words, said):
    (folder / "loop.txt").write_text("old")
    (folder / "folder.ply").mkdir()
    for suffix in (".ply", ".png"):
        (folder / f"link{suffix}").symlink_to(folder / sheet)
        (folder / f"twin{suffix}").hardlink_to(folder / "loop.txt")
    before = {path: path.is_file() and path.read_bytes() for path in folder.rglob("*")}
    others = {"--ply": ["--picture", "other.png"], "--picture": ["--ply", "other.ply"]}[words[0]]
    code, err = attempt("boundary", sheet, "-o", "loop.txt", *words, *others)
    assert code == 1
    assert len(err.splitlines()) == 1
    assert re.search(said, err)
    assert {path: path.is_file() and path.read_bytes() for path in folder.rglob("*")} == before


@pytest.mark.parametrize(
    "words",
    [
        ["mesh", "-o", "twin.ply", "--report", "twin.json"],
        ["boundary", "-o", "out.txt", "--ply", "twin.ply", "--picture", "twin.png"],
    ],
)
def test_two_outputs_that_are_one_file_are_refused(attempt, folder, sheet, words):
    (folder / "old").write_text("old")
    for suffix in ("ply", "png", "json"):
        (folder / f"twin.{suffix}").symlink_to(folder / "old")
    command, *options = words
    code, err = attempt(command, sheet, *options, "--quiet")
    assert code == 1
    assert re.search(r"twin\.\w+: the output is .*twin\.\w+, which would be lost", err)
    assert (folder / "old").read_text() == "old"
    assert not (folder / "out.txt").exists()


def test_a_boundary_file_must_not_replace_the_scan(attempt, folder):
    (folder / "scan.txt").write_text(texts(SHEET.points))
    code, err = attempt("boundary", "scan.txt", "-o", "scan.txt", "--ply", "out.ply")
    assert code == 1
    assert "scan.txt: the output is also scan.txt, which would be lost; choose another output" in err
    assert [path.name for path in folder.iterdir()] == ["scan.txt"]


def test_a_surface_without_a_boundary_leaves_no_picture_and_no_curves(refused, folder):
    np.save(folder / "scan.npy", shapes.sphere(400).points)
    (folder / "out.ply").write_text("old")
    words = ["--picture", "out.png", "--ply", "out.ply"]
    assert refused("boundary", "scan.npy", *words, out="out.txt").startswith("no boundary was found: ")
    assert (folder / "out.ply").read_text() == "old"


def test_a_mesh_that_its_format_cannot_hold_leaves_no_report(attempt, folder):
    np.save(folder / "scan.npy", 1e-9 * shapes.disc(300, seed=1).points + [1, 0, 0])
    code, err = attempt("mesh", "scan.npy", "-o", "out.stl", "--report", "run.json", "--quiet")
    assert code == 1
    assert "STL holds single precision, which makes " in err
    assert [path.name for path in folder.iterdir()] == ["scan.npy"]


@pytest.mark.parametrize("out", ["out.stl", "out.GLB"])
def test_a_format_that_cannot_hold_the_scan_is_refused_before_the_run(attempt, folder, out):
    far = 1e-9 * shapes.disc(300, seed=1).points + [1, 0, 0]
    np.save(
        folder / "scan.npy", np.vstack([far, far + np.array([0, 1, 0])])
    )  # in two parts, which the run would refuse
    code, err = attempt("mesh", "scan.npy", "-o", out, "--quiet")
    assert code == 1
    assert "holds single precision, which makes " in err


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="the superuser may write everywhere")
def test_a_folder_without_permission_is_refused_before_the_run(attempt, folder, sheet):
    (folder / "locked").mkdir(mode=0o500)
    code, err = attempt("mesh", sheet, "-o", "locked/out.ply")
    assert code == 1
    assert "there is no permission to write" in err


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="the superuser may write everywhere")
@pytest.mark.parametrize("words", [["--ply", "old.ply"], ["--picture", "old.png"]])
def test_a_boundary_run_with_a_read_only_output_writes_none(attempt, folder, sheet, words):
    (folder / words[1]).write_text("old")
    (folder / words[1]).chmod(0o400)
    code, err = attempt("boundary", sheet, "-o", "loop.txt", *words)
    assert code == 1
    assert f"{words[1]}: the file exists and is read-only; remove it or choose another output" in err
    assert sorted(path.name for path in folder.iterdir()) == [words[1], sheet]


@pytest.mark.parametrize(
    "words",
    [
        ["mesh", "-o", "out.ply", "--report", "run.json"],
        ["check", "--report", "run.json"],
        ["boundary", "-o", "out.txt", "--ply", "out.ply", "--picture", "out.png"],
    ],
)
def test_a_full_disk_or_a_broken_file_ends_in_one_sentence(attempt, folder, sheet, monkeypatch, words):
    def full(*_):
        raise OSError(28, "No space left on device")

    attempt("mesh", sheet, "-o", "mesh.ply", "--quiet")
    monkeypatch.setattr("os.replace", full)
    command, *options = words
    code, err = attempt(command, "mesh.ply", *options, "--quiet")
    assert code == 1
    assert "it cannot be written (No space left on device); free the disk or choose another output" in err
    assert sorted(path.name for path in folder.iterdir()) == ["mesh.ply", sheet]
