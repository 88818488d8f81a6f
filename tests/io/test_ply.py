"""PLY: every legal file is read, whatever its types, order and elements, and every damaged one is one sentence."""

import numpy as np
import pytest

from pointchart.errors import FormatError
from pointchart.io import read_scan, write_mesh

CUBE_FACE = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
XYZ = "property float x\nproperty float y\nproperty float z\n"
CORNERS = "property list uchar int vertex_indices\n"


@pytest.fixture
def scan_of(tmp_path):
    def read(content):
        path = tmp_path / "scan.ply"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_scan(path)

    return read


def text_ply(vertex=XYZ, rows=CUBE_FACE, n=4, faces="", n_faces=0, before="", corners=CORNERS):
    face = f"element face {n_faces}\n{corners}" if n_faces else ""
    return f"ply\nformat ascii 1.0\n{before}element vertex {n}\n{vertex}{face}end_header\n{rows}{faces}"


def binary_ply(order, elements):
    """Pack elements {name: (property lines, [rows of (code, values) pairs])}."""
    name = {"<": "little", ">": "big"}[order]
    header, body = f"ply\nformat binary_{name}_endian 1.0\n", b""
    for element, (properties, rows) in elements.items():
        header += f"element {element} {len(rows)}\n{properties}"
        body += b"".join(np.array(values, order + code).tobytes() for row in rows for code, values in row)
    return header.encode() + b"end_header\n" + body


def vertices(n=4):
    return (XYZ, [[("f4", (i, i * i, 0.5))] for i in range(n)])


def test_text_is_read_in_double_precision_whatever_the_header_says(scan_of):
    scan = scan_of(text_ply(rows="500000.123456789 0 0\n1 0 0\n1 1 0\n0 1 nan\n"))
    assert scan.points[0, 0] == 500000.123456789
    assert np.isnan(scan.points[3, 2])
    assert scan.triangles.shape == (0, 3)


def test_every_type_of_property_is_kept_in_the_order_of_the_file(scan_of):
    types = {"uchar": "u1", "int8": "i1", "ushort": "u2", "int16": "i2", "int": "i4", "uint32": "u4", "double": "f8"}
    extra = "".join(f"property {name} p_{name}\n" for name in types)
    scan = scan_of(text_ply(vertex=extra + XYZ, n=1, rows="1 2 3 4 5 6 7.5 10 20 30\n"))
    np.testing.assert_array_equal(scan.points, [[10, 20, 30]])
    assert {name: column.dtype.str[1:] for name, column in scan.attributes.items()} == {
        f"p_{name}": code for name, code in types.items()
    }
    assert [column[0] for column in scan.attributes.values()] == [1, 2, 3, 4, 5, 6, 7.5]


@pytest.mark.parametrize("order", ["<", ">"])
def test_both_byte_orders_give_the_same_scan(scan_of, order):
    vertex = ("property uint id\n" + XYZ + "property double u\n", [])
    vertex[1].extend([("u4", 7 + i), ("f4", (i, 2, 3)), ("f8", i / 3)] for i in range(4))
    faces = ("property uchar flag\n" + CORNERS, [[("u1", (9, 3)), ("i4", (0, 1, i))] for i in (2, 3)])
    scan = scan_of(binary_ply(order, {"vertex": vertex, "face": faces}))
    np.testing.assert_array_equal(scan.points, [[i, 2, 3] for i in range(4)])
    np.testing.assert_array_equal(scan.attributes["u"], np.arange(4) / 3)
    np.testing.assert_array_equal(scan.attributes["id"], [7, 8, 9, 10])
    assert scan.attributes["id"].dtype == np.uint32
    np.testing.assert_array_equal(scan.triangles, [[0, 1, 2], [0, 1, 3]])


POLYGONS = [[0, 1, 2, 3], [3, 2, 1], [0, 1], [4, 3, 2, 1, 0], [0, 2, 4]]
FANS = [[0, 1, 2], [0, 2, 3], [3, 2, 1], [4, 3, 2], [4, 2, 1], [4, 1, 0], [0, 2, 4]]


