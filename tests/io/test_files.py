"""Laws of reading and writing that hold for every format, and the files that all formats refuse."""

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from pointchart.errors import FormatError, InputError
from pointchart.io import (
    MESH_SUFFIXES,
    READABLE_SUFFIXES,
    UV_SUFFIXES,
    check_output,
    read_loop,
    read_scan,
    replacing,
    write_loop,
    write_mesh,
    write_uv,
)

EXACT = (".ply", ".obj", ".off", ".npz")
doubles = st.floats(allow_nan=False, allow_infinity=False)
per_example = settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
needs_permissions = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="the superuser may read and write everything"
)

POINTS = np.array([[0.1, 0.2, 0.3], [1e-300, -1e300, 1 / 3], [500000.1234567, 5400000.7654321, 8.0], [1, 2, 4.5]])
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])
UV = np.array([[0.0, 1 / 7], [1e-14, 0.3], [2e-14, 1.0], [0.5, 0.5]])


def refusal(path):
    try:
        read_scan(path)
    except FormatError as error:
        return str(error)
    return None


def write_half(path, error):
    path.write_text("half")
    raise error


def unchanged(folder, name, content):
    return [entry.name for entry in folder.iterdir()] == [name] and (folder / name).read_text() == content


@pytest.mark.parametrize("suffix", EXACT)
@given(points=arrays(float, st.tuples(st.integers(3, 6), st.just(3)), elements=doubles))
@per_example
def test_a_mesh_comes_back_to_the_last_digit(tmp_path, suffix, points):
    path = tmp_path / f"mesh{suffix}"
    triangles = np.array([[0, 1, 2], [2, 1, 0]])
    write_mesh(path, points, triangles)
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points, points)
    np.testing.assert_array_equal(scan.triangles, triangles)
    assert (scan.points.dtype, scan.triangles.dtype) == (np.float64, np.int64)


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".npz"])
def test_uv_come_back_to_the_last_digit_as_the_attributes_u_and_v(tmp_path, suffix):
    path = tmp_path / f"mesh{suffix}"
    assert write_mesh(path, POINTS, TRIANGLES, uv=UV) == []
    attributes = read_scan(path).attributes
    np.testing.assert_array_equal(np.column_stack([attributes["u"], attributes["v"]]), UV)


@pytest.mark.parametrize("suffix", [".ply", ".npz"])
def test_attributes_come_back_with_order_dtype_and_value(tmp_path, suffix):
    path = tmp_path / f"mesh{suffix}"
    attributes = {
        "red": np.array([0, 255, 3, 4], np.uint8),
        "nx": np.array([0.1, 0.2, 0.3, 0.4], np.float32),
        "intensity": np.array([1, -2, 3, 32767], np.int16),
        "point_index": np.array([0, 1, 2, 2**31 - 1], np.int32),
        "time": np.array([np.pi, 1e-9, np.nan, 2.0]),
    }
    assert write_mesh(path, POINTS, TRIANGLES, attributes=attributes) == []
    found = read_scan(path).attributes
    assert list(found) == list(attributes)
    for name, column in attributes.items():
        assert found[name].dtype == column.dtype
        np.testing.assert_array_equal(found[name], column)
        assert found[name].flags.writeable


@pytest.mark.parametrize("suffix", [".ply", ".npz"])
def test_our_uv_win_over_those_of_the_input(tmp_path, suffix):
    path = tmp_path / f"mesh{suffix}"
    write_mesh(path, POINTS, TRIANGLES, uv=UV, attributes={"u": np.full(4, 9.0), "red": np.arange(4.0)})
    attributes = read_scan(path).attributes
    assert list(attributes) == ["u", "v", "red"]
    np.testing.assert_array_equal(attributes["u"], UV[:, 0])


@pytest.mark.parametrize("suffix", [".stl", ".glb"])
def test_single_precision_formats_are_silent_when_nothing_that_matters_is_lost(tmp_path, suffix):
    points = np.random.default_rng(0).normal(size=(50, 3))
    assert write_mesh(tmp_path / f"mesh{suffix}", points, TRIANGLES) == []


@pytest.mark.parametrize("suffix", [".stl", ".glb"])
def test_single_precision_formats_say_so_when_survey_coordinates_lose_digits(tmp_path, suffix):
    points = np.random.default_rng(0).normal((5e5, 5.4e6, 0), size=(50, 3))
    (note,) = write_mesh(tmp_path / f"mesh{suffix}", points, TRIANGLES)
    assert "single precision, which moves these points by up to 0.2" in note
    assert "write .ply to keep every digit" in note


