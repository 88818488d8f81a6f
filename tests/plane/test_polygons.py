import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from matplotlib.path import Path
from strategies import seeds

from pointchart import InputError
from pointchart.plane.crossings import find_meetings, is_simple
from pointchart.plane.polygons import check_convex, check_polygon, is_inside, sides_at, signed_area
from pointchart.plane.vectors import cross

SQUARE = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
coordinates = st.floats(-8.0, 8.0, allow_nan=False).map(lambda x: round(x, 3))


@given(arrays(float, (30, 2), elements=coordinates), arrays(float, (6, 2), elements=coordinates))
def test_a_convex_polygon_holds_the_places_that_matplotlib_finds_in_it(places, cloud):
    from scipy.spatial import ConvexHull, QhullError

    try:
        polygon = cloud[ConvexHull(cloud).vertices]
    except QhullError:
        return
    path = Path(polygon)
    clear = path.contains_points(places, radius=1e-6) == path.contains_points(places, radius=-1e-6)
    assert np.array_equal(is_inside([polygon], places)[clear], path.contains_points(places)[clear])


def test_an_arrow_holds_the_places_between_its_wings_and_not_its_notch():
    arrow = np.array([[0, 0], [4, 2], [0, 4], [1, 2]])
    for corners in (arrow, arrow[::-1]):
        places = np.array([[2.0, 2], [0.4, 2], [0.3, 0.3], [-1, 2]])
        assert is_inside([corners], places).tolist() == [True, False, True, False]


@given(seeds)
def test_polygons_side_by_side_share_no_place_and_leave_none_out(seed):
    middle = np.random.default_rng(seed).random(2)
    triangles = [np.array([SQUARE[k], SQUARE[(k + 1) % 4], middle]) for k in range(4)]
    along = np.linspace(0.0, 1.0, 9)[:, None]
    places = np.concatenate([middle + along * (corner - middle) for corner in SQUARE])
    inside = [is_inside([triangle], places) for triangle in triangles]
    assert np.array_equal(np.sum(inside, axis=0), is_inside([SQUARE], places).astype(int))


def test_a_place_that_is_no_number_is_inside_of_nothing():
    assert is_inside([SQUARE], np.array([[np.nan, 0.5], [0.5, np.nan], [0.5, 0.5]])).tolist() == [False, False, True]


@given(seeds)
def test_the_area_inside_a_polygon_is_the_share_of_places_inside(seed):
    rng = np.random.default_rng(seed)
    angles = (np.arange(7) + 0.9 * rng.random(7)) * 2.0 * np.pi / 7
    polygon = (0.2 + 0.8 * rng.random((7, 1))) * np.column_stack([np.cos(angles), np.sin(angles)])
    ticks = (np.arange(200) + 0.5) / 100 - 1.0
    grid = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
    assert 1e-4 * is_inside([polygon], grid).sum() == pytest.approx(signed_area(polygon), abs=0.02)


@given(arrays(float, (6, 2), elements=st.integers(0, 4)))
def test_a_polygon_is_simple_unless_one_of_its_pieces_meets_another(polygon):
    behind, ahead = sides_at(polygon)
    # Sides that follow each other may fold back, which is not asked for.
    assume(((cross(behind, ahead) != 0.0) | ((behind * ahead).sum(axis=1) > 0.0)).all())
    assert is_simple(polygon) != find_meetings_of_all(polygon).any()


def find_meetings_of_all(polygon):
    """Find the sides that meet, each cut into so many pieces that none is long beside another."""
    n = 16
    share = np.arange(n)[:, None] / n
    places = np.concatenate([a + share * (b - a) for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True)])
    return find_meetings(places, np.roll(np.arange(len(places)), -1))


@pytest.mark.parametrize("gap", [0.0, 5e-324, 1e-200, 1e-17])
def test_a_side_that_touches_another_by_the_last_digit_is_found(gap):
    tongue = np.array([[-1.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, gap], [-1.0, 2.0]])
    assert is_simple(tongue) == (gap > 0.0)


@given(arrays(float, (2, 5, 2), elements=coordinates))
def test_a_cross_product_is_the_third_component_of_that_in_space(vectors):
    a, b = np.concatenate([vectors, np.zeros((2, 5, 1))], axis=2)
    assert np.array_equal(cross(*vectors), np.cross(a, b)[:, 2])


@pytest.mark.parametrize(
    "corners", [[[0, 0], [1, 0]], [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0], [1, 0], [0, np.nan]], [0, 1, 2]]
)
def test_what_is_no_polygon_is_refused(corners):
    with pytest.raises(InputError, match=r"the piece has shape .* at least 3 finite corners"):
        check_polygon("the piece", corners)


def test_only_a_strict_polygon_has_to_run_anticlockwise_and_turn_at_every_corner():
    flat = np.insert(SQUARE, 1, [0.5, 0.0], axis=0)
    assert len(check_convex(flat)) == len(check_convex(flat[::-1])) == 5
    for corners in (flat, SQUARE[::-1]):
        with pytest.raises(InputError, match=r"no convex polygon: .* anticlockwise"):
            check_convex(corners, is_strict=True)
    with pytest.raises(InputError, match="no convex polygon"):
        check_convex(SQUARE[[0, 2, 1, 3]])
