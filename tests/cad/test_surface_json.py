"""Surfaces as JSON: every bit comes back, and what is wrong with a file or a surface is named."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pointchart.cad import MILLIMETRES, read_surface_json, write_surface_json
from pointchart.cad.surface_checks import check_loops
from pointchart.errors import FormatError, InputError
from pointchart.surface import BSplineSurface

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
HOLE = 0.25 + 0.5 * SQUARE[::-1]
CLAMPED = np.array([0.0, 0.0, 1.0, 1.0])
DOMAIN = np.array([[0.0, 0.0], [1.0, 1.0]])


def saddle(**changes):
    corners = np.array([[[0.0, 0, 0], [0, 2, 0]], [[4, 0, 0], [4, 2, 8]]])
    fields = {"degree": 1, "knots_u": CLAMPED, "knots_v": CLAMPED, "control": corners}
    return BSplineSurface(**(fields | changes))


def written(path, **changes):
    """Write a file and change some of its members."""
    write_surface_json(path, saddle(), [SQUARE, HOLE])
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))
    return path


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=12, max_size=12))
def test_every_double_comes_back_to_the_last_bit(tmp_path_factory, numbers):
    path = tmp_path_factory.getbasetemp() / "a.json"
    surface = saddle(control=np.array(numbers).reshape(2, 2, 3))
    write_surface_json(path, surface, [SQUARE])
    assert read_surface_json(path)[0].control.tobytes() == surface.control.tobytes()


def test_knots_loops_degree_and_unit_come_back(tmp_path):
    rng = np.random.default_rng(7)
    knots_u, knots_v = (np.concatenate([np.zeros(3), np.sort(rng.random(n)), np.ones(3)]) for n in (4, 2))
    surface = BSplineSurface(2, knots_u, knots_v, rng.standard_normal((7, 5, 3)) * 1e5)
    loops = [SQUARE, HOLE / 3.0]
    for unit in MILLIMETRES:
        write_surface_json(tmp_path / "ß.json", surface, loops, unit=unit)
        found, found_loops, found_unit = read_surface_json(tmp_path / "ß.json")
        assert (found.degree, found_unit) == (2, unit)
        for name in ("knots_u", "knots_v", "control"):
            assert np.array_equal(getattr(found, name), getattr(surface, name))
        assert all(np.array_equal(a, b) for a, b in zip(found_loops, loops, strict=True))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"format": "another"}, "there is no member 'format' that is 'pointchart surface'"),
        ({"version": 2}, "the version is 2, but 1 is read"),
        ({"degree": 1.5}, "'degree' is 1.5, not a whole number"),
        ({"degree": True}, "'degree' is True, not a whole number"),
        ({"degree": 0}, "the degree is 0; a surface needs at least 1"),
        ({"degree": 2}, r"knots_u has shape \(4,\); 2 control points of degree 2 need 6 finite knots"),
        ({"knots_u": [0, 0, "x", 1]}, "knots_u is no array of numbers"),
        ({"knots_v": [0, 0, 1, 0.5]}, "knots_v descends after 2; sort the knots"),
        ({"knots_v": [0, 0.5, 1, 1]}, "knots_v repeats its knots 1, 1, 2 times"),
        ({"knots_u": [0, 0, 1, None]}, "finite knots"),
        ({"control": [[0, 0, 0]]}, r"the control points have shape \(1, 3\)"),
        ({"control": [[[0, 0], [0]]]}, "control is no array of numbers"),
        ({"loops": 3}, "'loops' is no list"),
        ({"loops": []}, "there are 0 loops"),
        ({"loops": [{"u": 1}]}, "loop 0 is no array of numbers"),
        ({"unit": "furlong"}, "the unit 'furlong' is none of the 6 known; use um, mm"),
        ({"unit": ["mm"]}, "the unit"),
    ],
)
def test_a_member_that_is_wrong_is_named(tmp_path, changes, message):
    with pytest.raises(FormatError, match=message):
        read_surface_json(written(tmp_path / "a.json", **changes))


def test_a_member_that_is_missing_is_named(tmp_path):
    path = written(tmp_path / "a.json")
    held = json.loads(path.read_text())
    del held["control"]
    path.write_text(json.dumps(held))
    with pytest.raises(FormatError, match=r"there is no member 'control' \(1 are missing\)"):
        read_surface_json(path)


@pytest.mark.parametrize("content", ["{", "[1, 2]", "[" * 100000, "nonsense", '"text"', "1e999"])
def test_other_files_are_refused(tmp_path, content):
    (tmp_path / "a.json").write_text(content)
    with pytest.raises(FormatError, match=r"no whole JSON file|no member 'format'"):
        read_surface_json(tmp_path / "a.json")


@pytest.mark.parametrize(
    ("loops", "message"),
    [
        ([SQUARE[::-1]], "loop 0 has the signed area -1, but the outer loop runs anticlockwise; reverse it"),
        ([SQUARE, HOLE[::-1]], r"loop 1 has the signed area 0\.25, but a hole runs clockwise; reverse it"),
        ([SQUARE * 1.5], "loop 0 leaves the domain .* at points 1, 2, 3; clip it"),
        ([SQUARE / 4.0, HOLE], r"loop 1 begins at \[0\.25, 0\.75\], which is no place inside; drop that hole"),
        ([SQUARE, HOLE, 0.4 + 0.2 * SQUARE[::-1]], "loop 2 begins at .* no place inside"),
        ([SQUARE[[0, 1, 2, 2, 3]]], "loop 0 repeats its points 2 at once"),
        ([SQUARE[[0, 1, 2, 3, 0]]], "loop 0 repeats its points 4 at once"),
        ([SQUARE[:2]], r"loop 0 has shape \(2, 2\)"),
        ([np.full((3, 2), np.nan)], "at least 3 finite corners"),
    ],
)
def test_loops_that_bound_nothing_are_named(loops, message):
    with pytest.raises(InputError, match=message):
        check_loops(loops, DOMAIN)


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_what_is_no_surface_is_not_written(tmp_path, wrong):
    path = tmp_path / "a.json"
    path.write_text("old")
    control = saddle().control.copy()
    control[0, 0, 0] = wrong
    with pytest.raises(InputError, match="finite numbers are needed"):
        write_surface_json(path, saddle(control=control), [SQUARE])
    with pytest.raises(InputError, match="the unit 'mile' is none"):
        write_surface_json(path, saddle(), [SQUARE], unit="mile")
    assert path.read_text() == "old"


def test_a_full_disk_leaves_the_old_file(tmp_path, full_disk):
    path = tmp_path / "a.json"
    path.write_text("old")
    with pytest.raises(FormatError, match="No space left on device"):
        write_surface_json(path, saddle(), [SQUARE])
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_another_suffix_is_refused(tmp_path):
    with pytest.raises(FormatError, match=r"the suffix '\.txt' cannot be written here; choose one of \.json"):
        write_surface_json(tmp_path / "a.txt", saddle(), [SQUARE])
