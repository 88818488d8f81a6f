"""Triangles over narrow slots."""

import numpy as np

from pointchart import reconstruct, shapes
from pointchart.mesh.spanning import spanning_triangles
from pointchart.report.mesh_notes import slot_notes


def comb():
    """A sheet with slots of three spacings and a half, from one side nearly to the other."""
    x, y = np.meshgrid(np.arange(42.0), np.arange(40.0))
    points = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    in_slot = (points[:, 0] % 8 > 4.3) & (points[:, 1] > 4)
    points[:, :2] += np.random.default_rng(3).normal(0, 0.05, (len(points), 2))
    return points[~in_slot]


def test_slots_that_a_mesh_closes_are_named_and_a_sheet_has_none():
    made = reconstruct(comb())
    n_spanning, share = spanning_triangles(comb(), made.triangles)
    open_share = 1 - len(comb()) / 1680
    if share < 0.02:
        assert len(made.loop) > 300, "the slots are open"
    else:
        assert 0.5 * open_share < share < 1.5 * open_share, "slots are wider by a spacing than the points they lack"
        assert f"{n_spanning} triangles with edges of over 2.5 spacings" in slot_notes(n_spanning, share)[0].text
    whole = shapes.relief(900, seed=4)
    assert slot_notes(*spanning_triangles(whole.points, whole.triangles)) == []
