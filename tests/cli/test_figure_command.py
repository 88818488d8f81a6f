"""The command ``figure``."""

import json

import numpy as np
import pytest
from matplotlib import image

from pointchart import shapes
from pointchart.cad import write_surface_json
from pointchart.io import write_mesh
from pointchart.surface import BSplineSurface, evaluate

CAP = shapes.hemisphere(400)
UNIT = np.array([0.0, 0, 1, 1])
FLAT = BSplineSurface(1, UNIT, UNIT, np.array([[[0.0, 0, 0], [0, 2, 0]], [[3, 0, 0], [3, 2, 0]]]))
BOX = [np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])]
SMALL = ["--width", "40", "--dpi", "80"]
INPUTS = {
    "cloud": ["scan.ply"],
    "plane": ["mesh.ply"],
    "mesh": ["mesh.ply"],
    "deviation": ["surface.json", "--points", "flat.ply"],
    "zebra": ["surface.json"],
}


@pytest.fixture
def draw(command_line, tmp_path, monkeypatch):
    """Draw a figure from files in a folder; return exit code and stderr."""
    monkeypatch.chdir(tmp_path)
    none = np.empty((0, 3), np.int64)
    write_mesh("scan.ply", CAP.points, none, attributes={"intensity": np.arange(400.0)})
    write_mesh("mesh.ply", CAP.points, CAP.triangles, uv=CAP.uv)
    write_mesh("bare.ply", CAP.points, CAP.triangles)
    write_mesh("flat.ply", evaluate(FLAT, np.random.default_rng(0).random((300, 2))), none)
    write_surface_json("surface.json", FLAT, BOX, unit="cm")
    monkeypatch.setattr("pointchart.look.surface_raster.GRID", 300)
    before = set(tmp_path.iterdir())

    def call(*words):
        code, out, err = command_line("figure", *words)
        assert out == ""
        return code, err, sorted(path.name for path in set(tmp_path.iterdir()) - before)

    return call


@pytest.mark.parametrize(
    ("kind", "suffix", "begins"),
    [(kind, "png", b"\x89PNG") for kind in INPUTS] + [("mesh", "svg", b"<?xml"), ("cloud", "pdf", b"%PDF")],
)
def test_every_kind_is_drawn_in_the_format_of_its_suffix(draw, kind, suffix, begins):
    code, err, files = draw(kind, *INPUTS[kind], "-o", f"figure.{suffix}", *SMALL)
    assert (code, err.strip(), files) == (0, f"figure.{suffix}", [f"figure.{suffix}"])
    with open(f"figure.{suffix}", "rb") as figure:
        assert figure.read(16).startswith(begins)


def test_width_and_dpi_are_those_of_the_picture(draw):
    assert draw("mesh", "mesh.ply", "-o", "a.png", "--width", "127", "--dpi", "60", "-q")[:2] == (0, "")
    assert image.imread("a.png").shape[1] == 300


@pytest.mark.parametrize(
    ("words", "label"),
    [
        (["cloud", "scan.ply", "--color", "intensity"], "intensity"),
        (["mesh", "mesh.ply", "--color", "stretch"], "stretch"),
        (["plane", "mesh.ply", "--color", "stretch"], "stretch"),
        (["deviation", "surface.json", "--points", "flat.ply", "--limit", "0.5"], "deviation in cm"),
    ],
)
def test_a_scale_says_what_its_colours_mean(draw, words, label):
    assert draw(*words, "-o", "a.svg", *SMALL)[0] == 0
    with open("a.svg", encoding="utf-8") as figure:
        assert f">{label}</text>" in figure.read()


