"""Height fields: a triangulation of the projection, on exactly the points, certified."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from pointchart import certify, shapes
from pointchart.errors import InputError, Remedy
from pointchart.heights.height_field import Keep, reconstruct_heights
from pointchart.heights.projection import axes_over, fitted_normal, projected

DRAW = np.random.default_rng(5)
FLAT = DRAW.uniform(0.0, 10.0, (600, 2))


def hills(uv):
    return np.column_stack([uv, 3.0 * np.sin(2.0 * uv[:, 0]) * np.cos(3.0 * uv[:, 1])])


def contour_lines():
    """Points along circles of one height each, ten times as close along them as the circles are apart."""
    rings = []
    for k in range(1, 9):
        turn = np.linspace(0.0, 2.0 * np.pi, 60 * k, endpoint=False)
        rings.append(np.column_stack([k * np.cos(turn), k * np.sin(turn), np.full(len(turn), 9.0 - k)]))
    return np.concatenate([[[0.0, 0.0, 9.0]], *rings])


@pytest.mark.parametrize(
    "points",
    [hills(FLAT), contour_lines(), hills(FLAT) + np.array([5e5, 5.4e6, 300.0])],
    ids=["hills", "contours", "far away"],
)
def test_a_height_field_is_a_disc_on_its_points_and_one_to_one_over_the_plane(points):
    made = reconstruct_heights(points)
    assert np.array_equal(made.rows, np.arange(len(points)))
    assert np.array_equal(made.uv, points[:, :2])
    proof = certify(points, made.triangles, uv=made.uv, loop=made.loop)
    assert proof.is_disc
    assert proof.is_one_to_one


def test_without_bays_the_triangles_are_those_of_delaunay():
    points = hills(np.concatenate([FLAT, shapes.grid(21, 21).points[:, :2] / 2]))
    made = reconstruct_heights(points)
    known = {tuple(sorted(t)) for t in Delaunay(points[:, :2]).simplices.tolist()}
    found = {tuple(sorted(t)) for t in made.triangles.tolist()}
    assert len(found - known) <= 0.02 * len(known), "ties on the grid are broken otherwise"


def test_contour_lines_are_joined_and_not_dug_out():
    made, points = reconstruct_heights(contour_lines()), contour_lines()
    a, b, c = (points[made.triangles[:, k], :2] for k in range(3))
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum()
    assert area == pytest.approx(0.5 * 480 * 64 * np.sin(2 * np.pi / 480), rel=1e-12)
    assert len(made.loop) == 480


def test_a_bay_of_the_outline_stays_open_and_a_gap_is_bridged_or_left_open():
    horseshoe = FLAT[~((np.abs(FLAT[:, 0] - 5) < 2) & (FLAT[:, 1] > 4))]
    made = reconstruct_heights(hills(horseshoe))
    middles = made.uv[made.triangles].mean(axis=1)
    assert not ((np.abs(middles[:, 0] - 5) < 1.5) & (middles[:, 1] > 6)).any()
    ring = FLAT[np.linalg.norm(FLAT - 5.0, axis=1) > 2.5]
    closed, opened = (reconstruct_heights(hills(ring), gaps_open=is_open) for is_open in (False, True))
    assert closed.certificate.is_disc
    assert (closed.certificate.holes, opened.certificate.holes) == (0, 1)
    assert opened.certificate.is_one_to_one
    assert len(closed.evidence.bridges) >= 1


@pytest.mark.parametrize("keep", Keep)
def test_of_points_at_one_place_the_highest_or_the_lowest_stays(keep):
    walls = np.concatenate([hills(FLAT), hills(FLAT[:50]) + np.array([0, 0, 4.0])])
    with pytest.raises(InputError, match="100 points share their places in the plane") as refused:
        reconstruct_heights(walls)
    assert refused.value.remedies == (Remedy.keep_one_a_place,)
    made = reconstruct_heights(walls, keep=keep)
    expected = np.r_[50:650] if keep is Keep.highest else np.r_[:600]
    assert np.array_equal(made.rows, expected)


def test_repeated_points_are_merged_without_a_word():
    points = hills(FLAT)
    assert np.array_equal(reconstruct_heights(np.r_[points, points[:9]]).rows, np.arange(600))


@pytest.mark.parametrize("normal", [[0, 0, 1], [0, 0, 5.0], [1, 0, 0], [0, -1, 0], [1, 2, 3], [-1, 1e-9, 0]])
def test_axes_are_a_rotation_whose_last_row_is_the_normal(normal):
    axes = axes_over(normal)
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    np.testing.assert_allclose(axes[2], np.array(normal) / np.linalg.norm(normal), atol=1e-15)


@pytest.mark.parametrize("normal", [[0, 0, 0], [np.nan, 0, 1], [1, 2], [np.inf, 0, 0]])
def test_a_normal_that_is_none_is_refused(normal):
    with pytest.raises(InputError, match="the normal of the plane is"):
        axes_over(normal)


def test_the_fitted_plane_turns_with_the_points():
    turn = axes_over([1, 2, 3])
    points = hills(FLAT) * [1, 1, 0.1]
    np.testing.assert_allclose(fitted_normal(points @ turn), fitted_normal(points) @ turn, atol=1e-9)
    made = reconstruct_heights(points @ turn, fitted_normal(points @ turn))
    assert made.certificate.is_one_to_one
    assert np.array_equal(projected(points, np.eye(3))[0], points[:, :2])
