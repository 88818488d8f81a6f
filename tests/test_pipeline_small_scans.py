import numpy as np
import pytest
from comparisons import in_rows, oriented
from scans import SQUARE

from pointchart import InputError, reconstruct, shapes


@pytest.mark.parametrize("n_inner", [0, 1, 2])
def test_four_to_six_points_with_their_boundary_are_a_disc(n_inner):
    points = np.r_[SQUARE, [[0.4, 0.5, 0.1], [0.7, 0.6, 0.1]][:n_inner]] if n_inner else SQUARE
    result = reconstruct(points, [0, 1, 2, 3])
    assert len(result.triangles) == 2 + 2 * n_inner
    assert result.certificate.is_one_to_one


@pytest.mark.parametrize("n", [4, 5, 6, 9])
def test_a_boundary_of_all_points_needs_no_inner_one(n):
    turn = 2 * np.pi * np.arange(n) / n
    ring = np.c_[np.cos(turn), np.sin(turn), 0.2 * np.cos(2 * turn)]
    result = reconstruct(ring, np.arange(n))
    assert len(result.triangles) == n - 2
    assert result.certificate.is_one_to_one


@pytest.mark.parametrize("n", range(4))
def test_fewer_than_four_points_are_refused(n):
    with pytest.raises(InputError, match=f"the scan has {n} points; a surface patch needs at least 4"):
        reconstruct(SQUARE[:n].reshape(-1, 3))


@pytest.mark.parametrize("n", [4, 5, 6])
def test_a_handful_of_points_without_a_boundary_asks_for_one(n):
    points = np.r_[SQUARE, [[0.4, 0.5, 0.1], [0.7, 0.6, 0.1]]][:n]
    with pytest.raises(InputError, match=r"no boundary was found.*too few.*give the boundary"):
        reconstruct(points)


@pytest.mark.parametrize("axes", [[0, 1, 2], [2, 0, 1], [1, 2, 0]])
def test_planar_points_in_a_coordinate_plane_are_a_disc(axes):
    sheet = shapes.grid(8, 6)
    result = reconstruct(sheet.points[:, axes])
    assert result.certificate.is_one_to_one
    assert set(result.loop) == set(sheet.boundary)


def test_repeated_points_are_merged_to_the_first():
    points = shapes.relief(300, seed=2).points
    repeated = np.r_[points[[7]], points, points[[3, 7]]]
    result = reconstruct(repeated)
    assert result.rows.tolist() == [i for i in range(301) if i != 8]
    first_of = np.r_[7, np.arange(300)]
    assert oriented(first_of[result.rows][result.triangles]) == in_rows(reconstruct(points))


def test_a_boundary_may_name_a_repeated_point_by_any_of_its_rows():
    shape = shapes.hemisphere(300)
    corner = shape.boundary[5]
    loop = np.where(shape.boundary == corner, 300, shape.boundary)
    result = reconstruct(np.r_[shape.points, shape.points[[corner]]], loop)
    assert in_rows(result) == in_rows(reconstruct(shape.points, shape.boundary))


def test_points_one_digit_apart_stay_two_points():
    points = shapes.relief(300, seed=2).points
    twins = np.nextafter(points[40], 9)
    result = reconstruct(np.r_[points, [twins]], shapes.relief(300, seed=2).boundary)
    assert len(result.rows) == 301
    assert result.certificate.is_disc
