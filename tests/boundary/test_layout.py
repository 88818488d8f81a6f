import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import rotations, seeds

from pointchart.boundary.corners import quarter_places, sharpest_places
from pointchart.boundary.layout import on_circle, on_polygon, on_square, reversed_loop
from pointchart.boundary.steps import centripetal_steps, chord_length_steps, uniform_steps
from pointchart.errors import InputError
from pointchart.shapes import bent_sheet, grid, relief

some_steps = st.lists(st.floats(1e-6, 1e3), min_size=4, max_size=60)
STEPS = {uniform_steps: 0.0, centripetal_steps: 0.5, chord_length_steps: 1.0}


def turns(uv):
    """Return the angle from each point to the next, seen from the origin, in (0, 2 pi)."""
    angle = np.arctan2(uv[:, 1], uv[:, 0])
    return (np.roll(angle, -1) - angle) % (2 * np.pi)


@given(some_steps)
def test_on_the_circle_all_norms_are_one_and_angles_are_in_proportion_to_the_steps(steps):
    uv = on_circle(steps)
    assert np.abs(np.hypot(*uv.T) - 1).max() < 1e-15
    assert uv[0].tolist() == [1, 0]
    assert np.allclose(turns(uv), 2 * np.pi * np.array(steps) / np.sum(steps), rtol=0, atol=1e-13)


@pytest.mark.parametrize("steps", STEPS)
def test_steps_are_powers_of_the_chords(steps):
    shape = relief(200, seed=1)
    corners = shape.points[shape.boundary]
    chords = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    assert np.allclose(steps(shape.points, shape.boundary), chords ** STEPS[steps], rtol=1e-14)


@pytest.mark.parametrize("steps", STEPS)
@settings(max_examples=20)
@given(rotation=rotations(), exponent=st.floats(-9, 9))
def test_layouts_do_not_depend_on_place_and_size(steps, rotation, exponent):
    shape = relief(150, seed=2)
    moved = 10.0**exponent * (shape.points @ rotation.T + [4, 5, 6])
    one, other = (on_circle(steps(points, shape.boundary)) for points in (shape.points, moved))
    assert np.abs(one - other).max() < 1e-11


@given(some_steps)
def test_the_square_has_points_exactly_on_its_corners_and_sides(steps):
    places = quarter_places(steps)
    uv = on_square(steps)
    assert uv[places].tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert (uv >= 0).all()
    assert (uv <= 1).all()
    assert ((uv == 0) | (uv == 1)).any(axis=1).all()


@given(some_steps)
def test_the_square_is_walked_anticlockwise_once(steps):
    assert np.isclose(turns(on_square(steps) - 0.5).sum(), 2 * np.pi, rtol=1e-12)


@settings(max_examples=60)
@given(seeds, st.integers(3, 8), some_steps)
def test_on_any_polygon_corners_are_vertices_and_chords_are_in_proportion_to_the_steps(seed, n_corners, steps):
    rng = np.random.default_rng(seed)
    steps = np.array(steps * 2)
    turn = np.sort(rng.permutation(64)[:n_corners]) * 2 * np.pi / 64
    vertices = rng.normal(size=2) + np.c_[3 * np.cos(turn), np.sin(turn)]
    corners = np.roll(np.sort(rng.permutation(len(steps))[:n_corners]), rng.integers(n_corners))
    uv = on_polygon(steps, vertices, corners)
    assert np.array_equal(uv[corners], vertices)
    chords = np.linalg.norm(np.roll(uv, -1, axis=0) - uv, axis=1)
    for k, (first, last) in enumerate(zip(corners, np.roll(corners, -1), strict=True)):
        side = (first + np.arange((last - first) % len(steps))) % len(steps)
        length = np.linalg.norm(vertices[(k + 1) % n_corners] - vertices[k])
        assert np.allclose(chords[side], length * steps[side] / steps[side].sum(), rtol=0, atol=1e-13)


@given(some_steps)
def test_quarter_places_ascend_from_the_first_point(steps):
    places = quarter_places(steps)
    assert places[0] == 0
    assert (np.diff(places) > 0).all()
    assert places[-1] < len(steps)