@pytest.mark.parametrize("name", ["vertex_indices", "vertex_index"])
@pytest.mark.parametrize("kind", ["text", "<", ">"])
def test_polygons_become_fans_in_the_order_of_the_file(scan_of, kind, name):
    corners = CORNERS.replace("vertex_indices", name)
    if kind == "text":
        faces = "".join(f"{len(p)} {' '.join(map(str, p))}\n" for p in POLYGONS)
        scan = scan_of(text_ply(rows=CUBE_FACE + "2 2 2\n", n=5, faces=faces, n_faces=5, corners=corners))
    else:
        rows = [[("u1", len(p)), ("i4", p)] for p in POLYGONS]
        scan = scan_of(binary_ply(kind, {"vertex": vertices(5), "face": (corners, rows)}))
    np.testing.assert_array_equal(scan.triangles, FANS)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("lengths", [(2, 2, 2), (0, 3, 1)])
def test_lists_of_a_vertex_are_passed_over(scan_of, order, lengths):
    properties = "property list ushort double neighbours\n" + XYZ + "property uchar red\n"
    rows = [[("u2", k), ("f8", [0.5] * k), ("f4", (i, 2, 3)), ("u1", i)] for i, k in enumerate(lengths)]
    scan = scan_of(binary_ply(order, {"vertex": (properties, rows)}))
    np.testing.assert_array_equal(scan.points, [[i, 2, 3] for i in range(3)])
    assert list(scan.attributes) == ["red"]
    np.testing.assert_array_equal(scan.attributes["red"], [0, 1, 2])


def test_lists_of_a_vertex_are_passed_over_in_text(scan_of):
    properties = XYZ + "property list uchar int neighbours\nproperty uchar red\n"
    scan = scan_of(text_ply(vertex=properties, n=2, rows="1 2 3 2 8 9 255\n4 5 6 0 254\n"))
    np.testing.assert_array_equal(scan.points, [[1, 2, 3], [4, 5, 6]])
    np.testing.assert_array_equal(scan.attributes["red"], [255, 254])


def test_texture_lists_behind_the_corners_are_passed_over(scan_of):
    corners = CORNERS + "property list uchar float texcoord\n"
    faces = "3 0 1 2 6 0 0 1 0 1 1\n4 0 1 2 3 2 .5 .5\n"
    scan = scan_of(text_ply(faces=faces, n_faces=2, corners=corners))
    np.testing.assert_array_equal(scan.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3]])


def test_other_elements_before_between_and_behind_are_passed_over(scan_of):
    elements = {
        "camera": ("property double f\nproperty list uchar short s\n", [[("f8", 1), ("u1", 2), ("i2", (1, 2))]]),
        "vertex": vertices(),
        "edge": ("property int a\n", [[("i4", 0)]] * 3),
        "face": (CORNERS, [[("u1", 3), ("i4", (0, 1, 2))]]),
        "material": ("property float shine\n", []),
    }
    scan = scan_of(binary_ply("<", elements))
    np.testing.assert_array_equal(scan.points[:, 0], range(4))
    np.testing.assert_array_equal(scan.triangles, [[0, 1, 2]])


def test_faces_may_stand_before_the_vertices(scan_of):
    scan = scan_of(binary_ply(">", {"face": (CORNERS, [[("u1", 3), ("i4", (2, 1, 0))]]), "vertex": vertices()}))
    np.testing.assert_array_equal(scan.triangles, [[2, 1, 0]])


@pytest.mark.parametrize("newline", ["\r\n", "\r"])
def test_header_and_rows_may_have_other_line_ends(scan_of, newline):
    scan = scan_of(text_ply(faces="3 0 1 2\n", n_faces=1).replace("\n", newline))
    np.testing.assert_array_equal(scan.points[2], [1, 1, 0])
    np.testing.assert_array_equal(scan.triangles, [[0, 1, 2]])


def test_a_binary_body_may_follow_a_header_with_carriage_returns(scan_of):
    content = binary_ply("<", {"vertex": vertices()})
    header, body = content.split(b"end_header\n")
    scan = scan_of(header.replace(b"\n", b"\r\n") + b"end_header\r\n" + body)
    np.testing.assert_array_equal(scan.points[:, 1], [0, 1, 4, 9])


