import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from pointchart import InputError, ball, delaunay_star, mean_value, nearest, reciprocal_distance, shapes
from pointchart.app.frame import Frame, coarser, shades, spacing, stance, thinned
from pointchart.app.frame_rate import TRIALS, Pace
from pointchart.app.loop_by_hand import LoopByHand, dropped, inserted, nearest_of
from pointchart.app.one_neighborhood import around_point
from pointchart.app.picking import Camera, nearest_to_ray, project, unproject, visible
from pointchart.app.window_fit import DISTANCE, Whole, whole_distance
from pointchart.boundary import is_same_loop, perimeter, reversed_loop
from pointchart.plane.polygons import is_inside

RELIEF = shapes.relief(400, seed=2)
CAMERA = Camera(np.array([0.2, -0.1, 4.0]), np.diag([1.0, -1.0, -1.0]), fov=0.8, aspect=1.5)
HAIR = 1e-9  # radians
coordinates = st.floats(-8.0, 8.0, allow_nan=False).map(lambda x: round(x, 3))


def looking_at_the_origin(place):
    ahead = -np.asarray(place, float) / np.linalg.norm(place)
    right = np.cross(ahead, [0.3, -0.2, 0.9])
    right /= np.linalg.norm(right)
    return Camera(np.asarray(place, float), np.stack([right, np.cross(ahead, right), ahead]), fov=0.8, aspect=1.5)


@pytest.mark.parametrize("row", range(0, 400, 57))
def test_a_click_where_a_point_is_seen_finds_it(row):
    place = project(RELIEF.points[row : row + 1], CAMERA)[0]
    assert (
        nearest_to_ray(
            RELIEF.points, CAMERA.position, unproject(place[None], CAMERA, 1.0)[0] - CAMERA.position, aim=HAIR
        )
        == row
    )


@given(arrays(float, (12, 3), elements=coordinates), arrays(float, 3, elements=coordinates))
def test_the_point_found_is_the_nearest_to_the_ray_of_all_points_when_all_are_in_one_layer(points, direction):
    if np.linalg.norm(direction) < 0.1:
        return
    ray = direction / np.linalg.norm(direction)
    layer = points - (points @ ray)[:, None] * ray + 30.0 * ray
    found = nearest_to_ray(layer, np.zeros(3), direction, aim=1.5)
    beside = np.linalg.norm(layer - (layer @ ray)[:, None] * ray, axis=1)
    assert beside[found] == pytest.approx(beside.min(), abs=1e-6)


def test_of_two_sheets_the_one_in_front_is_hit():
    sheet = np.array([[0.01, 0, 0], [0, 0.02, 0], [5, 5, 0]])
    both = np.concatenate([sheet - [0, 0, 3], sheet])
    assert nearest_to_ray(both, [0, 0, 9.0], [0, 0, -1.0]) == 3


def test_a_click_beside_the_cloud_or_with_all_of_it_behind_hits_nothing():
    assert nearest_to_ray(RELIEF.points, CAMERA.position, [1, 0, 0]) is None
    assert nearest_to_ray(RELIEF.points, CAMERA.position, [0, 0, 1]) is None


def test_points_as_large_as_they_are_drawn_are_hit_over_all_their_size():
    point = np.array([[0.3, 0.0, 0.0]])
    assert nearest_to_ray(point, [0, 0, 1.0], [0, 0, -1.0]) is None
    assert nearest_to_ray(point, [0, 0, 1.0], [0, 0, -1.0], reach=0.31) == 0


