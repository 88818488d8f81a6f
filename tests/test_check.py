import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import clouds, seeds

from pointchart._check import check_loop, check_points
from pointchart._parallel import CHUNK, over_ranges
from pointchart.errors import FormatError, InputError, PointchartError, SolveError, name_some, points_called
from pointchart.points.morton import morton_order

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


@pytest.mark.parametrize("shape", [(4,), (4, 2), (3, 4), (2, 2, 3), (0,)])
def test_points_of_a_wrong_shape_are_refused_with_their_shape(shape):
    with pytest.raises(InputError, match=rf"points have shape \({', '.join(map(str, shape))},?\); \(n, 3\) is needed"):
        check_points(np.ones(shape))


@pytest.mark.parametrize("n", range(4))
def test_too_few_points_are_counted(n):
    with pytest.raises(InputError, match=f"the scan has {n} points; a surface patch needs at least 4"):
        check_points(np.eye(4, 3)[:n])


@pytest.mark.parametrize("broken", [np.nan, np.inf, -np.inf])
def test_broken_coordinates_are_counted_and_the_first_is_named(broken):
    points = np.r_[SQUARE, SQUARE + 2, SQUARE + 4]
    points[[5, 7, 7], [2, 0, 1]] = broken
    with pytest.raises(InputError, match="2 points are NaN or infinite, the first at index 5; remove them"):
        check_points(points)


def test_infinities_of_both_signs_are_counted():
    with pytest.raises(InputError, match="2 points are NaN or infinite, the first at index 1"):
        check_points(np.r_[SQUARE[:1], [[np.inf, 0, 0], [0, -np.inf, 0]], SQUARE])


@pytest.mark.parametrize("place", [0.0, 5.4e6])
def test_points_that_are_all_the_same_are_refused(place):
    with pytest.raises(InputError, match="all 7 points are the same"):
        check_points(np.full((7, 3), place))


@pytest.mark.parametrize("direction", [(1, 0, 0), (0, 1e-9, 0), (1, -2, 3e6)])
@pytest.mark.parametrize("offset", [0.0, 1.0])
def test_points_on_one_line_are_refused(direction, offset):
    line = offset + np.outer([0, 1, 2, 5, 9], direction)
    with pytest.raises(InputError, match="all 5 points lie on one line, which bounds no surface"):
        check_points(line)


@given(clouds())
def test_good_points_come_back_unchanged(points):
    for given_points in (points, points.tolist(), np.asfortranarray(points)):
        checked = check_points(given_points)
        assert checked.flags.c_contiguous
        assert np.array_equal(checked, points)


@pytest.mark.parametrize("n", [5, 100, 10_001])
@pytest.mark.parametrize("odd", [1, -2])
def test_a_single_point_beside_a_line_is_enough_for_a_surface(n, odd):
    line = np.outer(np.arange(n), [1.0, 2, 3])
    line[odd] += [0, 0, 1]
    assert np.array_equal(check_points(line), line)


@pytest.mark.parametrize("scale", [1e-150, 1e-9, 1e9, 1e150])
def test_a_square_of_any_size_is_no_line(scale):
    assert np.array_equal(check_points(scale * SQUARE), scale * SQUARE)


@pytest.mark.parametrize(
    ("loop", "message"),
    [
        ([0, 1, 4, 9], "2 boundary entries name no point, the first is 4 at position 2; indices run from 0 to 3"),
        ([0, -1, 2], "1 boundary entries name no point, the first is -1 at position 1"),
        ([0, 1], "the boundary has 2 points; a loop needs at least 3"),
        ([0, 1, 0], "the boundary has 2 points"),
        (np.empty(0, int), "the boundary has 0 points"),
        ([0, 1, 2, 1, 3], "boundary points 1 are named more than once"),
        ([0, 1, 2, 3, 3, 2, 1], "boundary points 1, 2, 3 are named more than once"),
        ([0.0, 1.0, 2.0], r"the boundary has shape \(3,\) and type float64; a list of point indices is needed"),
        ([True, True, False, True], "type bool"),
        ([[0, 1, 2]], r"the boundary has shape \(1, 3\)"),
        (["a", "b", "c"], "type <U1"),
    ],
)
def test_wrong_loops_are_refused_with_the_culprit(loop, message):
    with pytest.raises(InputError, match=message):
        check_loop(loop, 4)


@pytest.mark.parametrize("dtype", [np.int32, np.uint8, np.int64])
def test_a_repeated_closing_entry_is_dropped(dtype):
    checked = check_loop(np.array([2, 0, 3, 2], dtype), 4)
    assert checked.tolist() == [2, 0, 3]
    assert checked.dtype == np.int64


def test_long_lists_of_culprits_are_cut_and_counted():
    assert name_some(np.arange(10)) == "0, 1, 2 and 7 more"
    assert name_some([4, 2, 1]) == "4, 2, 1"


@pytest.mark.parametrize("error", [InputError, SolveError, FormatError])
def test_all_errors_have_one_parent(error):
    assert issubclass(error, PointchartError)


@pytest.mark.parametrize("error", [InputError, SolveError, FormatError])
def test_errors_can_be_told_in_the_numbers_of_the_user(error):
    with pytest.raises(error, match=r"points 30, 10 hang on 20$"), points_called(np.array([10, 20, 30])):
        raise error("points {lost} hang on {through}", lost=[2, 0], through=1)


def test_an_error_without_points_keeps_its_message():
    with pytest.raises(InputError, match=r"k is \{3\}"), points_called(np.arange(3)):
        raise InputError("k is {3}")


@pytest.mark.parametrize("n", [0, 1, CHUNK, CHUNK + 1, 3 * CHUNK - 1])
def test_ranges_cover_every_point_once(n):
    visits = np.zeros(n, int)

    def visit(first, last):
        visits[first:last] += 1

    over_ranges(visit, n)
    assert (visits == 1).all()


def test_an_error_in_a_range_is_not_swallowed():
    def fail(first, last):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        over_ranges(fail, 1)


@given(seeds, st.sampled_from([2, 3]))
def test_morton_order_is_a_permutation_that_keeps_blocks_together(seed, dimensions):
    points = np.random.default_rng(seed).random((64, dimensions))
    points[0], points[1] = 0, 1
    order = morton_order(points)
    assert sorted(order.tolist()) == list(range(64))
    quarters = (points[order] > 0.5) @ (2 ** np.arange(dimensions))
    assert (np.diff(quarters) >= 0).all()
