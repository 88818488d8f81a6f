import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import seeds

from pointchart import InputError, PointchartError, largest_component, nearest, reconstruct, shapes, spacing
from pointchart.points.neighborhoods import from_pairs
from pointchart.points.parts import APART, check_one_piece, label_parts

SHEET, PIECE = shapes.relief(400, seed=1), shapes.disc(150, seed=2)
FAR = np.array([0, 0, 30.0])


def directed_graph(n, n_edges, rng):
    """Draw a graph on n points, some of them without edges."""
    ends = rng.integers(0, n, (n_edges, 2))
    ends = np.unique(ends[ends[:, 0] != ends[:, 1]], axis=0)
    return from_pairs(ends[:, 0], ends[:, 1], n)


def parts_one_by_one(points, around, step):
    """Gather the parts by following edges of ten spacings at either end at most, either way."""
    beside = {i: set() for i in range(around.n_points)}
    for i, j in zip(around.rows.tolist(), around.indices.tolist(), strict=True):
        if np.linalg.norm(points[i] - points[j]) <= APART * min(step[i], step[j]):
            beside[i].add(j)
            beside[j].add(i)
    parts, seen = [], set()
    for start in beside:
        part, todo = set(), [start]
        while todo:
            i = todo.pop()
            if i not in seen:
                seen.add(i)
                part.add(i)
                todo += beside[i]
        parts += [part] if part else []
    return parts


def check(points):
    around = nearest(points, 20)
    check_one_piece(points, around, spacing(points, around=around))


@settings(max_examples=30)
@given(st.integers(1, 40), st.integers(0, 80), seeds)
def test_labels_are_those_of_the_parts_that_short_edges_join_either_way_the_largest_first(n, n_edges, seed):
    rng = np.random.default_rng(seed)
    points, step, around = rng.random((n, 3)), rng.uniform(0.02, 0.2, n), directed_graph(n, n_edges, rng)
    labels = label_parts(points, around, step)
    found = [set(np.flatnonzero(labels == k).tolist()) for k in range(labels.max() + 1)]
    assert sorted(map(sorted, found)) == sorted(map(sorted, parts_one_by_one(points, around, step)))
    assert [len(part) for part in found] == sorted(map(len, found), reverse=True)


@pytest.mark.parametrize(
    "scan", [SHEET, shapes.fold(2), shapes.grade(shapes.disc(1000), ratio=100), shapes.dumbbell(600, neck=2)]
)
def test_points_in_one_piece_pass(scan):
    check(scan.points)


@pytest.mark.parametrize(
    ("sizes", "shown"),
    [
        ([40, 30], "2 separate parts, of 40 and 30 points"),
        ([25, 28, 30, 26, 24, 27], "6 .* of 30 and 28 and 27 and 26 ."),
    ],
)
def test_separate_parts_are_told_with_their_sizes_and_a_point_of_each(sizes, shown):
    points = np.concatenate([shapes.disc(n, seed=k).points + k * FAR for k, n in enumerate(sizes)])
    part_of = np.repeat(np.arange(len(sizes)), sizes)
    with pytest.raises(InputError, match=f"the points fall into {shown}.*; take the largest, or take them ") as caught:
        check(points)
    assert [sizes[part_of[i]] for i in caught.value.points["seeds"]] == sorted(sizes, reverse=True)


@pytest.mark.parametrize("scale", [1.0, 1e-5, 3e4])
def test_a_stray_is_a_part_of_its_own_from_ten_spacings_on_and_never_of_the_largest(scale):
    sheet = shapes.grid(21, 21).points
    joined, apart = (scale * np.r_[sheet, [[10, 10, factor * APART]]] for factor in (0.999, 1.001))
    check(joined)
    assert np.array_equal(largest_component(joined), np.arange(441))
    with pytest.raises(InputError, match="2 separate parts, of 441 and 1 points") as caught:
        check(apart)
    assert caught.value.points["seeds"][1] == 441
    assert np.array_equal(largest_component(apart), np.arange(441))


@pytest.mark.parametrize("n_strays", [1, 5, 19])
def test_strays_too_few_to_be_neighbours_of_each_other_alone_are_left_out(n_strays):
    strays = FAR + np.random.default_rng(n_strays).uniform(-5, 5, (n_strays, 3))
    assert np.array_equal(largest_component(np.r_[strays, SHEET.points]), np.arange(n_strays, n_strays + 400))


@pytest.mark.parametrize("seed", range(3))
def test_the_largest_part_is_found_by_its_rows_in_ascending_order(seed):
    points = np.r_[PIECE.points - FAR, SHEET.points, PIECE.points + FAR]
    order = np.random.default_rng(seed).permutation(len(points))
    rows = largest_component(points[order])
    assert (np.diff(rows) > 0).all()
    assert np.array_equal(np.sort(order[rows]), np.arange(150, 550))