@pytest.mark.parametrize("place", [(4, 0, 0), (-1, 2, 3), (0.5, -1.5, 0), (0, 0.3, 1.3), (1.15, 0, 0)])
def test_of_a_sphere_the_points_before_its_horizon_are_seen(place):
    """The horizon of the unit sphere from a distance d is where the cosine to the line of sight is 1 / d."""
    height, around = 1.0 - 2.0 * (np.arange(20_000) + 0.5) / 20_000, np.pi * (1.0 + 5.0**0.5) * np.arange(20_000)
    flat = np.sqrt(1.0 - height**2)
    sphere = np.column_stack([flat * np.cos(around), flat * np.sin(around), height])
    distance, some = float(np.linalg.norm(place)), sphere[::40]
    beyond = some @ place / distance - 1.0 / distance
    is_seen = visible(sphere, some, np.array(place), spacing=np.sqrt(4.0 * np.pi / 20_000))
    assert is_seen[beyond > 0.1].all()
    assert not is_seen[beyond < -0.1].any()


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e4])
@pytest.mark.parametrize("near", [0.2, 1.0, 2.0])
def test_a_sheet_hides_what_is_behind_it_and_nothing_beside_it(unit, near):
    front = np.column_stack([shapes.grid(30, 30).points[:, :2] / 29.0 - 0.5, np.full(900, 1.0)]) * near
    back = np.column_stack([shapes.grid(41, 41).points[:, :2] / 10.0 - 2.0, np.full(1681, 3.0)])
    both = unit * np.concatenate([front, back])
    is_seen = visible(both, both, np.zeros(3), spacing=unit * near / 29.0)
    aside = np.abs(back[:, :2]).max(axis=1) / 3.0 - 0.5
    assert is_seen[:900].all()
    assert not is_seen[900:][aside < -0.02].any()
    assert is_seen[900:][aside > 0.05].all()


@pytest.mark.parametrize("slant", [0, 40, 75])
def test_a_surface_seen_at_a_slant_does_not_hide_itself(slant):
    down = np.radians(slant)
    sheet = (shapes.grid(40, 40).points / 39.0 - [0.5, 0.5, 0.0]) @ np.array(
        [[1, 0, 0], [0, np.cos(down), np.sin(down)], [0, -np.sin(down), np.cos(down)]]
    )
    assert visible(sheet, sheet, np.array([0, 0, -3.0]), spacing=1 / 39.0).all()


def test_of_no_places_none_is_seen():
    assert visible(RELIEF.points, np.empty((0, 3)), np.zeros(3), spacing=0.1).shape == (0,)


@given(arrays(float, (6, 2), elements=st.floats(0.0, 1.0)), st.floats(0.1, 100.0))
def test_points_are_seen_where_they_were_put(places, depth):
    camera = looking_at_the_origin((3, 1, 2))
    assert project(unproject(places, camera, depth), camera) == pytest.approx(places, abs=1e-9)


def test_points_behind_the_camera_are_in_no_polygon():
    screen = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    behind = project(np.array([[0.2, -0.1, 9.0], [0.2, -0.1, 0.0]]), CAMERA)
    assert is_inside([screen], behind).tolist() == [False, True]


@pytest.mark.parametrize("place", [0, 10, 40, len(RELIEF.boundary) - 1])
def test_a_point_dropped_and_inserted_again_is_where_it_was(place):
    loop = np.asarray(RELIEF.boundary)
    mended = inserted(RELIEF.points, dropped(loop, loop[place]), loop[place])
    assert is_same_loop(mended, loop)


@given(st.sets(st.integers(0, 399), max_size=12))
def test_insertion_keeps_the_loop_and_takes_each_point_once(rows):
    loop = np.asarray(RELIEF.boundary)
    longer = inserted(RELIEF.points, loop, sorted(rows))
    assert sorted(longer) == sorted(set(loop) | rows)
    assert np.array_equal(longer[np.isin(longer, loop)], loop)


@pytest.mark.parametrize("row", [200, 303])
def test_a_point_is_inserted_where_it_lengthens_the_loop_least(row):
    loop = np.asarray(RELIEF.boundary)
    lengths = [perimeter(RELIEF.points, np.insert(loop, k, row)) for k in range(len(loop))]
    assert perimeter(RELIEF.points, inserted(RELIEF.points, loop, row)) == pytest.approx(min(lengths))


def test_a_loop_is_begun_from_nothing_point_by_point():
    loop = np.empty(0, np.int64)
    for row in (5, 3, 9):
        loop = inserted(RELIEF.points, loop, row)
    assert is_same_loop(loop, np.array([5, 3, 9]))


def test_a_loop_by_hand_is_undone_step_by_step_to_where_it_began():
    hand = LoopByHand(400, RELIEF.boundary)
    assert hand.is_own
    hand.begin(np.array([3, 1, 2]))
    assert not hand.is_own
    hand.change(np.array([3, 1, 2]))
    hand.change(np.array([3, 1]))
    for _ in range(2):
        hand.undo()
    assert np.array_equal(hand.loop, RELIEF.boundary)
    with pytest.raises(InputError, match="there is no loop before this one"):
        hand.undo()


