"""Figures: what can be measured in their files."""

import re
import xml.etree.ElementTree as ET
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest
from matplotlib import colors, image
from matplotlib import pyplot as plt

from pointchart import FormatError, InputError, shapes
from pointchart.look.figures import Sheet, draw_cloud, draw_deviation_map, draw_mesh, draw_plane, draw_zebra
from pointchart.look.paint import ACCENT, INK
from pointchart.surface import BSplineSurface, evaluate

DISC = shapes.disc(400, seed=1)
CAP = shapes.hemisphere(400)
UNIT = np.array([0.0, 0, 1, 1])
FLAT = BSplineSurface(1, UNIT, UNIT, np.array([[[0.0, 0, 0], [0, 2, 0]], [[3, 0, 0], [3, 2, 0]]]))
ARCH = BSplineSurface(
    2,
    np.repeat([0.0, 1.0], 3),
    np.repeat([0.0, 1.0], 3),
    np.array([[[x, y, 1.5 * (x == 1)] for y in (0.0, 0.75, 1.5)] for x in (0.0, 1, 2)]),
)
BOX = [np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])]
FEET = np.random.default_rng(0).random((900, 2))
ABOVE = {"view": (0, 90), "up": "z"}
SMALL = Sheet(50.0, 120.0)
PIXEL = 25.4 / 120.0  # mm
SCORES = np.linspace(1.0, 2.0, 400)
KINDS = {
    "cloud": partial(draw_cloud, points=CAP.points, values=SCORES, label="score", **ABOVE),
    "plane": partial(draw_plane, uv=DISC.uv, triangles=DISC.triangles, values=SCORES, label="score"),
    "mesh": partial(draw_mesh, points=CAP.points, triangles=CAP.triangles, values=SCORES, label="score", **ABOVE),
    "deviation": partial(draw_deviation_map, surface=ARCH, loops=BOX, points=evaluate(ARCH, FEET), limit=0.1),
    "zebra": partial(draw_zebra, surface=ARCH, loops=BOX),
}
LABELS = {"cloud": "score", "plane": "score", "mesh": "score", "deviation": "deviation in mm"}