def test_vertices_that_single_precision_makes_coincide_are_refused(tmp_path):
    points = np.array([[0, 0, 0], [1, 0, 0], [np.nextafter(1, 2), 0, 0], [0, 1, 0.0]])
    with pytest.raises(FormatError, match="makes 1 of these points coincide with others"):
        write_mesh(tmp_path / "mesh.stl", points, TRIANGLES)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("suffix", "left_out"), [(".off", "u, v, red"), (".stl", "u, v, red"), (".obj", "red")])
def test_what_a_format_cannot_hold_is_named(tmp_path, suffix, left_out):
    points = np.eye(4, 3)
    notes = write_mesh(tmp_path / f"mesh{suffix}", points, TRIANGLES, uv=UV, attributes={"red": np.arange(4)})
    assert notes == [f"pointchart writes no {left_out} to {suffix[1:].upper()}; write .ply to keep them."]


@pytest.mark.parametrize("suffix", UV_SUFFIXES)
def test_parameters_are_written_to_the_last_digit(tmp_path, suffix):
    path = tmp_path / f"uv{suffix}"
    assert write_uv(path, UV) == []
    if suffix == ".csv":
        assert path.read_text().startswith("u,v\n0.0,")
        found = np.loadtxt(path, delimiter=",", skiprows=1)
    elif suffix in (".txt", ".xyz"):
        found = np.loadtxt(path)
    elif suffix == ".ply":
        scan = read_scan(path)
        found = np.column_stack([scan.attributes["u"], scan.attributes["v"]])
        np.testing.assert_array_equal(scan.points, np.column_stack([UV, np.zeros(4)]))
    else:
        found = np.load(path) if suffix == ".npy" else np.load(path)["uv"]
    np.testing.assert_array_equal(found, UV)


@pytest.mark.parametrize("suffix", [".ply", ".npz"])
def test_parameters_are_written_with_their_points(tmp_path, suffix):
    path = tmp_path / f"uv{suffix}"
    write_uv(path, UV, points=POINTS, attributes={"red": np.arange(4, dtype=np.uint8)})
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points, POINTS)
    assert list(scan.attributes) == ["u", "v", "red"]
    assert scan.triangles.shape == (0, 3)


@pytest.mark.parametrize("suffix", MESH_SUFFIXES)
def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path, suffix, full_disk):
    path = tmp_path / f"mesh{suffix}"
    path.write_text("old")
    with pytest.raises(FormatError, match=r"cannot be written \(No space left on device\); free the disk"):
        write_mesh(path, np.eye(4, 3), TRIANGLES)
    assert unchanged(tmp_path, path.name, "old")


@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError, SystemExit])
def test_an_interrupted_write_leaves_the_old_file_and_nothing_else(tmp_path, error):
    path = tmp_path / "mesh.ply"
    path.write_text("old")
    with pytest.raises(error), replacing(path) as temporary:
        write_half(temporary, error)
    assert unchanged(tmp_path, "mesh.ply", "old")


def test_the_temporary_file_is_hidden_and_has_the_suffix_and_folder_of_the_target(tmp_path):
    with replacing(tmp_path / "mesh.ply") as temporary:
        assert (temporary.parent, temporary.suffix, temporary.name[0]) == (tmp_path, ".ply", ".")
        temporary.write_text("new")
    assert unchanged(tmp_path, "mesh.ply", "new")


def test_a_link_stays_a_link_to_the_new_file(tmp_path):
    real, link = tmp_path / "real.ply", tmp_path / "link.ply"
    real.write_text("old")
    link.symlink_to(real)
    with replacing(link) as temporary:
        temporary.write_text("new")
    assert link.is_symlink()
    assert real.read_text() == "new"


def test_writing_into_a_missing_folder_is_one_sentence(tmp_path):
    with pytest.raises(FormatError, match=r"cannot be written \(No such file or directory\)"):
        write_mesh(tmp_path / "none" / "mesh.ply", POINTS, TRIANGLES)


@pytest.mark.parametrize(
    ("uv", "attributes", "message"),
    [
        (UV[:3], {}, r"uv has shape \(3, 2\) where 4 points need \(4, 2\)"),
        (None, {"red": np.zeros(5)}, r"attribute red has shape \(5,\) where 4 points need \(4,\)"),
    ],
)
def test_arrays_of_the_wrong_length_are_refused(tmp_path, uv, attributes, message):
    with pytest.raises(InputError, match=message):
        write_mesh(tmp_path / "mesh.ply", POINTS, TRIANGLES, uv=uv, attributes=attributes)
    with pytest.raises(InputError, match=r"points have shape \(4, 2\) where \(4, 3\) is due"):
        write_mesh(tmp_path / "mesh.ply", POINTS[:, :2], TRIANGLES)
    assert not list(tmp_path.iterdir())


