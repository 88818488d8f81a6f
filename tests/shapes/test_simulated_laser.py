import numpy as np
import pytest
from measures import edge_lengths, point_normals
from scipy.spatial import cKDTree

from pointchart import shapes
from pointchart.shapes.planar import delaunay


@pytest.fixture(scope="module")
def scan():
    return shapes.demo_scan()


def test_the_scan_has_the_spacings_asked_for():
    def plane(s, t):
        return np.stack([s, t, 0 * s], axis=-1)

    shape = shapes.laser_scan(plane, lines=50, anisotropy=2, jitter=0, unevenness=4, noise=0)
    lines = np.unique(shape.points[:, 1])
    assert np.allclose(np.diff(lines), 1 / 50)
    middle = np.sort(shape.points[shape.points[:, 1] == lines[25], 0])
    steps, places = np.diff(middle), (middle[1:] + middle[:-1]) / 2
    assert np.allclose(steps, 4 ** ((2 * places - 1) ** 2 / 2) / 100, rtol=0.01)


def test_range_noise_lies_along_the_view():
    def plane(s, t):
        return np.stack([s, t, 0 * s], axis=-1)

    options = {"lines": 100, "seed": 5, "view": (0, 3, 4)}
    clean, noisy = (shapes.laser_scan(plane, noise=noise, **options) for noise in (0, 0.1))
    error = noisy.points - clean.points
    assert np.allclose(np.cross(error, [0, 3, 4]), 0, atol=1e-15)
    assert np.linalg.norm(error, axis=1).std() > 0
    assert (error @ [0, 0.6, 0.8]).std() == pytest.approx(0.1 / 100, rel=0.05)


def test_the_sculpture_is_seen_whole_from_nowhere():
    normals = point_normals(shapes.sculpture(4000))
    directions = shapes.sphere(1000).points
    assert (normals @ directions.T).min(axis=0).max() < -0.2


@pytest.mark.parametrize("place", [(0, -0.26), (0.85, 0), (-0.85, 0)], ids=["nose", "left side", "right side"])
def test_the_sculpture_overhangs(place):
    face = shapes.sculpture(20_000)
    near = np.linalg.norm(face.points[:, :2] - place, axis=1) < 0.2
    assert point_normals(face)[near, 2].min() < -0.05


@pytest.mark.parametrize("n", [1000, 5000, 20_000])
def test_the_sculpture_has_about_the_number_of_points_asked_for(n):
    assert len(shapes.sculpture(n).points) == pytest.approx(n, rel=0.05)


def test_the_demo_scan_has_about_twenty_thousand_points(scan):
    assert len(scan.points) == pytest.approx(20_000, rel=0.03)


def test_the_edges_of_the_demo_scan_are_short(scan):
    lengths = edge_lengths(scan) / scan.spacing
    assert lengths.min() > 0.2
    assert np.quantile(lengths, 0.99) < 2
    assert lengths.max() < 5


def test_sheets_of_the_demo_scan_stay_three_spacings_apart(scan):
    normals = point_normals(scan)
    i, j = cKDTree(scan.points).query_pairs(3 * scan.spacing, output_type="ndarray").T
    assert np.sum(normals[i] * normals[j], axis=1).min() > -0.3


def test_the_outline_of_the_demo_scan_is_ragged(scan):
    assert len(scan.triangles) < len(delaunay(scan.uv))
    edge = np.diff(scan.uv[np.r_[scan.boundary, scan.boundary[:1]]], axis=0)
    turn = edge[:, 0] * np.roll(edge[:, 1], -1) - edge[:, 1] * np.roll(edge[:, 0], -1)
    assert 0.2 < np.mean(turn < 0) < 0.6
