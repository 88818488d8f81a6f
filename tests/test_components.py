import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import seeds

from pointchart import InputError, PointchartError, largest_component, nearest, reconstruct, shapes
from pointchart.components import check_one_piece, label_parts
from pointchart.neighbors import from_pairs

SHEET, PIECE = shapes.relief(400, seed=1), shapes.disc(150, seed=2)
FAR = np.array([0, 0, 30.0])


def directed_graph(n, n_edges, seed):
    """Draw a graph on n points, some of them without edges."""
    ends = np.random.default_rng(seed).integers(0, n, (n_edges, 2))
    ends = np.unique(ends[ends[:, 0] != ends[:, 1]], axis=0)
    return from_pairs(ends[:, 0], ends[:, 1], n)


def parts_one_by_one(around):
    """Gather the parts by following the edges either way."""
    beside = {i: set() for i in range(around.n_points)}
    for i, j in zip(around.rows.tolist(), around.indices.tolist(), strict=True):
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


@settings(max_examples=30)
@given(st.integers(1, 40), st.integers(0, 50), seeds)
def test_labels_are_those_of_the_parts_that_edges_join_either_way_the_largest_first(n, n_edges, seed):
    around = directed_graph(n, n_edges, seed)
    labels = label_parts(around)
    found = [set(np.flatnonzero(labels == k).tolist()) for k in range(labels.max() + 1)]
    assert sorted(map(sorted, found)) == sorted(map(sorted, parts_one_by_one(around)))
    assert [len(part) for part in found] == sorted(map(len, found), reverse=True)


def test_points_in_one_piece_pass():
    check_one_piece(nearest(SHEET.points, 20))


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
    with pytest.raises(InputError, match=f"the points fall into {shown}") as caught:
        check_one_piece(nearest(points, 20))
    seeds_of = caught.value.points["seeds"]
    assert [sizes[part_of[i]] for i in seeds_of] == sorted(sizes, reverse=True)
    assert "mesh the largest (--component largest), or the parts one by one" in str(caught.value)


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