def test_comments_may_stand_anywhere_in_the_header(scan_of):
    content = text_ply(vertex="comment end_header is not here\n" + XYZ + "obj_info num_cols 4\n")
    scan = scan_of(content.replace("ply\n", "ply\ncomment before the format\ncomment\n", 1))
    np.testing.assert_array_equal(scan.points[2], [1, 1, 0])


def test_bytes_behind_the_last_row_are_tolerated(scan_of):
    np.testing.assert_array_equal(scan_of(binary_ply("<", {"vertex": vertices()}) + b"xyz").points[:, 0], range(4))
    np.testing.assert_array_equal(scan_of(text_ply() + "\n\nwords\n").points[2], [1, 1, 0])


def test_a_written_mesh_has_double_coordinates_and_triangles(tmp_path):
    path = tmp_path / "mesh.ply"
    attributes = {"my flag": np.array([True, False, True]), "id": np.array([1, 2**40, 3])}
    assert write_mesh(path, np.eye(3), np.array([[0, 1, 2]]), uv=np.eye(3, 2), attributes=attributes) == []
    header = path.read_bytes().split(b"end_header\n")[0].decode().split("\n")
    assert [line for line in header if line.startswith("property")] == [
        "property double x",
        "property double y",
        "property double z",
        "property double u",
        "property double v",
        "property uchar my_flag",
        "property double id",
        "property list uchar int vertex_indices",
    ]
    np.testing.assert_array_equal(read_scan(path).attributes["id"], attributes["id"])


def test_integers_that_no_ply_type_holds_are_noted(tmp_path):
    attributes = {"id": np.array([1, 2**63 - 1, 2**53 + 1])}
    (note,) = write_mesh(tmp_path / "mesh.ply", np.eye(3), np.array([[0, 1, 2]]), attributes=attributes)
    assert note == "PLY has no type for id (int64), so 2 of its values are rounded to double."


@pytest.mark.parametrize("order", ["<", ">"])
def test_a_cut_off_binary_file_says_how_many_vertices_of_how_many_it_has(scan_of, order):
    content = binary_ply(order, {"vertex": vertices()})
    with pytest.raises(FormatError, match="ends after 3 of 4 vertices; copy or export it again"):
        scan_of(content[:-1])
    with pytest.raises(FormatError, match="ends after 4 of 4000000000 vertices"):
        scan_of(content.replace(b"vertex 4", b"vertex 4000000000"))


@pytest.mark.parametrize("polygons", [[[0, 1, 2], [0, 2, 3]], POLYGONS[:2]])
def test_a_cut_off_binary_file_says_how_many_faces_of_how_many_it_has(scan_of, polygons):
    rows = [[("u1", len(p)), ("i4", p)] for p in polygons]
    with pytest.raises(FormatError, match="ends after 1 of 2 faces"):
        scan_of(binary_ply("<", {"vertex": vertices(), "face": (CORNERS, rows)})[:-1])


def test_a_cut_off_text_file_says_how_many_of_how_many_it_has(scan_of):
    with pytest.raises(FormatError, match="ends after 4 of 5000000000 vertices"):
        scan_of(text_ply(n=5_000_000_000))
    with pytest.raises(FormatError, match="ends after 1 of 2 faces"):
        scan_of(text_ply(faces="3 0 1 2\n", n_faces=2))