def test_a_loop_of_other_points_is_refused():
    with pytest.raises(InputError, match="indices run from 0 to 39"):
        LoopByHand(40, RELIEF.boundary)
    with pytest.raises(InputError, match="the loop has 0 points"):
        nearest_of(RELIEF.points, np.empty(0, np.int64), 3)


@pytest.mark.parametrize(
    ("connect", "scheme", "reach"),
    [
        (lambda points: ball(points, 0.4), reciprocal_distance, {"radius": 0.4}),
        (lambda points: nearest(points, 12), reciprocal_distance, {"k": 12}),
        (lambda points: delaunay_star(points, nearest(points, 20)), mean_value, {"k": 20}),
    ],
    ids=["ball", "nearest", "star"],
)
@pytest.mark.parametrize("center", [0, 77, 399])
def test_neighbours_of_one_point_are_those_that_all_points_give(connect, scheme, reach, center):
    offset = np.array([5e5, 4e6, 100.0])
    one = around_point(RELIEF.points + offset, center, connect, scheme, **reach)
    whole = connect(RELIEF.points)
    row = slice(whole.indptr[center], whole.indptr[center + 1])
    weights = scheme(RELIEF.points, whole)[row]
    order, other = np.argsort(one.neighbors), np.argsort(whole.indices[row])
    assert np.array_equal(one.neighbors[order], whole.indices[row][other])
    assert one.weights[order] == pytest.approx(weights[other], rel=1e-5)
    assert one.weights.sum() == pytest.approx(1.0)


@pytest.mark.parametrize("k", [400, 501, 10**9])
def test_more_neighbours_than_can_be_shown_are_refused_before_any_is_looked_for(k):
    points = RELIEF.points if k < 500 else np.tile(RELIEF.points, (3, 1))
    with pytest.raises(InputError, match=rf"k is {k}, but of {len(points)} points at most \d+ neighbours are shown"):
        around_point(points, 77, None, None, k=k)


def test_a_ball_that_holds_too_many_points_is_refused_with_their_number():
    points = np.tile(RELIEF.points, (6, 1))
    with pytest.raises(InputError, match=r"radius 1e\+30 around point 77 holds 2400 points, and at most 2000"):
        around_point(points, 77, None, None, radius=1e30)


def test_too_small_a_ball_is_refused_with_the_rows_of_the_scan():
    with pytest.raises(InputError, match=r"the radius leaves points .*77"):
        around_point(RELIEF.points, 77, lambda points: ball(points, 1e-6), reciprocal_distance, radius=1e-6)


@pytest.mark.parametrize("offset", [0.0, 5e6])
def test_places_on_the_page_keep_shapes_at_any_offset(offset):
    places = Frame(RELIEF.points + offset).places(RELIEF.points + offset)
    assert places.dtype == np.float32
    scale = np.linalg.norm(np.ptp(places, axis=0)) / np.linalg.norm(np.ptp(RELIEF.points, axis=0))
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    assert steps == pytest.approx(scale * np.linalg.norm(np.diff(RELIEF.points, axis=0), axis=1), rel=1e-4, abs=1e-5)


@pytest.mark.parametrize("up", [None, "x", "y", "z"])
@pytest.mark.parametrize("order", [[0, 1, 2], [0, 2, 1], [2, 1, 0]])
@pytest.mark.parametrize("side", [1, -1])
def test_however_a_patch_lies_it_stands_on_the_axis_asked_for_and_is_seen_from_the_front_and_above(up, order, side):
    axes, facing = stance(side * RELIEF.points[:, order], up)
    assert axes @ axes.T == pytest.approx(np.eye(3))
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert up is None or axes[2] == pytest.approx(np.eye(3)["xyz".index(up)])
    assert facing[0] == 0.0
    assert facing[1] <= -0.5 + 1e-9
    assert facing[2] >= 0.0


def test_a_level_patch_and_a_wall_are_both_seen_from_their_broad_side():
    for points in (RELIEF.points, RELIEF.points[:, [0, 2, 1]] * [1, -1, 1]):
        axes, facing = stance(points)
        assert np.ptp(points @ (facing @ axes)) < 1.2
        assert facing[1] < -0.85


