"""Pictures of surfaces: what can be measured on their pixels."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib import colors, image
from matplotlib import pyplot as plt

from pointchart import FormatError, InputError
from pointchart.look.paint import INK, PAPER
from pointchart.look.surface_pictures import draw_deviation, draw_reflections
from pointchart.surface import BSplineSurface, Deviation, evaluate

SIZE = (814, 1650)
UNIT = np.array([0.0, 0, 1, 1])
FLAT = BSplineSurface(1, UNIT, UNIT, np.array([[[0.0, 0, 0], [0, 2, 0]], [[3, 0, 0], [3, 2, 0]]]))
ARCH = BSplineSurface(
    2,
    np.array([0.0, 0, 0, 1, 1, 1]),
    np.array([0.0, 0, 0, 1, 1, 1]),
    np.array([[[x, y, 1.5 * (x == 1)] for y in (0.0, 0.75, 1.5)] for x in (0.0, 1, 2)]),
)
BOX = [np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])]
FEET = np.random.default_rng(0).random((400, 2))


@pytest.fixture
def coarse(monkeypatch):
    """Sample fewer pixels than are printed."""
    monkeypatch.setattr("pointchart.look.surface_pictures.PIXELS", 60_000)
    monkeypatch.setattr("pointchart.look.surface_raster.GRID", 1000)


def deviation_drawn(path, signed, surface=FLAT, **options):
    """Draw a deviation and return the pixels of the panel of the surface and of the other panels."""
    draw_deviation(path, surface, BOX, evaluate(surface, FEET), Deviation(signed), 0.1, unit="mm", **options)
    picture = image.imread(path)[:, :, :3]
    assert picture.shape == (*SIZE, 3)
    return picture[50:700, :1050], picture[:, 1080:]


def reflections_drawn(path, surface):
    """Draw reflections and return the pixels of the lines, and of the two maps."""
    draw_reflections(path, surface, BOX, unit="mm")
    picture = image.imread(path)[:, :, :3]
    assert picture.shape == (*SIZE, 3)
    return picture[70:780, :980], picture[30:330, 1090:1560]


def inner(picture):
    """Return the colours of the pixels that are not paper, nor mixed with it at a rim, (k, 3)."""
    is_paper = np.abs(picture - colors.to_rgb(PAPER)).max(axis=2) < 0.01
    near = is_paper.copy()
    for shift in (-8, 8):
        near |= np.roll(is_paper, shift, axis=0) | np.roll(is_paper, shift, axis=1)
    return picture[~near]


@pytest.mark.usefixtures("coarse")
def test_a_plane_shows_no_lines_and_an_arch_shows_ink_and_paper(tmp_path):
    tilted = replace(FLAT, control=FLAT.control @ np.linalg.qr(np.arange(9.0).reshape(3, 3) ** 2)[0] + 7)
    lines, maps = reflections_drawn(tmp_path / "plane.png", tilted)
    for panel in (lines, maps):
        assert np.ptp(np.percentile(inner(panel), [1, 99], axis=0), axis=0).max() < 0.02
    lines, _ = reflections_drawn(tmp_path / "arch.png", ARCH)
    share = np.mean(np.abs(inner(lines) - colors.to_rgb(INK)).max(axis=1) < 0.1)
    assert 0.25 < share < 0.6


@pytest.mark.usefixtures("coarse")
def test_deviation_above_is_warm_and_below_is_cold(tmp_path):
    warm, cold = (inner(deviation_drawn(tmp_path / "d.png", np.full(400, h))[0]).mean(axis=0) for h in (0.1, -0.1))
    assert warm[0] > 2 * warm[2]
    assert cold[2] > 2 * cold[0]


@pytest.mark.usefixtures("coarse")
def test_colours_do_not_depend_on_the_unit(tmp_path):
    signed = 0.05 * np.random.default_rng(1).standard_normal(400)
    view, _ = deviation_drawn(tmp_path / "one.png", signed)
    large = replace(FLAT, control=1024 * FLAT.control)
    draw_deviation(
        tmp_path / "large.png", large, BOX, evaluate(large, FEET), Deviation(1024 * signed), 1024 * 0.1, unit="mm"
    )
    assert np.allclose(image.imread(tmp_path / "large.png")[50:700, :1050, :3], view, atol=0.01)


@pytest.mark.usefixtures("coarse")
def test_places_without_a_scan_are_stone(tmp_path):
    half = FEET * [0.5, 1.0]
    draw_deviation(tmp_path / "half.png", FLAT, BOX, evaluate(FLAT, half), Deviation(np.full(400, 0.1)), 0.1, unit="mm")
    pixels = inner(image.imread(tmp_path / "half.png")[50:700, :1050, :3])
    is_red = pixels[:, 0] > 2 * pixels[:, 2]
    assert 0.5 < is_red.mean() < 0.75


@pytest.mark.usefixtures("coarse")
def test_a_share_of_outliers_is_one_more_figure(tmp_path):
    signed = np.linspace(-0.1, 0.1, 400)
    _, without = deviation_drawn(tmp_path / "all.png", signed)
    _, figures = deviation_drawn(tmp_path / "but.png", signed, outliers=0.01)
    assert not np.array_equal(without[400:], figures[400:])


@pytest.mark.usefixtures("coarse")
def test_a_singular_side_is_drawn_without_warnings(tmp_path):
    flat_half = replace(ARCH, control=ARCH.control * (np.arange(3) > 0)[:, None, None])
    lines, maps = reflections_drawn(tmp_path / "pointed.png", flat_half)
    assert len(inner(lines)) > 0 < len(inner(maps))


@pytest.mark.usefixtures("coarse")
def test_the_unit_is_part_of_the_labels(tmp_path):
    views = []
    for unit in ("mm", "in"):
        draw_deviation(tmp_path / "u.png", FLAT, BOX, evaluate(FLAT, FEET), Deviation(np.zeros(400)), 0.1, unit=unit)
        views.append(image.imread(tmp_path / "u.png"))
    assert np.array_equal(views[0][50:650, :1050], views[1][50:650, :1050])
    assert not np.array_equal(views[0][:, 1080:], views[1][:, 1080:])


@pytest.mark.usefixtures("coarse")
def test_a_surface_fills_its_panel_and_no_figure_stays_open(tmp_path):
    view, _ = deviation_drawn(tmp_path / "arch.png", np.zeros(400), ARCH)
    assert len(inner(view)) > 200_000
    assert plt.get_fignums() == []


@pytest.mark.parametrize("tolerance", [0.0, -1.0, np.inf, np.nan])
def test_a_tolerance_that_is_no_length_is_refused(tmp_path, tolerance):
    with pytest.raises(InputError, match=r"the tolerance is .*; give a length more than 0, in mm"):
        draw_deviation(
            tmp_path / "a.png", FLAT, BOX, evaluate(FLAT, FEET), Deviation(np.zeros(400)), tolerance, unit="mm"
        )


def test_points_without_deviations_are_counted(tmp_path):
    with pytest.raises(InputError, match="400 points have 399 deviations; measure them on these points"):
        draw_deviation(tmp_path / "a.png", FLAT, BOX, evaluate(FLAT, FEET), Deviation(np.zeros(399)), 0.1, unit="mm")


@pytest.mark.usefixtures("coarse", "full_disk")
def test_a_failed_picture_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "surface.png"
    path.write_text("old")
    with pytest.raises(FormatError, match=r"cannot be written \(No space left on device\); free the disk"):
        draw_reflections(path, ARCH, BOX, unit="mm")
    with pytest.raises(FormatError, match=r"cannot be written \(No space left on device\); free the disk"):
        deviation_drawn(path, np.zeros(400))
    assert [entry.name for entry in tmp_path.iterdir()] == ["surface.png"]
    assert path.read_text() == "old"