def test_a_scan_in_one_piece_is_its_own_largest_part():
    assert np.array_equal(largest_component(SHEET.points), np.arange(400))


def test_rows_that_repeat_a_point_belong_to_its_part_and_make_it_no_larger():
    points = np.r_[SHEET.points, np.repeat(PIECE.points + FAR, 5, axis=0), SHEET.points[:7]]
    assert np.array_equal(largest_component(points), np.r_[np.arange(400), np.arange(1150, 1157)])


@settings(max_examples=10)
@given(st.floats(-6, 6), st.tuples(*[st.floats(-1e4, 1e4)] * 3))
def test_unit_and_offset_do_not_change_the_largest_part(exponent, shift):
    points = np.r_[PIECE.points, SHEET.points + FAR]
    moved = 10.0**exponent * (points + shift)
    assert np.array_equal(largest_component(moved), np.arange(150, 550))


def test_the_largest_part_alone_is_reconstructed_where_the_whole_scan_is_refused():
    points = np.r_[SHEET.points, PIECE.points + FAR]
    with pytest.raises(PointchartError, match="2 separate parts, of 400 and 150 points"):
        reconstruct(points)
    result = reconstruct(points[largest_component(points)])
    assert result.certificate.is_disc
    assert len(result.rows) == 400


def test_points_that_are_not_finite_are_refused():
    with pytest.raises(InputError, match="1 points are NaN or infinite, the first at index 3"):
        largest_component(np.where(np.arange(400)[:, None] == 3, np.inf, SHEET.points))


@pytest.mark.parametrize("n_strays", [1, 20])
def test_strays_over_ten_spacings_away_are_a_part_however_few_they_are(n_strays):
    strays = SHEET.points.mean(axis=0) + [0, 0, 14 * SHEET.spacing] + 0.1 * SHEET.points[:n_strays] * SHEET.spacing
    points = np.r_[SHEET.points, strays]
    assert np.array_equal(largest_component(points), np.arange(400))
    with pytest.raises(InputError, match=f"2 separate parts, of 400 and {n_strays} points"):
        reconstruct(points)


def test_links_join_up_to_ten_spacings_of_the_denser_end():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [11, 0, 0], [21, 1, 0]])
    assert label_parts(points, nearest(points, 3), np.array([1.0, 1, 4, 4])).tolist() == [0, 0, 0, 0]
    assert label_parts(points, nearest(points, 3), np.array([0.9, 0.9, 4, 4])).tolist() == [0, 0, 1, 1]


def frame_with_flying_pixels(seed, share=0.04):
    """See a ball from a point, 40 by 40 rays, some of those near its rim lengthened; return points and which were."""
    draw = np.random.default_rng(seed)
    across = np.linspace(-0.3, 0.3, 40)
    rays = np.stack([*np.meshgrid(across, across), np.ones((40, 40))], axis=-1).reshape(-1, 3)
    middle, radius = np.array([0.0, 0.0, 1.2]), 0.3
    square, along = np.einsum("ij,ij->i", rays, rays), rays @ middle
    inside = along**2 - square * (middle @ middle - radius**2)
    hit = inside > 0
    points = rays[hit] * ((along - np.sqrt(np.maximum(inside, 0))) / square)[hit, None]
    near_rim = np.argsort(inside[hit])[: int(3 * share * hit.sum())]
    flying = draw.choice(near_rim, int(share * hit.sum()), replace=False)
    points[flying] *= 1.0 + draw.uniform(0.1, 1.0, (len(flying), 1))
    return points, flying


@pytest.mark.parametrize("seed", range(4))
def test_flying_pixels_do_not_become_the_boundary(seed):
    points, flying = frame_with_flying_pixels(seed)
    with pytest.raises(PointchartError):
        reconstruct(points)
    rows = largest_component(points)
    assert len(np.intersect1d(rows, flying)) <= 3, "those that are within the spacing of the rim"
    assert len(rows) >= len(points) - len(flying)
    made = reconstruct(points[rows])
    assert made.certificate.is_disc
    assert made.certificate.longest_edge_over_spacing < 4


@pytest.mark.parametrize(
    "points",
    [
        shapes.grade(shapes.disc(1000), ratio=1000).points,
        np.r_[shapes.disc(900).points, 0.2 * shapes.disc(6000).points + [0.01, 0.01, 0]],
    ],
    ids=["graded", "a finer scan within a coarser one"],
)
def test_sparse_regions_of_a_surface_are_kept(points):
    assert len(largest_component(points)) == len(points)
