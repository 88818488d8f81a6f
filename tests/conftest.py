"""Shapes made once a run, the real scans where they are at hand, and a browser where there is one."""

import os
import shutil
import sys
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import trimesh
from hypothesis import settings
from typer.main import get_command

from pointchart import shapes
from pointchart.cli import app, main

# Compiled kernels make first examples slow; a fixed order makes failures come back.
settings.register_profile("steady", deadline=None, derandomize=True, max_examples=50)
settings.load_profile("steady")

COMMANDS = get_command(app)
SCANS = Path(__file__).parents[2] / "shared" / "data"
DISCS = {
    "disc": lambda: shapes.disc(300, seed=1),
    "relief": lambda: shapes.relief(500, seed=2),
    "hemisphere": lambda: shapes.hemisphere(400),
    "cap of 150 degrees": lambda: shapes.hemisphere(400, angle=150),
    "tube": lambda: shapes.tube(5, n_around=16),
    "rolled sheet": lambda: shapes.bent_sheet(270, nx=25, ny=15),
    "thinned relief": lambda: shapes.thin(shapes.relief(900, seed=3)),
    "face": lambda: shapes.sculpture(1500),
}


# A new browser that draws in software, looks for nothing on the network and runs as root.
CHROMIUM = [
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
]


class Scan(NamedTuple):
    points: np.ndarray
    triangles: np.ndarray
    loop: np.ndarray


@pytest.fixture
def full_disk(monkeypatch):
    """Let every file that is put into its place fail as on a full disk."""

    def fail(*names):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)


@pytest.fixture
def command_line(monkeypatch, capsys):
    """Run the command line in this process; return its exit code, stdout and stderr."""

    # Typer would build its commands anew for every call.
    monkeypatch.setattr("pointchart.cli.app", COMMANDS)

    def call(*words):
        monkeypatch.setattr(sys, "argv", ["pointchart", *map(str, words)])
        with pytest.raises(SystemExit) as left:
            main()
        out, err = capsys.readouterr()
        return left.value.code or 0, out, err

    return call


@pytest.fixture(scope="session")
def disc_shape():
    """Return the simulated disc of a name, made once."""
    return cache(lambda name: DISCS[name]())


@pytest.fixture(params=DISCS)
def any_disc(request, disc_shape):
    """Run a test on every simulated disc."""
    return disc_shape(request.param)


@pytest.fixture(scope="session")
def scan():
    """Return a real scan, its true mesh and its true boundary by name, or skip the test where scans are not at hand."""

    @cache
    def load(name):
        folder = SCANS / name
        if not folder.is_dir():
            pytest.skip(f"the real scan {name} is not in {SCANS}")
        points = trimesh.load(folder / "points.ply", process=False).vertices
        mesh = trimesh.load(folder / "reference.ply", process=False)
        assert np.array_equal(points, mesh.vertices)
        loop = np.loadtxt(folder / "boundary.txt", dtype=np.int64)
        return Scan(np.array(points, dtype=np.float64), np.array(mesh.faces, dtype=np.int64), loop)

    return load


@pytest.fixture(scope="session")
def browser():
    """Return Chromium, driven by Playwright, or skip the test where it is not installed."""
    program = shutil.which("chromium") or shutil.which("google-chrome")
    if program is None:
        pytest.skip("no Chromium on this machine; Debian's is in the package chromium")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=program, args=CHROMIUM)
        yield chromium
        chromium.close()