@given(some_steps.map(lambda steps: [1 + step % 1 for step in steps * 4]))
def test_quarter_places_are_within_half_a_step_of_the_quarters(steps):
    at = np.cumsum(steps) - steps
    wanted = np.arange(4) * np.sum(steps) / 4
    assert np.abs(at[quarter_places(steps)] - wanted).max() <= max(steps) / 2 + 1e-9


@settings(max_examples=20)
@given(rotations(), st.integers(4, 20), st.floats(0.6, 1.6), st.integers(0, 30))
def test_the_sharpest_places_of_a_rectangle_are_its_corners(rotation, nx, aspect, shift):
    shape = grid(nx, round(aspect * nx) + 1)
    loop = np.roll(shape.boundary, shift)
    corners = (shape.uv == shape.uv.min(axis=0)) | (shape.uv == shape.uv.max(axis=0))
    found = loop[sharpest_places(shape.points @ rotation.T, loop)]
    assert set(found.tolist()) == set(np.flatnonzero(corners.all(axis=1)).tolist())


def test_the_corners_of_a_rolled_sheet_are_found_in_spite_of_its_curved_sides():
    sheet = bent_sheet(170, nx=41, ny=31)
    found = sheet.boundary[sharpest_places(sheet.points, sheet.boundary)]
    assert set(found.tolist()) == {0, 40, 30 * 41, 31 * 41 - 1}


def test_a_loop_that_is_turned_round_keeps_its_first_point():
    loop = relief(100).boundary
    turned = reversed_loop(loop)
    assert turned[0] == loop[0]
    assert np.array_equal(turned[1:], loop[:0:-1])
    assert np.array_equal(reversed_loop(turned), loop)


SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]


@pytest.mark.parametrize(
    ("vertices", "corners", "message"),
    [
        (SQUARE[::-1], [0, 1, 2, 3], "the domain is no convex polygon: .* anticlockwise"),
        ([[0, 0], [2, 0], [1, 0.5], [0, 2]], [0, 1, 2, 3], "no convex polygon"),
        ([[0, 0], [1, 0], [2, 0], [1, 2]], [0, 1, 2, 3], "without straight angles"),
        ([[0, 0], [1, 0]], [0, 1], "at least 3"),
        (SQUARE, [0, 1, 2], r"the corners are \[0, 1, 2\]; 4 places on a loop of 6 points are needed, from 0 to 5"),
        (SQUARE, [0, 2, 4, 6], "from 0 to 5"),
        (SQUARE, [-1, 0, 2, 4], "from 0 to 5"),
        (SQUARE, [0, 3, 2, 5], r"the corners \[0, 3, 2, 5\] are not in the order of the loop; sort them along it"),
        (SQUARE, [0, 2, 2, 5], "not in the order of the loop"),
    ],
)
def test_wrong_polygons_and_corners_are_refused(vertices, corners, message):
    with pytest.raises(InputError, match=message):
        on_polygon(np.ones(6), vertices, corners)


def test_corners_may_start_anywhere_on_the_loop():
    uv = on_square(np.ones(8), np.array([3, 5, 7, 1]))
    assert uv[[3, 5, 7, 1]].tolist() == SQUARE
    assert uv[[4, 6, 0, 2]].tolist() == [[0.5, 0], [1, 0.5], [0.5, 1], [0, 0.5]]


@pytest.mark.parametrize("steps", [[1, 0, 1], [1, -1, 1, 1], [1, 1], [1, np.nan, 1], [[1, 1, 1]]])
def test_steps_that_are_not_positive_are_refused(steps):
    with pytest.raises(InputError, match="steps along the boundary have to be positive, one for each"):
        on_circle(steps)


def test_loops_with_too_few_points_for_four_corners_are_refused():
    with pytest.raises(InputError, match="the boundary has 3 points; a square needs at least 4: use the circle"):
        on_square([1, 1, 1])
    shape = grid(3, 3)
    with pytest.raises(InputError, match="the boundary has 3 points; 4 corners need at least as many: use the circle"):
        sharpest_places(shape.points, [0, 2, 8])


def test_boundary_points_in_one_place_are_refused_when_laid_out():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, 0], [0, 1, 0]])
    with pytest.raises(InputError, match="points that repeat give steps of length 0"):
        on_circle(chord_length_steps(points, [0, 1, 2, 3]))