def test_a_view_from_above_is_square_for_a_half_sphere_and_flat_from_the_side(draw):
    for view, aspect in (("0,90", 1.0), ("-70,0", 0.5)):
        assert draw("mesh", "mesh.ply", "-o", "a.png", "--view", view, "--up", "z", "--no-edges", *SMALL)[0] == 0
        picture = image.imread("a.png")[:, :, :3].min(axis=2) < 0.9
        rows, columns = (np.ptp(np.flatnonzero(picture.any(axis=k))) for k in (1, 0))
        assert rows / columns == pytest.approx(aspect, abs=0.04)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["cloud", "scan.ply", "-o", "a.jpg"], "a.jpg: the suffix '.jpg' cannot be written here; choose one of .png"),
        (["cloud", "none.ply", "-o", "a.png"], "none.ply"),
        (["mesh", "scan.ply", "-o", "a.png"], "scan.ply: the file has 400 points and no triangles; mesh it, or draw"),
        (["plane", "bare.ply", "-o", "a.png"], "bare.ply: its 400 points have no u and v; give a mesh that mesh"),
        (["zebra", "mesh.ply", "-o", "a.png"], "mesh.ply"),
        (["zebra", "other.json", "-o", "a.png"], "other.json: there is no member 'format' that is 'pointchart surf"),
        (["cloud", "empty.xyz", "-o", "a.png"], "empty.xyz"),
        (["cloud", "scan.ply", "-o", "a.png", "--color", "mass"], "scan.ply: there is no 'mass' for its 400 points"),
        (["mesh", "bare.ply", "-o", "a.png", "--color", "stretch"], "there is no 'stretch' for its 400 points, only n"),
        (["deviation", "surface.json", "--points", "flat.ply", "-o", "a.png", "--limit", "0"], "give a length more"),
        (["cloud", "twin.svg", "-o", "twin.svg"], "twin.svg: the output is also twin.svg, which would be lost"),
    ],
)
def test_what_cannot_be_drawn_is_one_sentence_and_leaves_no_file(draw, words, sentence):
    with open("other.json", "w", encoding="utf-8") as other:
        json.dump({"format": "other"}, other)
    open("empty.xyz", "w").close()
    code, err, files = draw(*words)
    assert code == 1
    assert err.startswith("pointchart: ")
    assert sentence in err
    assert err.count("\n") == 1
    assert files == ["empty.xyz", "other.json"]


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["sculpture", "scan.ply", "-o", "a.png"], "sculpture"),
        (["deviation", "surface.json", "-o", "a.png"], "deviation needs --points SCAN"),
        (["cloud", "scan.ply", "-o", "a.png", "--points", "flat.ply"], "--points is for deviation, not for cloud"),
        (["plane", "mesh.ply", "-o", "a.png", "--view", "1,2"], "--view is for cloud, mesh, deviation, zebra, not"),
        (["cloud", "scan.ply", "-o", "a.png", "--no-edges"], "--edges is for mesh, plane, not for cloud"),
        (["zebra", "surface.json", "-o", "a.png", "--color", "x"], "--color is for cloud, mesh, plane, not for zebra"),
        (["mesh", "mesh.ply", "-o", "a.png", "--view", "1"], "--view is '1'; two angles in degrees are needed"),
        (["mesh", "mesh.ply", "-o", "a.png", "--view", "a,b"], "--view is 'a,b'; two angles"),
        (["mesh", "mesh.ply", "-o", "a.png", "--view", "nan,0"], "--view is 'nan,0'; two angles"),
        (["mesh", "mesh.ply", "-o", "a.png", "--view", "0,1e9"], "the second from -90 to 90"),
        (["mesh", "mesh.ply", "-o", "a.png", "--up", "w"], "w"),
        (["cloud", "scan.ply", "-o", "a.png", "--width", "3"], "--width"),
        (["cloud", "scan.ply", "-o", "a.png", "--dpi", "0"], "--dpi"),
        (["plane", "mesh.ply", "-o", "a.png", "--no-edges"], "--no-edges leaves nothing of a plane to see"),
    ],
)
def test_wrong_options_are_wrong_usage(draw, words, complaint):
    code, err, files = draw(*words)
    assert (code, files) == (2, [])
    assert complaint in " ".join(err.replace("│", " ").split())


def test_the_boundary_is_drawn_as_lines_too(command_line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_mesh("scan.ply", CAP.points, np.empty((0, 3), np.int64))
    assert command_line("boundary", "scan.ply", "-o", "loop.txt", "--picture", "boundary.svg")[0] == 0
    assert (tmp_path / "boundary.svg").read_bytes().startswith(b"<?xml")
