import numpy as np
import pytest
from comparisons import farthest
from hypothesis import given, settings
from hypothesis import strategies as st
from scans import SMOOTH
from scipy.spatial import cKDTree
from strategies import clouds, planar_discs, rotations, seeds

from pointchart import InputError, boundary_scores, delaunay_star, explore, find_boundary, nearest, shapes, spacing
from pointchart.agreement.agreed_surface import collect_agreed
from pointchart.boundary.scores import corner_angles

PARTS = ["gap", "half_disc", "width", "uncovered"]


def scores_of(points, k=20):
    """Score points without smoothing them or breaking ties."""
    around, step = nearest(points, k), spacing(points)
    star = delaunay_star(points, nearest(points, 20))
    return boundary_scores(points, around, star, collect_agreed(points, star, step).triangles, step)


def depths(sheet, nx, ny):
    """Return how far the points of a grid lie from its nearer edge, and from the next one."""
    edges = np.c_[
        np.minimum(sheet.uv[:, 0], nx - 1 - sheet.uv[:, 0]), np.minimum(sheet.uv[:, 1], ny - 1 - sheet.uv[:, 1])
    ]
    return np.sort(edges, axis=1).T


def test_scores_of_a_grid_are_nothing_inside_and_full_on_a_straight_edge_and_at_a_corner():
    sheet = shapes.grid(21, 17)
    vicinity = explore(sheet.points)
    agreed = collect_agreed(vicinity.smoothed, vicinity.star, vicinity.spacing).triangles
    scores = boundary_scores(vicinity.smoothed, vicinity.around, vicinity.star, agreed, vicinity.spacing)
    near, far = depths(sheet, 21, 17)
    inside, edge, corner = near >= 2, (near == 0) & (far >= 4), far == 0
    for part in ("half_disc", "width", "uncovered"):
        assert getattr(scores, part)[inside] == pytest.approx(0, abs=1e-12)
    # The twenty nearest on a grid leave atan(1/2) free at most, spread evenly a tenth of pi.
    assert scores.gap[inside] == pytest.approx((np.arctan(0.5) - 0.1 * np.pi) / (0.9 * np.pi))
    for part in ("gap", "width", "uncovered"):
        assert getattr(scores, part)[edge] == pytest.approx(1)
    for part in PARTS:
        assert getattr(scores, part)[corner] == pytest.approx(1)
    assert np.array_equal(scores.is_boundary, near == 0)


@pytest.mark.parametrize("name", SMOOTH)
def test_the_scores_of_an_even_sampling_tell_its_boundary_exactly(name):
    shape = SMOOTH[name]()
    scores = find_boundary(shape.points).scores
    on_edge = np.isin(np.arange(len(shape.points)), shape.boundary)
    assert np.array_equal(scores.is_boundary, on_edge)
    assert scores.total[on_edge].min() > 0.8
    assert scores.total[~on_edge].max() < 0.4
    for part in ("width", "uncovered"):
        assert getattr(scores, part)[on_edge].min() > 0.9


def test_the_centroid_of_neighbours_on_an_edge_nears_that_of_half_a_disc_with_the_spacing_over_its_radius():
    radii, missing = np.array([5, 10, 20]), []
    for radius in radii:
        sheet, middle = shapes.grid(4 * radius + 1, 2 * radius + 1), 2 * radius
        # As many as lie in half a disc, so that no other ones are as near as the last.
        count = (np.linalg.norm(sheet.points - sheet.points[middle], axis=1) <= radius).sum() - 1
        missing.append(1 - scores_of(sheet.points, int(count)).half_disc[middle])
    assert np.polyfit(np.log(radii), np.log(missing), 1)[0] == pytest.approx(-1, abs=0.1)


