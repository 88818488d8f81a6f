"""OBJ, OFF, STL and GLB: vertex i of the file is point i, and damage is one sentence."""

import numpy as np
import pytest
import trimesh

from pointchart.errors import FormatError
from pointchart.io import read_scan, write_mesh

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]])
TWO = np.array([[0, 1, 2], [0, 2, 3]])
V = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\n"


@pytest.fixture
def scan_of(tmp_path):
    def read(suffix, content):
        path = tmp_path / f"scan{suffix}"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_scan(path)

    return read


@pytest.mark.parametrize(
    "faces",
    [
        "f 1 2 3\nf 1 3 4\n",
        "f 1 2 3 4\n",
        "f 1// 2// 3//\nf 1//1 3//1 4//1\nvn 0 0 1\n",
        "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1 3 4\nvt 0 0\n",
        "g left\ns 1\nf -4 -3 -2\nv 9 9 9\nf -5 -3 -2\n",
        "f 1 \\\n 2 3\n  f\t1 3 4 # the second\n",
    ],
)
def test_obj_faces_of_every_form_give_the_same_triangles(scan_of, faces):
    scan = scan_of(".obj", "# a square\nmtllib none.mtl\no square\n" + V + faces)
    np.testing.assert_array_equal(scan.points[:4], SQUARE)
    np.testing.assert_array_equal(scan.triangles, TWO)


def test_obj_vertices_without_faces_and_outside_of_faces_stay(scan_of):
    np.testing.assert_array_equal(scan_of(".obj", V).points, SQUARE)
    np.testing.assert_array_equal(scan_of(".obj", V + "f 2 3 4\n").points, SQUARE)


def test_obj_colours_behind_the_coordinates_are_attributes(scan_of):
    scan = scan_of(".obj", "v 1 2 3 0.1 0.2 0.3\nv 4 5 6 1 1 1\n")
    np.testing.assert_array_equal(scan.points, [[1, 2, 3], [4, 5, 6]])
    assert list(scan.attributes) == ["red", "green", "blue"]
    np.testing.assert_array_equal(scan.attributes["green"], [0.2, 1])


def test_obj_texture_coordinates_and_normals_with_one_a_vertex_are_attributes(scan_of):
    vt = "vt 0 0.1\nvt 1 0.1 0\n".replace(" 0\n", "\n") + "vt 1 1\n"
    scan = scan_of(".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n" + vt + "vn 0 0 1\nf 1/3/1 2/1/1 3/2/1\n")
    np.testing.assert_array_equal(scan.attributes["u"], [1, 0, 1])
    np.testing.assert_array_equal(scan.attributes["v"], [1, 0.1, 0.1])
    np.testing.assert_array_equal(scan.attributes["nz"], [1, 1, 1])


@pytest.mark.parametrize("faces", ["f 1/1 2/2 3/3\nf 1/2 3/3 4/1\n", "f 1/1 2/2 3/3\n", "f 1/1 2/2 3/9\n", "f 1 2 3\n"])
def test_obj_texture_coordinates_with_several_or_none_a_vertex_are_passed_over(scan_of, faces):
    assert scan_of(".obj", V + "vt 0 0\nvt 1 0\nvt 1 1\n" + faces).attributes == {}


def test_obj_names_the_vertex_in_texture_and_face(tmp_path):
    path = tmp_path / "mesh.obj"
    write_mesh(path, SQUARE, TWO, uv=SQUARE[:, :2])
    lines = path.read_text().split("\n")
    assert (lines[2], lines[6], lines[9]) == ("v 1.0 1.0 0.5", "vt 1.0 1.0", "f 1/1 3/3 4/4")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("# empty\n", "the file holds 0 points"),
        (V + "v 1 one 2\n", "line 5 '1 one 2' is not a row of numbers"),
        ("v 1 2\n" + V, "line 1 '1 2' has 2 numbers where at least 3 are due"),
        (V + "v 1 2 3 1 1 1\n", "line 5 '1 2 3 1 1 1' has 6 numbers where 3 are due"),
        ("v 0 0 0\nv\n" + V, "line 2 'v' is not a row of numbers"),
        ("v 1 2 3 4 5\n", "line 1 has 5 numbers after 'v'; 3, 4, 6 or 7 can be read"),
        (V + "f 1 2 5\n", "face 1 refers to vertex 5, but there are 4, numbered from 1"),
        (V + "f 1 2 3\nf 0 1 2\n", "face 2 refers to vertex 0, but there are 4"),
        (V + "f 1 2 -9\n", "face 1 refers to vertex -4, but there are 4"),
        (V + "f 1 2 x\n", "line 5 '1 2 x' is not a row of numbers"),
        (V + "f 1/1 2 3\n", "line 5 '1/1 2 3' is no face"),
        (V + "f 1.5 2 3\n", "line 5 '1.5 2 3' is no face"),
    ],
)
def test_a_damaged_obj_is_refused_with_the_place_and_the_number(scan_of, content, message):
    with pytest.raises(FormatError, match=message):
        scan_of(".obj", content)