@pytest.mark.parametrize("angle", [10, 90, 170])
@pytest.mark.parametrize("unit", [1e-3, 1e3])
def test_the_spacing_is_that_of_the_surface_however_it_is_bent(angle, unit):
    cap = shapes.hemisphere(3000, angle=angle).points * unit
    area = 2.0 * np.pi * (1.0 - np.cos(np.deg2rad(angle))) * unit**2
    assert spacing(cap, nearest(cap, 12)) == pytest.approx(np.sqrt(area / 3000), rel=0.25)


def test_from_far_away_the_near_half_of_a_closed_surface_is_seen_and_no_point_behind_it():
    ball = shapes.hemisphere(4000, angle=170).points
    eye = np.array([30.0, 0.0, 0.0])
    is_seen = visible(ball, ball, eye, spacing=spacing(ball, nearest(ball, 12)))
    assert is_seen[ball[:, 0] > 0.2].all()
    assert not is_seen[ball[:, 0] < -0.2].any()


def test_large_clouds_and_meshes_are_thinned_and_small_ones_are_not():
    assert np.array_equal(thinned(400, 400), np.arange(400))
    assert len(np.unique(thinned(4000, 400))) == 400
    places = RELIEF.points.astype(np.float32)
    assert coarser(places, RELIEF.triangles, 735)[1] is RELIEF.triangles
    fewer, triangles = coarser(places, RELIEF.triangles, 200)
    assert 40 < len(triangles) < 400
    assert triangles.max() < len(fewer)


def test_light_is_between_dark_and_full():
    upright = RELIEF.points / np.linalg.norm(RELIEF.points, axis=1)[:, None]
    assert 0.35 <= shades(upright).min() < shades(upright).max() <= 1.0


def test_boundary_points_of_no_order_become_the_boundary(any_disc):
    loop, (points, boundary) = np.asarray(any_disc.boundary), (any_disc.points, np.sort(any_disc.boundary))
    for begun in ([], [boundary[0]]):
        found = inserted(points, np.array(begun, int), boundary)
        assert is_same_loop(found, loop) or is_same_loop(found, reversed_loop(loop))


@pytest.mark.parametrize(
    ("waits", "last"),
    [
        ([0.3] * 6 + [0.07] * 40, True),
        ([0.02, 0.3] * 3 + [0.07] * 40, True),
        ([0.02] * 9 + [0.3] * 40, False),
        ([0.02, 0.02, 0.4] * 20, False),
        ([0.08] * 13, False),
        ([0.3] * 200, False),
        ([0.3] * 6 + [0.07] * 6 + [0.2] * 40, True),
    ],
    ids=[
        "slow",
        "slow, told in pairs",
        "fast, then a slow hand",
        "a hand that stops and goes",
        "a slow hand",
        "a hand that stays slow",
        "sure",
    ],
)
def test_a_browser_is_slow_if_less_to_draw_makes_it_faster_and_it_was_never_fast(waits, last):
    pace = Pace(print)
    told = [pace.note(now) for now in np.cumsum([0.0, *waits]).tolist()]
    assert told[-1] == last
    assert np.count_nonzero(np.diff(told)) <= 2 * TRIALS


@pytest.mark.parametrize("late", [0, 1, 2, 3])
def test_while_a_window_is_narrowed_the_whole_scan_stays_in_it_though_the_browser_answers_late(late):
    whole, told = Whole(), [DISTANCE] * (late + 1)
    for frame, aspect in enumerate([1.4, 0.8, 0.7, 0.6, 0.48, 0.48, 0.48, 0.48, 0.48]):
        told.append(whole.corrected(told[-1 - late], aspect, now=0.02 * frame) or told[-1])
    assert told[-1] == pytest.approx(whole_distance(0.48))


def test_who_has_come_nearer_stays_there():
    whole = Whole()
    assert whole.corrected(3.0, 1.4, now=0.0) is None
    assert whole.corrected(3.0, 0.5, now=0.1) is None
    assert whole.corrected(DISTANCE, 0.5, now=0.2) == whole_distance(0.5)
    assert whole.corrected(DISTANCE, 0.5, now=9.0) is None, "nearer than the whole by now"
