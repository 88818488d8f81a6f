from functools import partial

import numpy as np
import pytest

from pointchart import InputError, chord_length_steps, nearest, on_square, reconstruct, shapes, uniform
from pointchart.boundary import places_of


def test_errors_name_the_rows_of_the_scan():
    shape = shapes.shuffle(shapes.grid(12, 10), seed=5)
    culprit = int(np.flatnonzero((shape.uv == [4, 6]).all(axis=1))[0])
    points = shape.points + np.eye(3)[2] * (np.arange(120) == culprit)[:, None] / 4

    def broken(points, around):
        return np.where(around.rows == np.argmax(points[:, 2]), -1, 1) * uniform(points, around)

    with pytest.raises(InputError, match=rf"the weights at point {culprit} are no convex combination"):
        reconstruct(points, shape.boundary, connect=partial(nearest, k=8), weights=broken)


def test_points_without_a_path_to_the_boundary_are_named_by_their_rows():
    sheet = shapes.grid(12, 10)
    island = np.array([[5.4, 4.4, 0], [5.6, 4.4, 0], [5.5, 4.6, 0]])
    order = np.random.default_rng(1).permutation(123)
    points = np.r_[sheet.points, island][order]
    place = np.argsort(order)
    with pytest.raises(InputError, match=r"have no path to the boundary.*median size is 2") as caught:
        reconstruct(points, place[sheet.boundary], connect=partial(nearest, k=2), weights=uniform)
    assert set(place[[120, 121, 122]]) <= set(caught.value.points["lost"])


def test_repeated_boundary_points_are_named_by_their_rows():
    shape = shapes.shuffle(shapes.grid(8, 6), seed=3)
    loop = np.r_[shape.boundary[:9], shape.boundary[3:]]
    with pytest.raises(InputError, match="are named more than once") as caught:
        reconstruct(shape.points, loop)
    assert set(caught.value.points["repeated"]) == set(shape.boundary[3:9])


def test_a_repeated_boundary_point_in_the_rows_of_repeated_points_is_named():
    shape = shapes.grid(8, 6)
    points = np.r_[shape.points, shape.points[:2], shape.points[:2]]
    loop = np.r_[50, shape.boundary[1:], 50, 49]
    with pytest.raises(InputError, match="boundary points 50 are named more than once"):
        reconstruct(points, np.roll(loop, 3))


def test_two_rows_of_one_point_on_the_boundary_are_the_same_point_twice():
    shape = shapes.grid(8, 6)
    with pytest.raises(InputError, match="boundary points 0 are named more than once"):
        reconstruct(np.r_[shape.points, shape.points[:1]], np.insert(shape.boundary, 5, 48))


def test_corners_off_the_boundary_are_named_by_their_rows():
    shape = shapes.shuffle(shapes.grid(8, 6), seed=3)
    inner = int(np.flatnonzero((shape.uv == [4, 3]).all(axis=1))[0])
    corners = [inner, *shape.boundary[[3, 9, 15]]]
    with pytest.raises(InputError, match=f"corners {inner} are not on the boundary; choose boundary points"):
        reconstruct(
            shape.points,
            layout=lambda points, loop: on_square(chord_length_steps(points, loop), places_of(corners, loop)),
        )