def test_a_suffix_that_cannot_be_written_is_refused_with_those_that_can(tmp_path):
    with pytest.raises(
        FormatError, match=r"'.step' cannot be written here; choose one of .ply, .obj, .off, .stl, .glb, .npz"
    ):
        write_mesh(tmp_path / "mesh.step", POINTS, TRIANGLES)
    with pytest.raises(FormatError, match=r"'.obj' cannot be written here; choose one of .csv"):
        write_uv(tmp_path / "uv.obj", UV)


def test_a_good_output_passes_the_check(tmp_path):
    scan = tmp_path / "scan.ply"
    scan.write_text("scan")
    assert check_output(tmp_path / "mesh.PLY", suffixes=MESH_SUFFIXES, inputs=[scan]) == tmp_path / "mesh.PLY"


def test_outputs_that_cannot_be_written_are_refused_before_a_run(tmp_path):
    (tmp_path / "file").write_text("")
    (tmp_path / "folder.ply").mkdir()
    for name, message in (
        ("mesh.abc", "'.abc' cannot be written here; choose one of"),
        ("mesh", "'' cannot be written here; choose one of"),
        ("none/mesh.ply", "the folder .*none does not exist; create it first"),
        ("file/mesh.ply", "file is a file and not a folder"),
        ("folder.ply", "this is a folder; name a file in it"),
    ):
        with pytest.raises(FormatError, match=message):
            check_output(tmp_path / name, suffixes=MESH_SUFFIXES)


@pytest.mark.parametrize("link", ["same", "symbolic", "hard"])
def test_the_output_may_not_be_an_input(tmp_path, link):
    scan, output = tmp_path / "scan.ply", tmp_path / "mesh.ply"
    scan.write_text("scan")
    if link == "same":
        output = tmp_path / "." / "scan.ply"
    elif link == "symbolic":
        output.symlink_to(scan)
    else:
        output.hardlink_to(scan)
    with pytest.raises(InputError, match=r"the output is also .*scan.ply, which would be lost"):
        check_output(output, suffixes=MESH_SUFFIXES, inputs=[tmp_path / "other.txt", scan])


@needs_permissions
def test_read_only_folders_and_files_are_refused_before_a_run(tmp_path):
    path = tmp_path / "mesh.ply"
    path.write_text("old")
    path.chmod(0o400)
    with pytest.raises(FormatError, match="the file exists and is read-only"):
        check_output(path, suffixes=MESH_SUFFIXES)
    tmp_path.chmod(0o500)
    with pytest.raises(FormatError, match="no permission to write to the folder"):
        check_output(path, suffixes=MESH_SUFFIXES)
    tmp_path.chmod(0o700)


@needs_permissions
def test_a_file_without_read_permission_is_refused(tmp_path):
    path = tmp_path / "scan.ply"
    path.write_text("ply")
    path.chmod(0)
    with pytest.raises(FormatError, match="there is no permission to read it"):
        read_scan(path)


@pytest.mark.parametrize("suffix", READABLE_SUFFIXES)
def test_missing_and_empty_files_and_folders_are_refused_in_every_format(tmp_path, suffix):
    path = tmp_path / f"scan{suffix}"
    with pytest.raises(FormatError, match=f"scan{suffix}: there is no such file"):
        read_scan(path)
    path.write_bytes(b"")
    with pytest.raises(FormatError, match=r"the file is empty \(0 bytes\)"):
        read_scan(path)
    path.unlink()
    path.mkdir()
    with pytest.raises(FormatError, match="this is a folder"):
        read_scan(path)


@pytest.mark.parametrize("suffix", READABLE_SUFFIXES)
@given(content=st.binary(min_size=1, max_size=300))
@per_example
def test_no_library_speaks_through_damaged_files(tmp_path, suffix, content):
    if suffix == ".e57":
        pytest.importorskip("pye57", reason="pye57 is not installed")
    path = tmp_path / f"scan{suffix}"
    path.write_bytes(content)
    assert refusal(path) is None or refusal(path).startswith(str(path))


@pytest.mark.parametrize("suffix", MESH_SUFFIXES)
@given(data=st.data())
@settings(per_example, deadline=None)
def test_a_file_cut_anywhere_or_with_a_false_byte_is_read_or_refused(tmp_path, suffix, data):
    path = tmp_path / f"mesh{suffix}"
    points = np.random.default_rng(1).normal(size=(4, 3))
    write_mesh(path, points, TRIANGLES, uv=UV if suffix in (".ply", ".obj") else None)
    content = bytearray(path.read_bytes())
    content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content[: data.draw(st.integers(1, len(content)))])
    assert refusal(path) is None or refusal(path).startswith(str(path))


def test_an_unknown_suffix_is_refused_with_those_that_are_known(tmp_path):
    with pytest.raises(FormatError, match=r"the suffix '.docx' is none of the 26 that can be read: .ply, .obj"):
        read_scan(tmp_path / "scan.docx")


