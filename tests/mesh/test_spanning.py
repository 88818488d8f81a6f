"""Triangles over narrow slots."""

import pytest

from pointchart import shapes
from pointchart.mesh.spanning import SPANNING, spanning_triangles
from pointchart.report.mesh_notes import SLOTS, slot_notes


def plate(wide):
    """A grid of 21 by 21 with its columns from the tenth on moved, so that one strip is so many spacings wide."""
    sheet = shapes.grid(21, 21)
    points = sheet.points.copy()
    points[points[:, 0] >= 10, 0] += wide - 1.0
    return points, sheet.triangles


@pytest.mark.parametrize("wide", [2.0, 3.0, 4.0, 6.0])
def test_triangles_over_a_wide_strip_are_counted_with_their_share_of_the_area(wide):
    n_spanning, share = spanning_triangles(*plate(wide))
    # At the ends of the strip the spacing is that across it, so that a triangle or two do not count there.
    assert n_spanning in (range(36, 41) if wide > SPANNING else [0])
    assert share == pytest.approx(n_spanning / 40 * wide / (19 + wide))
    said = slot_notes(n_spanning, share)
    assert bool(said) == (share > SLOTS)
    if said:
        assert said[0].text.startswith(f"look at {n_spanning} triangles with edges of over 2.5 spacings, ")


def test_uneven_sheets_have_hardly_any():
    whole = shapes.relief(900, seed=4)
    n_spanning, share = spanning_triangles(whole.points, whole.triangles)
    assert slot_notes(n_spanning, share) == []
    assert n_spanning < 0.02 * len(whole.triangles)
