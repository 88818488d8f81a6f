"""The command line in an empty folder, and how it refuses."""

import pytest
from scans import NO_FACES, SHEET

from pointchart import write_mesh


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Work in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def run(command_line, folder):
    """Run the command line in an empty folder; return its exit code and stderr."""

    def call(*words):
        code, out, err = command_line(*words)
        assert out == ""
        return code, err

    return call


@pytest.fixture
def refused(run, folder):
    """Run a command that has to fail with one sentence and leave all files as they are; return the sentence."""

    def call(command, *words, out="out.ply"):
        sentinel = folder / out
        sentinel.write_bytes(b"old")
        before = sorted(folder.rglob("*"))
        code, err = run(command, *words, "-o", sentinel, "--quiet")
        assert code == 1
        assert err.startswith("pointchart: ")
        assert len(err.splitlines()) == 1
        assert "Traceback" not in err
        assert sentinel.read_bytes() == b"old"
        assert sorted(folder.rglob("*")) == before
        return err.removeprefix("pointchart: ").strip()

    return call


@pytest.fixture
def misused(run, folder):
    """Run a command whose options are wrong usage: exit 2, no file written; return what it says on one line."""

    def call(command, *words, out="out.ply"):
        before = sorted(folder.rglob("*"))
        code, err = run(command, *words, "-o", out)
        assert code == 2
        assert sorted(folder.rglob("*")) == before
        return " ".join(err.replace("\u2502", " ").split())

    return call


@pytest.fixture
def sheet(folder):
    """Write a scan of a grid to sheet.ply."""
    write_mesh(folder / "sheet.ply", SHEET.points, NO_FACES)
    return "sheet.ply"
