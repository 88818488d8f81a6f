import numpy as np
import pytest

from pointchart import find_boundary, reconstruct, shapes
from pointchart.agreement.agreed_surface import collect_agreed
from pointchart.boundary.loops import without_slots
from pointchart.points.surroundings import explore


def even(width, height, seed):
    """Sample a rectangle at a spacing of about 1: a triangular grid, each point moved a little."""
    rows, columns = np.arange(int(height / 0.87) + 1), np.arange(int(width) + 1)
    x = columns[None, :] + 0.5 * (rows[:, None] % 2)
    y = np.repeat(0.87 * rows[:, None], len(columns), axis=1)
    flat = np.column_stack([x.ravel(), y.ravel()])
    return flat + np.random.default_rng(seed).uniform(-0.2, 0.2, flat.shape)


def bent(flat):
    """Bend a sheet a little, so that nothing is in a plane."""
    return np.column_stack([flat, 3.0 * np.sin(flat[:, 0] / 15.0) + 2.0 * np.cos(flat[:, 1] / 15.0)])


def comb(wide, seed):
    """Cut four slots 24 long, so many spacings wide, into a sheet of 48 by 36."""
    flat = even(48, 36, seed)
    in_slot = (np.abs(flat[:, :1] - [9, 18, 27, 36]) < wide / 2).any(axis=1) & (flat[:, 1] > 12)
    return bent(flat[~in_slot])


def spiral(apart, seed):
    """Cut a strip 8 wide with so many spacings between its turns out of a sheet."""
    flat = even(90, 90, seed) - 45
    radius, angle = np.hypot(*flat.T), np.arctan2(flat[:, 1], flat[:, 0])
    turn = (radius - 8 - (8 + apart) * (angle + np.pi) / (2 * np.pi)) / (8 + apart)
    on_strip = (turn > 0) & (turn < 3) & (turn % 1.0 < 8 / (8 + apart))
    return bent(flat[on_strip])


def area(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


@pytest.mark.parametrize("wide", [3.4, 4.2, 5.0])
@pytest.mark.parametrize("seed", range(2))
def test_slots_of_three_to_four_spacings_stay_open(wide, seed):
    points = comb(wide, seed)
    result = reconstruct(points)
    assert len(result.loop) > 230  # 165 round the sheet with its slots closed
    assert area(points, result.triangles) < 0.87 * len(points)  # a point has 0.87; with the slots closed, over 1.04


@pytest.mark.parametrize("apart", [3.5, 5.5])
@pytest.mark.parametrize("seed", range(2))
def test_a_spiral_strip_has_one_boundary_along_both_its_sides(apart, seed):
    points = spiral(apart, seed)
    result = reconstruct(points)
    assert len(result.loop) > 0.16 * len(points)
    assert area(points, result.triangles) < 0.9 * len(points)  # closed between its turns, it has 1.2 and more


@pytest.mark.parametrize("sigma", [0, 0.25, 0.5])
@pytest.mark.parametrize("sheet", [shapes.relief(1500), shapes.disc(800), shapes.hemisphere(800)], ids=str)
def test_a_sheet_without_slots_keeps_its_boundary(sheet, sigma):
    points = shapes.add_noise(sheet, sigma_in_spacings=sigma).points
    assert len(find_boundary(points).loop) <= 1.05 * len(sheet.boundary)


def test_no_triangle_of_an_even_sheet_lies_across_a_slot():
    points = bent(even(30, 30, 0))
    near = explore(points)
    agreed = collect_agreed(near.smoothed, near.star, near.spacing)
    inner = np.abs(points[:, :2] - 15).max(axis=1) < 12
    less = without_slots(near.smoothed, agreed, inner, near)
    assert less is agreed