def test_a_list_with_a_negative_number_of_values_is_refused(scan_of):
    rows = [[("i4", -3), ("i4", (0, 1, 2))]]
    with pytest.raises(FormatError, match=r"byte \d+ gives list vertex_indices -3 values"):
        scan_of(binary_ply("<", {"vertex": vertices(), "face": (CORNERS.replace("uchar", "int"), rows)}))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (text_ply().replace("ply", "plo", 1), "line 1 is not 'ply'"),
        (text_ply().replace("end_header", ""), r"the header has no 'end_header' in \d+ bytes"),
        (text_ply().replace("format ascii 1.0\n", ""), "none of the 5 header lines gives the format"),
        (
            text_ply().replace("ascii", "binary_middle_endian"),
            "header line 2 'format binary_middle_endian 1.0' is wrong",
        ),
        (text_ply(n=-4), "header line 3 'element vertex -4' is wrong .the count must be a whole number"),
        (text_ply(n="many"), "header line 3 'element vertex many' is wrong"),
        (text_ply(before="property float x\n"), "header line 3 'property float x' is wrong .a word or the element"),
        (
            text_ply(vertex=XYZ + "property quad w\n"),
            "header line 7 'property quad w' is wrong .a type or format is unknown",
        ),
        (text_ply(vertex=XYZ + "property float\n"), "header line 7 'property float' is wrong"),
        (text_ply(vertex=XYZ + "property float x\n"), "header line 7 .*the property x stands twice in element vertex"),
        (text_ply(vertex=XYZ + "property list float int a\n"), "header line 7 .*must have an integer type"),
        (text_ply(vertex=""), "the header gives 4 rows of vertex no property"),
        (text_ply(before="colour red\n"), "header line 3 'colour red' is wrong .'colour' begins no header line"),
        (text_ply().replace("vertex", "point"), r"there is no element 'vertex' among \['point'\]"),
        (text_ply(vertex=XYZ.replace(" z", " w")), "the coordinate z is missing among the 3 columns .x, y, w"),
        (text_ply(rows="0 0 0\n1 0 0\n1 one 0\n0 1 0\n"), "line 10 '1 one 0' is not a row of numbers"),
        (text_ply(rows="0 0 0\n\n1 0\n1 1 0\n0 1 0\n"), "line 10 '1 0' has 2 numbers where 3 are due"),
        (text_ply(faces="3 0 1\n", n_faces=1), "line 14 '3 0 1' has 3 numbers where 4 are due"),
        (text_ply(faces="x 0 1\n", n_faces=1), "line 14 'x 0 1' has no number of values for list vertex_indices"),
        (text_ply(faces="3 0 1 2.5\n", n_faces=1), "line 14 has 2.5 for vertex_indices, which int32 cannot hold"),
        (
            text_ply(vertex="property uchar r\n" + XYZ, n=1, rows="300 1 2 3\n"),
            "line 9 has 300 for r, which uint8 cannot",
        ),
        (text_ply(faces="3 0 1 4\n", n_faces=1), "face 0 refers to vertex 4, but there are 4, numbered from 0"),
        (text_ply(faces="3 0 1 2\n4 0 1 2 -1\n", n_faces=2), "face 1 refers to vertex -1, but there are 4"),
    ],
)
def test_a_damaged_file_is_refused_with_the_place_and_the_number(scan_of, content, message):
    with pytest.raises(FormatError, match=message):
        scan_of(content)


def test_a_byte_order_mark_and_a_control_z_are_passed_over(scan_of):
    scan = scan_of(b"\xef\xbb\xbf" + text_ply().encode() + b"\x1a")
    np.testing.assert_array_equal(scan.points[2], [1, 1, 0])
    assert scan.notes == ()


@pytest.mark.parametrize("faces", ["", "3 0 1 2\n"])
def test_vertices_may_be_broken_into_lines_all_in_the_same_way(scan_of, faces):
    broken = text_ply(rows="0 0\n0\n1 0\n0\n1 1\n0\n0 1\n0\n", faces=faces, n_faces=len(faces.split("\n")) - 1)
    whole = text_ply(faces=faces, n_faces=len(faces.split("\n")) - 1)
    np.testing.assert_array_equal(scan_of(broken).points, scan_of(whole).points)
    np.testing.assert_array_equal(scan_of(broken).triangles, scan_of(whole).triangles)


def test_numbers_that_the_header_of_faces_does_not_name_are_left_out_and_said(scan_of):
    scan = scan_of(text_ply(faces="3 0 1 2 255 0\n4 0 1 2 3 255 0\n", n_faces=2))
    np.testing.assert_array_equal(scan.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3]])
    assert scan.notes == ("each face has 2 more numbers than the header names; they are left out",)


def test_rows_behind_the_number_announced_are_named(scan_of):
    assert scan_of(text_ply(n=3)).notes == ("1 line behind the 3 rows of vertex passed over",)
    assert scan_of(binary_ply("<", {"vertex": vertices()}) + b"xyz").notes == (
        "3 bytes behind the 4 rows of vertex passed over",
    )