@pytest.fixture(autouse=True, scope="module")
def coarse():
    """Look at surfaces through fewer points, on fewer pixels."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("pointchart.look.surface_raster.GRID", 300)
        patch.setattr("pointchart.look.figures.sheet.MOST_PIXELS", 60_000)
        yield
    assert plt.get_fignums() == []


@pytest.fixture(scope="module")
def figure(tmp_path_factory):
    """Return the figure of a kind in a file of a suffix, drawn once."""
    folder = tmp_path_factory.mktemp("figures")

    @cache
    def once(kind, suffix):
        KINDS[kind](folder / f"{kind}{suffix}", sheet=SMALL)
        return folder / f"{kind}{suffix}"

    return once


@pytest.fixture(params=KINDS)
def kind(request):
    return request.param


def pixels(path):
    return image.imread(path)[:, :, :3]


def drawn(draw, path, *words, sheet=SMALL, **options):
    draw(path, *words, sheet=sheet, **options)
    return pixels(path)


def texts(root):
    return {"".join(text.itertext()) for text in root.iter("{http://www.w3.org/2000/svg}text")}


def near(picture, color, within=0.02):
    return np.abs(picture - colors.to_rgb(color)).max(axis=2) <= within


def test_a_png_has_the_pixels_of_its_width(tmp_path, figure, kind):
    assert image.imread(figure(kind, ".png")).shape[1] == round(50.0 / PIXEL)
    KINDS[kind](tmp_path / "a.png", sheet=Sheet(25.0, 254.0))
    assert image.imread(tmp_path / "a.png").shape[1] == 250


def test_an_svg_is_as_wide_as_the_sheet_and_its_text_is_text(figure, kind):
    root = ET.parse(figure(kind, ".svg")).getroot()
    assert float(root.get("width").removesuffix("pt")) == pytest.approx(50.0 / 25.4 * 72.0, abs=0.5)
    assert (LABELS[kind] in texts(root)) if kind in LABELS else (texts(root) == set())


def test_a_pdf_embeds_its_fonts_as_outlines(figure, kind):
    held = figure(kind, ".pdf").read_bytes()
    assert held.startswith(b"%PDF")
    assert (b"/FontFile2" in held and b"/Type3" not in held) == (kind in LABELS)
    box = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+) ", held)
    assert float(box[1]) == pytest.approx(50.0 / 25.4 * 72.0, abs=0.5)


@pytest.mark.parametrize("name", ["cloud.svg", "plane.svg", "mesh.svg", "deviation.svg", "zebra.png", "mesh.pdf"])
def test_a_figure_has_the_same_bytes_twice(tmp_path, figure, name):
    kind, suffix = Path(name).stem, Path(name).suffix
    KINDS[kind](tmp_path / name, sheet=SMALL)
    assert (tmp_path / name).read_bytes() == figure(kind, suffix).read_bytes()


def test_the_ground_is_white_or_left_out(tmp_path, figure, kind):
    KINDS[kind](tmp_path / "a.png", sheet=Sheet(25.0, 100.0, is_transparent=True))
    assert image.imread(figure(kind, ".png"))[-1, 0].tolist() == [1.0, 1.0, 1.0, 1.0]
    assert image.imread(tmp_path / "a.png")[-1, 0, 3] == 0.0


def test_lines_stay_lines_up_to_a_number_and_become_one_image_beyond(tmp_path, monkeypatch):
    plane = tmp_path / "a.svg"
    draw_plane(plane, DISC.uv, DISC.triangles)
    assert b"<image" not in plane.read_bytes()
    monkeypatch.setattr("pointchart.look.paint.MOST_SHAPES", 100)
    draw_plane(plane, DISC.uv, DISC.triangles)
    assert plane.read_bytes().count(b"<image") == 1


@pytest.mark.usefixtures("full_disk")
def test_a_failed_figure_leaves_the_old_file_and_nothing_else(tmp_path, kind):
    path = tmp_path / "a.png"
    path.write_text("old")
    with pytest.raises(FormatError, match="No space left on device"):
        KINDS[kind](path, sheet=SMALL)
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.png"]
    assert path.read_text() == "old"


@pytest.mark.parametrize(
    ("name", "sheet", "message"),
    [
        ("a.jpg", SMALL, r"the suffix '.jpg' cannot be written here; choose one of .png, .svg, .pdf"),
        ("none/a.png", SMALL, "the folder .*none does not exist; create it first"),
        ("a.png", Sheet(5.0), "the figure is 5 mm wide; take 20 to 1000"),
        ("a.png", Sheet(np.nan), "the figure is nan mm wide"),
        ("a.png", Sheet(dpi=1e6), r"the figure has 1e\+06 pixels an inch; take 50 to 2400"),
    ],
)
def test_a_sheet_that_cannot_be_is_refused(tmp_path, kind, name, sheet, message):
    with pytest.raises((FormatError, InputError), match=message):
        KINDS[kind](tmp_path / name, sheet=sheet)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("edges", [True, False])
def test_a_disc_from_above_covers_its_area(tmp_path, edges):
    picture = drawn(draw_mesh, tmp_path / "a.png", DISC.points, DISC.triangles, edges=edges, **ABOVE)
    inked = (1.0 - near(picture, "white", 0.3)).sum()
    pixel = np.ptp(DISC.points[:, 0]) / (48.0 / PIXEL)
    x, y = DISC.points[:, :2].T
    a, b, c = DISC.triangles.T
    area = 0.5 * ((x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])).sum()
    assert inked * pixel**2 == pytest.approx(area, rel=0.01)


def test_a_mesh_seen_from_behind_shows_its_inside(tmp_path):
    front, back = (
        drawn(draw_mesh, tmp_path / "a.png", CAP.points, CAP.triangles, edges=False, view=(0, tilt), up="z")
        for tilt in (90, -90)
    )
    middle = tuple(side // 2 for side in front.shape[:2])
    assert back[middle][0] > 1.5 * back[middle][2]
    assert front[middle][0] < 1.5 * front[middle][2]


def test_near_triangles_hide_far_ones(tmp_path):
    lid = CAP.points + np.array([0.0, 0.0, 3.0])
    points, triangles = np.concatenate([CAP.points, lid]), np.concatenate([CAP.triangles, CAP.triangles + 400])
    values = np.repeat([0.0, 1.0], 400)
    for edges in (True, False):
        both = drawn(
            draw_mesh, tmp_path / "a.png", points, triangles, values=values, label="part", edges=edges, **ABOVE
        )
        alone = both[: len(both) - 70]
        dark = alone[~near(alone, "white", 0.3)]
        assert np.median(dark, axis=0).max() < 0.3


def test_the_plane_is_drawn_within_the_unit_circle_and_its_rim_is_the_accent(tmp_path):
    picture = drawn(draw_plane, tmp_path / "a.png", DISC.uv, DISC.triangles)
    row, column = np.nonzero(~near(picture, "white", 0.02))
    middle = (np.array(picture.shape[:2]) - 1.0) / 2.0
    radius = 48.0 / PIXEL / 2.0
    assert np.hypot(row - middle[0], column - middle[1]).max() < radius + 2.5
    red_row, red_column = np.nonzero(near(picture, ACCENT, 0.1))
    assert np.hypot(red_row - middle[0], red_column - middle[1]).min() > 0.97 * radius
    assert len(red_row) > 300


def test_gaps_of_a_mesh_are_rims_too(tmp_path):
    ring = shapes.annulus(400)
    picture = drawn(draw_plane, tmp_path / "a.png", ring.points[:, :2], ring.triangles)
    row, column = np.nonzero(near(picture, ACCENT, 0.1))
    off = np.hypot(row - picture.shape[0] / 2, column - picture.shape[1] / 2)
    inner = np.linalg.norm(ring.points[:, :2], axis=1).min() / np.linalg.norm(ring.points[:, :2], axis=1).max()
    assert off.min() / off.max() == pytest.approx(inner, rel=0.06)


def test_every_point_of_a_sparse_cloud_is_a_dot(tmp_path):
    grid = shapes.grid(7, 5).points
    dots = ~near(drawn(draw_cloud, tmp_path / "a.png", grid, **ABOVE), "white", 0.3)
    assert (np.diff(dots.any(axis=0).astype(int)) == 1).sum() == 7
    assert (np.diff(dots.any(axis=1).astype(int)) == 1).sum() == 5


def test_near_points_are_darker_than_far_ones(tmp_path):
    tilted = shapes.grid(9, 9).points
    tilted[:, 2] = tilted[:, 0] * 0.1
    picture = drawn(draw_cloud, tmp_path / "a.png", tilted, **ABOVE)
    dark = 1.0 - picture.mean(axis=2)
    assert dark[:, -40:].max() > 1.5 * dark[:, :40].max()


def test_deviations_of_opposite_sign_have_opposite_places_on_the_scale(tmp_path):
    tones = []
    for lift in (0.05, -0.05, 0.0):
        path = tmp_path / "a.png"
        cloud = evaluate(FLAT, FEET) + np.array([0.0, 0.0, lift])
        picture = drawn(draw_deviation_map, path, FLAT, BOX, cloud, limit=0.1, **ABOVE)
        tones.append(np.median(picture[20:-80, 20:-20].reshape(-1, 3), axis=0))
        ends = picture[-60:].reshape(-1, 3)
        assert np.abs(ends - colors.to_rgb("#7a2416")).max(axis=1).min() < 0.03
        assert np.abs(ends - colors.to_rgb("#12344f")).max(axis=1).min() < 0.03
    warm, cold, none = tones
    assert warm[0] - warm[2] > 0.2 > -0.2 > cold[0] - cold[2]
    assert np.ptp(none) < 0.1


def test_a_deviation_map_ends_its_scale_at_a_round_number_that_holds_the_scan(tmp_path):
    above = evaluate(FLAT, FEET) + np.outer(np.linspace(-0.017, 0.017, 900), [0, 0, 1])
    draw_deviation_map(tmp_path / "a.svg", FLAT, BOX, above, unit="in", sheet=SMALL)
    root = ET.parse(tmp_path / "a.svg").getroot()
    assert texts(root) == {"\N{MINUS SIGN}0.02", "0", "0.02", "deviation in in"}


def test_a_plane_reflects_one_tone_and_an_arch_ink_and_paper(tmp_path):
    one = drawn(draw_zebra, tmp_path / "a.png", FLAT, BOX, **ABOVE)[20:-20, 20:-20].reshape(-1, 3)
    assert np.ptp(one, axis=0).max() < 0.02
    stripes = drawn(draw_zebra, tmp_path / "b.png", ARCH, BOX, **ABOVE)[20:-20, 20:-20]
    assert 0.2 < near(stripes, INK, 0.15).mean() < 0.7


@pytest.mark.parametrize(("unit", "offset"), [(1e-9, 0.0), (1.0, 5e6), (1e9, 0.0)])
def test_a_figure_does_not_depend_on_the_unit_nor_on_the_place(tmp_path, unit, offset):
    for edges in (True, False):
        here = drawn(draw_mesh, tmp_path / "a.png", CAP.points, CAP.triangles, edges=edges)
        there = drawn(draw_mesh, tmp_path / "b.png", unit * CAP.points + offset, CAP.triangles, edges=edges)
        assert here.shape == there.shape
        assert np.abs(here - there).mean() < 2e-3


def test_a_flat_mesh_seen_along_its_plane_is_a_line(tmp_path):
    for edges in (True, False):
        options = {"edges": edges, "view": (0, 0), "up": "z"}
        picture = drawn(draw_mesh, tmp_path / "a.png", DISC.points, DISC.triangles, **options)
        assert np.count_nonzero(~near(picture, "white", 0.2).all(axis=1)) <= 4


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda path: draw_cloud(path, CAP.points[:0]), "the scan has 0 points; a surface patch needs at least 4"),
        (lambda path: draw_mesh(path, CAP.points, CAP.triangles[:0]), "400 points and no triangles; give a mesh, or"),
        (lambda path: draw_plane(path, CAP.uv, CAP.triangles[:0]), "400 points and no triangles"),
        (lambda path: draw_mesh(path, CAP.points, CAP.triangles + 9), "name points that are not there"),
        (lambda path: draw_cloud(path, CAP.points, values=np.ones(3), label="mass"), r"'mass' has shape \(3,\), but"),
        (lambda path: draw_cloud(path, CAP.points, values=["a"] * 400, label="name"), "'name' is no array of numbers"),
        (lambda path: draw_plane(path, 0.0 * CAP.uv, CAP.triangles), "the parameters of all 400 points are the same"),
        (lambda path: draw_cloud(path, CAP.points, values=np.full(400, np.nan)), "none of the 400 values of 'value'"),
        (lambda path: draw_cloud(path, CAP.points, view=(np.nan, 0)), "two finite angles in degrees are needed"),
        (lambda path: draw_cloud(path, CAP.points, up="w"), "the axis upwards is 'w'; it has to be one of x, y, z"),
        (
            lambda path: draw_deviation_map(path, FLAT, BOX, CAP.points, limit=-1.0),
            "the limit of the colours is -1; give a length more than 0, in mm",
        ),
    ],
)
def test_what_cannot_be_drawn_is_said_and_no_file_is_left(tmp_path, draw, message):
    with pytest.raises(InputError, match=message):
        draw(tmp_path / "a.png")
    assert list(tmp_path.iterdir()) == []


def test_values_are_shown_where_their_points_are(tmp_path):
    """Values that grow to the right darken to the right, whichever points are in front."""
    domes = shapes.hemisphere(1500)
    x = domes.points[:, 0]
    for draw, more in ((draw_cloud, {}), (draw_mesh, {"triangles": domes.triangles, "edges": False})):
        draw(tmp_path / "a.png", points=domes.points, values=x, label="x", sheet=SMALL, **ABOVE, **more)
        picture = image.imread(tmp_path / "a.png")[:, :, :3]
        picture = picture[: int(0.8 * len(picture))]  # above the scale
        is_drawn = picture.min(axis=2) < 0.95
        tone = np.array([picture[:, k][is_drawn[:, k]].mean() for k in np.flatnonzero(is_drawn.any(axis=0))])
        thirds = [part.mean() for part in np.array_split(tone[3:-3], 5)]
        assert thirds == sorted(thirds, reverse=True)


def test_a_vertex_in_no_triangle_does_not_matter(tmp_path):
    far = np.vstack([CAP.points, [[1e6, 1e6, 0.0]]])
    draw_mesh(tmp_path / "a.png", CAP.points, CAP.triangles, edges=False, view=(0, 90), up="z", sheet=SMALL)
    draw_mesh(tmp_path / "b.png", far, CAP.triangles, edges=False, view=(0, 90), up="z", sheet=SMALL)
    one, other = (image.imread(tmp_path / name)[:, :, 0] < 0.95 for name in ("a.png", "b.png"))
    assert np.count_nonzero(one != other) < 0.01 * np.count_nonzero(one)


def test_another_scan_is_no_deviation(tmp_path):
    other = evaluate(ARCH, FEET) + np.array([0.0, 0.0, 50.0])
    with pytest.raises(InputError, match=r"half of the 900 points are 4\S+ or more away from the surface"):
        draw_deviation_map(tmp_path / "a.png", ARCH, BOX, other)
    assert not list(tmp_path.iterdir())


def test_names_are_no_formulas(tmp_path):
    draw_cloud(tmp_path / "a.svg", CAP.points, values=SCORES, label=r"a$b_$c $\foo$", sheet=SMALL)
    assert r"a$b_$c $\foo$" in (tmp_path / "a.svg").read_text("utf-8")