@pytest.mark.parametrize(
    ("apart", "width"), [(1, 0), (np.sqrt(3), 0), (2, np.sqrt(5) / 2 - 1), (3, np.sqrt(10) / 2 - 1)]
)
def test_the_width_is_the_circumradius_of_the_star_beyond_one_spacing(apart, width):
    sheet = shapes.grid(21, 9)
    points = sheet.points * [1, apart, 1]
    star = delaunay_star(points, nearest(points, 60))
    scores = boundary_scores(points, nearest(points, 20), star, sheet.triangles, np.ones(len(points)))
    middle = 4 * 21 + 10
    assert scores.width[middle] == pytest.approx(width, abs=1e-9)


@given(planar_discs(smallest=60))
@settings(max_examples=10)
def test_inside_a_planar_disc_nothing_is_uncovered_and_no_star_wide(shape):
    scores = boundary_scores(
        shape.points,
        nearest(shape.points, 20),
        delaunay_star(shape.points, nearest(shape.points, 30)),
        shape.triangles,
        spacing(shape.points),
    )
    on_edge = np.isin(np.arange(len(shape.points)), shape.boundary)
    assert np.abs(scores.uncovered[~on_edge]).max(initial=0) < 1e-9
    assert scores.uncovered[on_edge] == pytest.approx(1)
    assert scores.width[on_edge] == pytest.approx(1)


@given(clouds(smallest=60))
@settings(max_examples=10)
def test_scores_lie_between_none_and_one_and_their_total_is_their_mean(points):
    scores = scores_of(points)
    parts = np.array([getattr(scores, part) for part in PARTS])
    assert parts.min() >= 0
    assert parts.max() <= 1
    assert scores.total == pytest.approx(parts.mean(axis=0))
    assert np.array_equal(scores.is_boundary, scores.total >= 0.5)


@given(clouds(smallest=60), rotations(), st.floats(-6, 6), seeds)
@settings(max_examples=10)
def test_scores_do_not_depend_on_pose_scale_and_numbering(points, rotation, exponent, seed):
    order = np.random.default_rng(seed).permutation(len(points))
    moved = 10.0**exponent * (points[order] @ rotation.T + 1)
    still, others = scores_of(points), scores_of(moved)
    for part in PARTS:
        assert getattr(others, part) == pytest.approx(getattr(still, part)[order], abs=1e-6)


@pytest.mark.parametrize("sigma", [0.25, 0.5])
def test_scores_of_smoothed_points_tell_the_edge_from_the_inside_through_noise(sigma):
    shape = shapes.relief(1500, seed=3)
    noisy = shapes.add_noise(shape, sigma_in_spacings=sigma, seed=3).points
    scoring = shape.points[find_boundary(noisy).scores.is_boundary]
    edge = shape.points[shape.boundary]
    assert np.quantile(cKDTree(edge).query(scoring)[0], 0.95) < 2 * shape.spacing
    assert farthest(edge, scoring) < 2 * shape.spacing


@pytest.mark.parametrize(
    ("shape", "euler"), [(shapes.sphere(300), 2), (shapes.torus(24, 12), 0)], ids=["sphere", "torus"]
)
def test_the_angles_that_a_closed_mesh_lacks_add_up_to_its_euler_characteristic_in_turns(shape, euler):
    lacking = 2 * np.pi - corner_angles(shape.points, shape.triangles)
    assert lacking.sum() == pytest.approx(2 * np.pi * euler, abs=1e-9)


def test_the_angles_round_inner_points_of_a_plane_are_a_full_turn(any_disc):
    flat = np.c_[any_disc.uv, np.zeros(len(any_disc.uv))]
    inner = np.setdiff1d(np.arange(len(flat)), any_disc.boundary)
    assert corner_angles(flat, any_disc.triangles)[inner] == pytest.approx(2 * np.pi, abs=1e-6)


def test_scores_need_stars():
    sheet = shapes.grid(6, 5)
    around = nearest(sheet.points, 8)
    with pytest.raises(InputError, match="the neighbourhoods are no stars, so they have no width; use Delaunay stars"):
        boundary_scores(sheet.points, around, around, sheet.triangles, spacing(sheet.points))
