import sys

import numpy as np
import pytest
from comparisons import edges_of, f1, in_rows, oriented
from hypothesis import given, settings
from hypothesis import strategies as st
from scans import SIMULATED
from strategies import rotations, seeds

from pointchart import bridge_gaps, leave_gaps_open, reconstruct, shapes
from pointchart._check import check_points


@pytest.mark.parametrize(
    ("scale", "offset"),
    [
        (1e-9, (0, 0, 0)),
        (1e9, (0, 0, 0)),
        (1, (5e5, 5.4e6, 120)),
        (1e3, (5e8, 5.4e9, 1.2e5)),
        (1, (-1e7, 3e6, 1e7)),
    ],
)
def test_units_and_offsets_do_not_change_the_triangles(scale, offset):
    shape = SIMULATED["relief"]()
    moved = reconstruct(scale * shape.points + np.array(offset))
    still = reconstruct(shape.points)
    assert in_rows(moved) == in_rows(still)
    assert moved.uv == pytest.approx(still.uv, abs=1e-6)


@given(st.integers(-60, 60))
@settings(max_examples=5)
def test_a_power_of_two_of_scale_changes_no_digit(exponent):
    shape = SIMULATED["relief"]()
    still, scaled = reconstruct(shape.points), reconstruct(2.0**exponent * shape.points)
    assert np.array_equal(still.uv, scaled.uv)
    assert np.array_equal(still.triangles, scaled.triangles)


@given(rotations())
@settings(max_examples=5)
def test_the_pose_does_not_change_the_edges(rotation):
    shape = SIMULATED["sculpture"]()
    turned, still = (edges_of(reconstruct(points).triangles) for points in (shape.points @ rotation.T, shape.points))
    assert f1(turned, still) > 0.999


@given(seeds)
@settings(max_examples=5)
def test_the_numbering_does_not_change_the_triangles(seed):
    shape = SIMULATED["relief"]()
    order = np.random.default_rng(seed).permutation(len(shape.points))
    assert oriented(order[reconstruct(shape.points[order]).triangles]) == in_rows(reconstruct(shape.points))


def test_the_points_given_are_not_touched():
    points = shapes.hemisphere(300).points
    before = points.copy()
    points.setflags(write=False)
    reconstruct(points)
    assert np.array_equal(points, before)


@pytest.mark.parametrize("rule", [bridge_gaps, leave_gaps_open])
@pytest.mark.parametrize(("scale", "offset"), [(1e-6, (0, 0, 0)), (2.0**10, (0, 0, 0)), (1e3, (4e5, 5e6, 100))])
def test_units_and_offsets_change_neither_triangles_nor_holes(rule, scale, offset):
    scan = shapes.pierce(shapes.relief(2000, seed=1), n_gaps=2, seed=1)
    still, moved = (reconstruct(points, gaps=rule) for points in (scan.points, scale * scan.points + np.array(offset)))
    assert in_rows(moved) == in_rows(still)
    assert moved.certificate.holes == still.certificate.holes == (2 if rule is leave_gaps_open else 0)
    for one, other in zip(still.evidence.bridges, moved.evidence.bridges, strict=True):
        assert np.array_equal(one.points, other.points)
        assert other.rim_length == pytest.approx(scale * one.rim_length, rel=1e-6)
        assert other.rim_in_spacings == pytest.approx(one.rim_in_spacings, rel=1e-6)


@given(seeds)
@settings(max_examples=3)
def test_the_numbering_changes_no_hole(seed):
    scan = shapes.pierce(shapes.relief(2000, seed=1), n_gaps=2, seed=1)
    order = np.random.default_rng(seed).permutation(len(scan.points))
    mixed = reconstruct(scan.points[order], gaps=leave_gaps_open)
    assert oriented(order[mixed.triangles]) == in_rows(reconstruct(scan.points, gaps=leave_gaps_open))


# The door


def test_a_scan_is_looked_at_once_and_its_distinct_points_once(monkeypatch):
    looked_at = []

    def counted(points, least=4):
        looked_at.append(len(points))
        return check_points(points, least)

    for module in list(sys.modules.values()):
        if module.__name__.startswith("pointchart.") and getattr(module, "check_points", None) is check_points:
            monkeypatch.setattr(module, "check_points", counted)
    shape = SIMULATED["relief"]()
    result = reconstruct(np.concatenate([shape.points, shape.points[:9]]))
    n = len(shape.points)
    assert looked_at == [n + 9, n, len(result.loop)]  # the last where the boundary is laid out