def test_a_suffix_in_capitals_is_known(tmp_path):
    path = tmp_path / "SCAN.XYZ"
    path.write_text("1 2 3\n")
    np.testing.assert_array_equal(read_scan(path).points, [[1, 2, 3]])


def test_a_file_without_points_is_refused(tmp_path):
    path = tmp_path / "mesh.npz"
    write_mesh(path, np.empty((0, 3)), np.empty((0, 3), np.int64))
    with pytest.raises(FormatError, match="the file holds 0 points"):
        read_scan(path)


def test_an_array_is_read_with_its_extra_columns(tmp_path):
    path = tmp_path / "scan.npy"
    table = np.arange(10, dtype=np.float32).reshape(2, 5)
    np.save(path, table)
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points, table[:, :3])
    assert scan.points.dtype == np.float64
    assert list(scan.attributes) == ["column_4", "column_5"]
    assert scan.attributes["column_5"].dtype == np.float32


def test_a_structured_array_is_read_by_its_names(tmp_path):
    path = tmp_path / "scan.npy"
    table = np.zeros(2, [("red", "u1"), ("z", ">f8"), ("y", "f4"), ("x", "i4"), ("label", "U3")])
    table["z"], table["x"] = [7, 8], [1, 2]
    np.save(path, table)
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points, [[1, 0, 7], [2, 0, 8]])
    assert list(scan.attributes) == ["red"]


@pytest.mark.parametrize("array", [np.zeros((4, 2)), np.zeros(4), np.zeros((4, 3), complex), np.array([["a"] * 3])])
def test_an_array_that_is_no_cloud_is_refused(tmp_path, array):
    path = tmp_path / "scan.npy"
    np.save(path, array)
    with pytest.raises(FormatError, match=r"the array is .* of shape .*; save numbers, \(n, 3\) or wider"):
        read_scan(path)


def test_an_array_with_a_false_shape_is_refused_before_anything_is_allocated(tmp_path):
    path = tmp_path / "scan.npy"
    np.save(path, np.zeros((4, 3)))
    content = path.read_bytes()
    path.write_bytes(content.replace(b"(4, 3), }" + 9 * b" ", b"(4000000000, 3), }"))
    assert len(path.read_bytes()) == len(content)
    with pytest.raises(FormatError, match="this is no whole numpy file"):
        read_scan(path)


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"a": np.zeros((4, 3)), "b": np.ones((4, 3))}, r"there is no array 'points' among \['a', 'b'\]"),
        ({"points": np.zeros((4, 2))}, r"'points' is float64 of shape \(4, 2\), not numbers of shape \(4, 3\)"),
        ({"points": np.eye(3), "uv": np.zeros((2, 2))}, r"'uv' is float64 of shape \(2, 2\)"),
        ({"points": np.eye(3), "triangles": np.array([[0, 1, 3]])}, "face 0 refers to vertex 3, but there are 3"),
        ({"points": np.eye(3), "triangles": np.eye(3)}, "'triangles' is float64"),
        ({"points": np.array([None])}, "this is no whole numpy file"),
    ],
)
def test_an_archive_that_is_not_ours_is_refused(tmp_path, arrays, message):
    path = tmp_path / "mesh.npz"
    np.savez(path, allow_pickle=True, **arrays)
    with pytest.raises(FormatError, match=message):
        read_scan(path)


@given(loop=st.lists(st.integers(0, 10**9), min_size=1))
@per_example
def test_a_loop_comes_back(tmp_path, loop):
    path = tmp_path / "loop.txt"
    write_loop(path, np.array(loop))
    assert path.read_text() == "".join(f"{i}\n" for i in loop)
    np.testing.assert_array_equal(read_loop(path), loop)
    assert read_loop(path).dtype == np.int64


def test_a_loop_may_have_comments_blank_lines_commas_and_several_indices_a_line(tmp_path):
    path = tmp_path / "loop.txt"
    path.write_bytes(b"\xef\xbb\xbf# the rim\r\n3, 1\r\n\r\n4 1 # twice\r\n  5\r\n")
    assert read_loop(path).tolist() == [3, 1, 4, 1, 5]


@pytest.mark.parametrize("text", ["a", "-1", "1.5", "1 2 x", "1_000", "1;2", "9" * 30])
def test_a_line_of_a_loop_that_is_no_index_is_named(tmp_path, text):
    path = tmp_path / "loop.txt"
    path.write_text(f"1\n\n{text}\n")
    with pytest.raises(FormatError, match=f"line 3 '{text}' is not a 0-based point index"):
        read_loop(path)


def test_a_loop_without_indices_is_refused(tmp_path):
    path = tmp_path / "loop.txt"
    path.write_text("# nothing\n\n")
    with pytest.raises(FormatError, match="holds 0 point indices"):
        read_loop(path)
