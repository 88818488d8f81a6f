"""Pictures: what can be measured on their pixels."""

import numpy as np
import pytest
from matplotlib import colors, image
from matplotlib import pyplot as plt

from pointchart import FormatError, shapes
from pointchart.look.paint import ACCENT, INK
from pointchart.look.run_pictures import draw_boundary, draw_run

SHEET = shapes.grid(24, 9)
MARKED = np.isin(np.arange(len(SHEET.points)), SHEET.boundary).astype(float)
BOUNDARY_SIZE = (814, 1650)


def turned(points, about, angle):
    """Turn points about an axis, in degrees."""
    axis, radians = np.array(about) / np.linalg.norm(about), np.deg2rad(angle)
    along = np.outer(points @ axis, axis)
    return along + np.cos(radians) * (points - along) + np.sin(radians) * np.cross(axis, points)


def drawn(path, points=SHEET.points, scores=MARKED, loops=(SHEET.boundary,)):
    """Draw a boundary and return its pixels, (height, width, 3) between 0 and 1."""
    draw_boundary(path, points, scores, loops)
    return image.imread(path)[:, :, :3]


def pixels_of(picture, color, *, within=0.02, side="left"):
    """Return the row and column of each pixel of a colour in one of the panels, the scale of the scores left out."""
    middle = picture.shape[1] // 2 - 60
    panel = picture[:, :middle] if side == "left" else picture[:, middle:-120]
    return np.argwhere(np.abs(panel - colors.to_rgb(color)).max(axis=2) <= within)


@pytest.mark.parametrize(
    ("points", "scores", "loop"),
    [
        (1e-9 * SHEET.points + [0, 0, 1e-6], np.zeros(216), SHEET.boundary),
        (SHEET.points + np.array([5e5, 5.4e6, 0]), np.ones(216), SHEET.boundary),
        (SHEET.points, MARKED, SHEET.boundary[[0, 30, 50]]),
        (shapes.hemisphere(400).points, np.linspace(0, 1, 400), shapes.hemisphere(400).boundary),
    ],
    ids=["tiny", "far", "triangle", "curved"],
)
def test_every_boundary_is_drawn_at_the_same_size(tmp_path, points, scores, loop):
    picture = drawn(tmp_path / "loops.png", points, scores, [loop])
    assert picture.shape == (*BOUNDARY_SIZE, 3)
    assert len(pixels_of(picture, ACCENT)) > 500


def test_the_picture_does_not_depend_on_the_unit(tmp_path):
    cap = shapes.hemisphere(400)
    scores = np.linspace(0, 1, 400)
    in_metres, in_bits = (
        drawn(tmp_path / f"{unit}.png", unit * cap.points, scores, [cap.boundary]) for unit in (1, 1024)
    )
    assert np.array_equal(in_metres, in_bits)


@pytest.mark.parametrize("unit", [1, 1e-3])
def test_a_flat_scan_is_as_long_from_the_side_as_from_above(tmp_path, unit):
    picture = drawn(tmp_path / "loops.png", unit * SHEET.points)
    from_above, from_side = (np.ptp(pixels_of(picture, ACCENT, side=side)[:, 1]) for side in ("left", "right"))
    assert from_side == pytest.approx(from_above, rel=0.06)


@pytest.mark.parametrize(("about", "angle"), [((0, 0, 1), 0), ((1, 2, 0), 90), ((1, 1, 1), 140)])
def test_the_boundary_is_seen_broad_on_and_lengthwise_however_the_scan_lies(tmp_path, about, angle):
    picture = drawn(tmp_path / "loops.png", turned(SHEET.points, about, angle))
    height, width = np.ptp(pixels_of(picture, ACCENT), axis=0)
    # The dot at the start stands out by 4 points, 6 pixels.
    assert width / height == pytest.approx(23 / 8, rel=0.06)


def test_other_loops_are_drawn_in_ink(tmp_path):
    nothing = np.zeros(len(SHEET.points))
    gap = np.array([3 * 24 + x for x in range(5, 18)] + [5 * 24 + x for x in range(17, 4, -1)])
    alone = drawn(tmp_path / "a.png", scores=nothing)
    with_gap = drawn(tmp_path / "b.png", scores=nothing, loops=[SHEET.boundary, gap])
    assert len(pixels_of(with_gap, INK, within=0.2)) > len(pixels_of(alone, INK, within=0.2)) + 300
    assert np.ptp(pixels_of(with_gap, ACCENT), axis=0) == pytest.approx(np.ptp(pixels_of(alone, ACCENT), axis=0), abs=1)


def test_a_run_is_drawn_as_three_panels_of_one_size(tmp_path):
    draw_run(tmp_path / "run.png", SHEET.points, SHEET.triangles, SHEET.uv, SHEET.boundary)
    assert image.imread(tmp_path / "run.png").shape[:2] == (594, 1650)


@pytest.mark.parametrize(("suffix", "begins"), [(".svg", "<?xml"), (".pdf", "%PDF")])
def test_pictures_are_drawn_as_lines_too_with_the_same_bytes_twice(tmp_path, suffix, begins):
    paths = [tmp_path / f"{name}{suffix}" for name in "ab"]
    for path in paths:
        draw_boundary(path, SHEET.points, MARKED, [SHEET.boundary])
    held, again = (path.read_bytes() for path in paths)
    assert held.startswith(begins.encode())
    assert held == again
    assert suffix == ".pdf" or f"the boundary: {len(SHEET.boundary)} points</text>".encode() in held


def test_no_figure_stays_open(tmp_path):
    drawn(tmp_path / "loops.png")
    assert plt.get_fignums() == []


def test_a_picture_into_a_missing_folder_is_one_sentence(tmp_path):
    with pytest.raises(FormatError, match=r"the folder .*none does not exist; create it first"):
        draw_boundary(tmp_path / "none" / "loops.png", SHEET.points, MARKED, [SHEET.boundary])
    plt.close("all")


def test_a_failed_picture_leaves_the_old_file_and_nothing_else(tmp_path, full_disk):
    path = tmp_path / "loops.png"
    path.write_text("old")
    with pytest.raises(FormatError, match=r"cannot be written \(No space left on device\); free the disk"):
        draw_boundary(path, SHEET.points, MARKED, [SHEET.boundary])
    plt.close("all")
    assert [entry.name for entry in tmp_path.iterdir()] == ["loops.png"]
    assert path.read_text() == "old"
