"""Surfaces as text and as plain data: every figure is that of the surface."""

import json
import re

import numpy as np
import pytest

from pointchart.chart.free_boundary import uv_free_boundary
from pointchart.report.surface_facts import surface_facts
from pointchart.report.surface_notes import choice_notes, surface_notes
from pointchart.surface import BSplineSurface, Deviation, Fit, Level
from pointchart.surface.surfacing import SurfacedScan

LOOP = np.array([[0.0, 0], [3, 0], [3, 2], [0, 2]])
LEVELS = [Level(49, 1e-3, 0.5, 0.25, 0.26), Level(88, 1e-9, 0.0625, 0.03, 0.04)]
POINTS = np.arange(300.0).reshape(100, 3)


def surfaced(*, is_met=True, is_noise=False, n_loops=1):
    """A surface of 8 by 11 control points over 3 by 2, with 100 points, the farthest of them the 40th."""
    knots = [np.r_[[0.0] * 3, np.linspace(0, end, n - 2), [end] * 3] for end, n in ((3.0, 8), (2.0, 11))]
    signed = np.resize([0.01, -0.01], 100)
    signed[39] = -0.0625
    surface = BSplineSurface(3, *knots, np.zeros((8, 11, 3)))
    fit = Fit(surface, np.zeros((100, 2)), LEVELS, is_met, is_noise)
    return SurfacedScan(None, fit, [LOOP] * n_loops, Deviation(signed), uv_free_boundary)


def texts(notes):
    return [note.text for note in notes]


@pytest.mark.parametrize(
    ("n_loops", "words"), [(1, "its boundary"), (2, "its boundary and a gap"), (4, "its boundary and 3 gaps")]
)
def test_the_lines_name_the_surface_and_what_trims_it(n_loops, words):
    first = texts(surface_notes(surfaced(n_loops=n_loops), 0.1, 0.005, "mm"))[0]
    assert first == (
        f"B-spline surface of degree 3, 8 x 11 control points for 100 points (1.1 each), trimmed by {words}"
    )


@pytest.mark.parametrize(("is_met", "word"), [(True, "met"), (False, "NOT met")])
def test_the_lines_say_whether_the_tolerance_is_met_and_give_each_figure(is_met, word):
    lines = texts(surface_notes(surfaced(is_met=is_met), 0.05, 0.01, "mm"))
    assert lines[1] == f"tolerance 0.05 mm but for 1 % outliers: {word}"
    figures = dict(line.strip().split(": ") for line in lines[2:])
    assert float(figures["max"]) == 0.0625
    assert float(figures["max but for 1 %"]) == 0.01
    assert float(figures["within 0.05"]) == 0.99


def test_choices_are_explained_level_by_level():
    lines = texts(choice_notes(surfaced()))
    assert lines[0].endswith("a domain of 3 x 2")
    levels = [line for line in lines if re.match(r"  \d+: ", line)]
    assert levels == [
        "  1: 49 control points, fairness 0.001, deviation 0.5 but for outliers, RMS 0.25, 0.26 of points left out",
        "  2: 88 control points, fairness 1e-09, deviation 0.0625 but for outliers, RMS 0.03, 0.04 of points left out",
    ]


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"is_met": True}, "the tolerance is met"),
        ({"is_met": False}, "no more control points are allowed"),
        ({"is_met": False, "is_noise": True}, "finer knots bring points left out of the fit no nearer"),
    ],
)
def test_the_explanation_says_why_refinement_ended(options, reason):
    assert texts(choice_notes(surfaced(**options)))[-1].startswith(f"ended because {reason}")


def test_the_report_is_plain_data_that_comes_back_from_json():
    report = surface_facts(surfaced(n_loops=2), POINTS, 0.05, 0.01, "mm")
    again = json.loads(json.dumps(report, allow_nan=False))
    assert again == report
    assert again["unit"] == "mm"
    assert again["degree"] == 3
    assert again["control_points"] == [8, 11]
    assert again["points_a_control_point"] == pytest.approx(100 / 88)
    assert again["domain"] == [[0, 0], [3, 2]]
    assert again["trimming_loops"] == [4, 4]
    assert (again["tolerance"], again["outliers"]) == (0.05, 0.01)
    assert (again["met"], again["ended_at_noise"]) == (True, False)
    assert again["deviation"]["max"] == 0.0625
    assert again["deviation"]["max_but_outliers"] == 0.01
    assert again["deviation"]["share_within_tolerance"] == 0.99
    assert again["worst_at"] == POINTS[39].tolist()
    assert [level["n_control"] for level in again["levels"]] == [49, 88]
