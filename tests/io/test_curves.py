"""Curves through points, as PLY with an edge element."""

import numpy as np
import pytest
import trimesh
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from pointchart.errors import FormatError, InputError
from pointchart.io import read_scan, write_curves, write_mesh

doubles = st.floats(allow_nan=False, allow_infinity=False)
per_example = settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
POINTS = np.array([[0.1, 0.2, 0.3], [1e-300, -1e300, 1 / 3], [500000.1234567, 5400000.7654321, 8.0], [1, 2, 4.5]])


@st.composite
def points_and_loops(draw):
    """Draw points, and up to three loops through some of them that share none; most points lie on no loop."""
    points = draw(arrays(float, st.tuples(st.integers(4, 12), st.just(3)), elements=doubles))
    order = draw(st.permutations(range(len(points))))
    cuts = draw(st.lists(st.sampled_from([3, 4]), max_size=3))
    loops, start = [], 0
    for size in cuts:
        if start + size <= len(order):
            loops.append(np.array(order[start : start + size]))
        start += size
    return points, loops


def header_of(path):
    return path.read_bytes().split(b"end_header\n")[0].decode().split("\n")


def edges_of(path):
    """Read the edges that stand behind the vertices: the last bytes of the file."""
    n_edges = int(next(line for line in header_of(path) if line.startswith("element edge")).split()[2])
    content = path.read_bytes()
    return np.frombuffer(content, "<i4", 2 * n_edges, len(content) - 8 * n_edges).reshape(-1, 2)


@given(drawn=points_and_loops())
@per_example
def test_points_come_back_to_the_last_digit_and_each_loop_as_a_closed_polyline(tmp_path, drawn):
    points, loops = drawn
    path = tmp_path / "curves.ply"
    assert write_curves(path, points, loops) == []
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points, points)
    assert (scan.triangles.shape, scan.attributes) == ((0, 3), {})
    expected = [(int(i), int(j)) for loop in loops for i, j in zip(loop, np.roll(loop, -1), strict=True)]
    assert [tuple(edge) for edge in edges_of(path).tolist()] == expected


def test_the_header_declares_edges_between_vertices_and_no_faces(tmp_path):
    path = tmp_path / "curves.ply"
    write_curves(path, POINTS, [np.array([2, 0, 1])], attributes={"score": np.zeros(4)})
    assert header_of(path)[3:-1] == [
        "element vertex 4",
        "property double x",
        "property double y",
        "property double z",
        "property double score",
        "element edge 3",
        "property int vertex1",
        "property int vertex2",
    ]
    assert edges_of(path).tolist() == [[2, 0], [0, 1], [1, 2]]


def test_another_library_reads_the_same_curves(tmp_path):
    path = tmp_path / "curves.ply"
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 2]])
    write_curves(path, square, [np.array([3, 2, 1, 0])])
    curves = trimesh.load(path, process=False)
    assert isinstance(curves, trimesh.path.Path3D)
    sides = np.concatenate([entity.nodes for entity in curves.entities])
    assert sorted(np.sort(sides, axis=1).tolist()) == [[0, 1], [0, 3], [1, 2], [2, 3]]
    np.testing.assert_array_equal(curves.vertices, square)


def test_points_without_loops_have_no_edges(tmp_path):
    path = tmp_path / "curves.ply"
    write_curves(path, POINTS, [])
    assert "element edge 0" in header_of(path)
    np.testing.assert_array_equal(read_scan(path).points, POINTS)


def test_a_mesh_has_no_edge_element(tmp_path):
    path = tmp_path / "mesh.ply"
    write_mesh(path, POINTS, np.array([[0, 1, 2]]))
    assert not any(line.startswith("element edge") for line in header_of(path))


def test_attributes_come_back_with_order_dtype_and_value_and_coordinates_win_over_them(tmp_path):
    path = tmp_path / "curves.ply"
    attributes = {
        "u": np.arange(4.0),
        "loop": np.array([1, 1, 1, 0], np.int32),
        "red": np.array([0, 255, 3, 4], np.uint8),
        "score_total": np.array([0.0, 1 / 3, 1e-300, 1.0]),
    }
    assert write_curves(path, POINTS, [np.arange(3)], attributes={"x": np.zeros(4), **attributes}) == []
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points, POINTS)
    assert list(scan.attributes) == list(attributes)
    for name, column in attributes.items():
        assert scan.attributes[name].dtype == column.dtype
        np.testing.assert_array_equal(scan.attributes[name], column)


def test_integers_that_no_ply_type_holds_are_noted(tmp_path):
    (note,) = write_curves(tmp_path / "curves.ply", POINTS, [], attributes={"id": np.array([0, 1, 2, 2**62])})
    assert note == "PLY has no type for id (int64), so 1 of its values are rounded to double."


@pytest.mark.parametrize("suffix", [".obj", ".npz", ".txt", ""])
def test_curves_are_written_to_ply_only(tmp_path, suffix):
    with pytest.raises(FormatError, match=f"the suffix '{suffix}' cannot be written here; choose one of .ply"):
        write_curves(tmp_path / f"curves{suffix}", POINTS, [np.arange(3)])
    assert not list(tmp_path.iterdir())


def test_arrays_of_the_wrong_length_are_refused(tmp_path):
    with pytest.raises(InputError, match=r"attribute loop has shape \(5,\) where 4 points need \(4,\)"):
        write_curves(tmp_path / "curves.ply", POINTS, [], attributes={"loop": np.zeros(5)})
    with pytest.raises(InputError, match=r"points have shape \(4, 2\) where \(4, 3\) is due"):
        write_curves(tmp_path / "curves.ply", POINTS[:, :2], [])
    assert not list(tmp_path.iterdir())


def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path, full_disk):
    path = tmp_path / "curves.ply"
    path.write_text("old")
    with pytest.raises(FormatError, match=r"cannot be written \(No space left on device\); free the disk"):
        write_curves(path, POINTS, [np.arange(3)])
    assert [entry.name for entry in tmp_path.iterdir()] == ["curves.ply"]
    assert path.read_text() == "old"


def test_writing_into_a_missing_folder_is_one_sentence(tmp_path):
    with pytest.raises(FormatError, match=r"cannot be written \(No such file or directory\)"):
        write_curves(tmp_path / "none" / "curves.ply", POINTS, [np.arange(3)])
