"""Scans in an empty folder, and the command line run there."""

import numpy as np
import pytest

from pointchart import shapes, write_mesh

NO_FACES = np.empty((0, 3), np.int64)
FAR = shapes.grid(6, 5).points + np.array([0, 0, 50])


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