OFF_ROWS = "0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n"


@pytest.mark.parametrize("head", ["OFF\n4 2 0\n", "OFF 4 2 5\n", "# c\n\nOFF # c\n# d\n4 2\n"])
@pytest.mark.parametrize("faces", ["3 0 1 2\n3 0 2 3\n", "4 0 1 2 3\n2 0 1\n", "3 0 1 2 255 0 0\n3 0 2 3 # c\n"])
def test_off_of_every_form_gives_the_same_mesh(scan_of, head, faces):
    scan = scan_of(".off", head + OFF_ROWS + "\n" + faces)
    np.testing.assert_array_equal(scan.points, SQUARE)
    np.testing.assert_array_equal(scan.triangles, TWO)


def test_off_colours_and_normals_are_attributes(scan_of):
    scan = scan_of(".off", "COFF\n1 0 0\n1 2 3 255 128 0 9\n")
    assert list(scan.attributes) == ["red", "green", "blue", "alpha"]
    assert [column[0] for column in scan.attributes.values()] == [255, 128, 0, 9]
    assert list(scan_of(".off", "NOFF\n1 0 0\n1 2 3 0 0 1\n").attributes) == ["nx", "ny", "nz"]
    assert list(scan_of(".off", "OFF\n1 0 0\n1 2 3 0.5\n").attributes) == ["column_4"]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("4 2 0\n" + OFF_ROWS, "the first line is not OFF, COFF or NOFF"),
        ("OFF\n", "line 1 '' is not the numbers of vertices and faces"),
        ("OFF\n-4 2 0\n" + OFF_ROWS, "line 2 '-4 2 0' is not the numbers of vertices and faces"),
        ("OFF\n5 0 0\n" + OFF_ROWS, "ends after 4 of 5 vertices and 0 of 0 faces"),
        ("OFF\n4 4000000000 0\n" + OFF_ROWS + "3 0 1 2\n", "ends after 4 of 4 vertices and 1 of 4000000000 faces"),
        ("OFF\n4 0 0\n0 0 0\n1 x 0\n1 1 0\n0 1 0\n", "line 4 '1 x 0' is not a row of numbers"),
        ("OFF\n4 1 0\n" + OFF_ROWS + "3 0 1 4\n", "face 0 refers to vertex 4, but there are 4, numbered from 0"),
        ("OFF\n4 1 0\n" + OFF_ROWS + "3 0 1\n", "line 7 '3 0 1' is not a face of 3 corners"),
        ("OFF\n4 1 0\n" + OFF_ROWS + "3 0 1 1.5\n", "line 7 '3 0 1 1.5' is not a face of 3 corners"),
    ],
)
def test_a_damaged_off_is_refused_with_the_place_and_the_number(scan_of, content, message):
    with pytest.raises(FormatError, match=message):
        scan_of(".off", content)


def stl_text(corners):
    facets = "".join(
        "facet normal 0 0 1\nouter loop\n"
        + "".join(f"  vertex {x} {y} {z}\n" for x, y, z in facet)
        + "endloop\nendfacet\n"
        for facet in corners.tolist()
    )
    return f"solid square\n{facets}endsolid square\n"


