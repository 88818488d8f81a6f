"""Scans in an empty folder, and the command line run there, or refusing to."""

import numpy as np
import pytest
from scans import FAR, NO_FACES, SHEET

from pointchart import shapes, write_mesh


@pytest.fixture
def run(command_line, monkeypatch, tmp_path):
    """Run the command line in an empty folder; return its exit code, stdout and stderr."""
    monkeypatch.chdir(tmp_path)
    return command_line


@pytest.fixture
def cap(tmp_path):
    """Write a scan with colour and intensity to cap.ply, and return its shape."""
    shape = shapes.hemisphere(500)
    red, intensity = np.arange(500, dtype=np.uint8), np.linspace(0, 1, 500, dtype=np.float32)
    write_mesh(tmp_path / "cap.ply", shape.points, NO_FACES, attributes={"red": red, "intensity": intensity})
    return shape


@pytest.fixture
def ring(tmp_path):
    """Write a flat ring, its rows shuffled, to ring.ply; return its shape."""
    shape = shapes.shuffle(shapes.annulus(120, 5, inner_radius=0.8), seed=3)
    write_mesh(tmp_path / "ring.ply", shape.points, NO_FACES)
    return shape


@pytest.fixture
def parts(tmp_path):
    """Write a cap and a small sheet, their rows shuffled, to parts.ply; return the points and the rows of the cap."""
    order = np.random.default_rng(5).permutation(530)
    points = np.r_[shapes.hemisphere(500).points, FAR][order]
    attributes = {"id": np.arange(530, dtype=np.uint16), "point_index": np.full(530, -1, np.int32)}
    write_mesh(tmp_path / "parts.ply", points, NO_FACES, attributes=attributes)
    return points, np.flatnonzero(order < 500)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Work in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def attempt(command_line, folder):
    """Run the command line in an empty folder; return its exit code and stderr."""

    def call(*words):
        code, out, err = command_line(*words)
        assert out == ""
        return code, err

    return call


@pytest.fixture
def refused(attempt, folder):
    """Run a command that has to fail with one sentence and leave all files as they are; return the sentence."""

    def call(command, *words, out="out.ply"):
        sentinel = folder / out
        sentinel.write_bytes(b"old")
        before = sorted(folder.rglob("*"))
        code, err = attempt(command, *words, "-o", sentinel, "--quiet")
        assert code == 1
        assert err.startswith("pointchart: ")
        assert len(err.splitlines()) == 1
        assert "Traceback" not in err
        assert sentinel.read_bytes() == b"old"
        assert sorted(folder.rglob("*")) == before
        return err.removeprefix("pointchart: ").strip()

    return call


@pytest.fixture
def misused(attempt, folder):
    """Run a command whose options are wrong usage: exit 2, no file written; return what it says on one line."""

    def call(command, *words, out="out.ply"):
        before = sorted(folder.rglob("*"))
        code, err = attempt(command, *words, "-o", out)
        assert code == 2
        assert sorted(folder.rglob("*")) == before
        return " ".join(err.replace("\u2502", " ").split())

    return call


@pytest.fixture
def sheet(folder):
    """Write a scan of a grid to sheet.ply."""
    write_mesh(folder / "sheet.ply", SHEET.points, NO_FACES)
    return "sheet.ply"