def stl_binary(corners, header=b""):
    facets = np.zeros(len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facets["corners"] = corners
    return header.ljust(80, b"\0") + np.array(len(corners), "<u4").tobytes() + facets.tobytes()


@pytest.mark.parametrize("case", ["text", "upper", "binary", "solid", "trailing"])
def test_stl_corners_are_merged_in_the_order_in_which_they_first_appear(scan_of, case):
    corners = SQUARE[[[2, 0, 1], [0, 2, 3]]]
    content = {
        "text": stl_text(corners).encode(),
        "upper": stl_text(corners).upper().encode(),
        "binary": stl_binary(corners),
        "solid": stl_binary(corners, b"solid but binary"),
        "trailing": stl_binary(corners, b"solid but binary") + b"more",
    }[case]
    scan = scan_of(".stl", content)
    np.testing.assert_array_equal(scan.points, SQUARE[[2, 0, 1, 3]])
    np.testing.assert_array_equal(scan.triangles, [[0, 1, 2], [1, 0, 3]])


def test_stl_zero_and_minus_zero_are_one_corner(scan_of):
    corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[-0.0, 0, -0.0], [2, 0, 0], [0, 2, 0]]])
    assert len(scan_of(".stl", stl_binary(corners)).points) == 5


def test_stl_is_written_so_that_other_readers_take_it(tmp_path):
    path = tmp_path / "mesh.stl"
    write_mesh(path, SQUARE, TWO)
    mesh = trimesh.load_mesh(path, process=False)
    np.testing.assert_array_equal(mesh.triangles, SQUARE[TWO])
    np.testing.assert_allclose(np.linalg.norm(mesh.face_normals, axis=1), 1)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (stl_binary(SQUARE[TWO])[:-1], r"ends after 1 of 2 triangles \(183 bytes\)"),
        (b"\0" * 80 + b"\xff" * 4 + b"\0" * 50, "ends after 1 of 4294967295 triangles"),
        (b"\0" * 20, r"ends after 0 of \? triangles \(20 bytes\)"),
        (stl_text(SQUARE[TWO])[:-60], "5 corners stand in 1 whole facets, which need 3"),
        (
            stl_text(SQUARE[TWO]).replace("vertex 1.0 1.0", "vertex 1.0 one"),
            "line 6 '1.0 one 0.5' is not a row of numbers",
        ),
        (
            stl_text(SQUARE[TWO]).replace("vertex 1.0 1.0", "vertex 1.0"),
            "line 6 '1.0 0.5' has 2 numbers where 3 are due",
        ),
        (stl_text(SQUARE[TWO]).replace("vertex 1.0 1.0 0.5", "vertex"), "line 6 'vertex' is not a row of numbers"),
        ("solid nothing\nendsolid nothing\n", "the file holds 0 points"),
    ],
)
def test_a_damaged_stl_is_refused_with_the_place_and_the_number(scan_of, content, message):
    with pytest.raises(FormatError, match=message):
        scan_of(".stl", content)


def test_glb_brings_back_points_triangles_and_uv_in_single_precision(tmp_path):
    path = tmp_path / "mesh.glb"
    points, uv = np.random.default_rng(0).random((5, 3)), np.random.default_rng(1).random((5, 2))
    assert write_mesh(path, points, TWO, uv=uv) == []
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points, points.astype(np.float32))
    np.testing.assert_array_equal(scan.triangles, TWO)
    np.testing.assert_allclose(np.column_stack([scan.attributes["u"], scan.attributes["v"]]), uv, atol=1e-7)
    write_mesh(path, points, TWO)
    assert read_scan(path).attributes == {}


def test_glb_parts_are_placed_as_the_scene_says_and_follow_one_another(tmp_path):
    path = tmp_path / "scene.glb"
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.Trimesh(SQUARE, TWO, process=False, vertex_colors=np.full((4, 4), 7, np.uint8)))
    scene.add_geometry(trimesh.PointCloud(SQUARE[:2]), transform=trimesh.transformations.translation_matrix([0, 0, 5]))
    scene.export(path)
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points, np.concatenate([SQUARE, SQUARE[:2] + np.array([0, 0, 5])]))
    np.testing.assert_array_equal(scan.triangles, TWO)


@pytest.mark.parametrize("damage", [lambda content: content[:-9], lambda content: b"glTF" + bytes(40)])
def test_a_damaged_glb_is_refused(tmp_path, damage):
    path = tmp_path / "mesh.glb"
    write_mesh(path, SQUARE, TWO)
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(FormatError, match="this is no whole binary glTF file"):
        read_scan(path)
