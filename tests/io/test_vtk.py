"""Legacy VTK: text and binary hold the same points, and what is left out is named."""

import struct
import zlib
from base64 import b64encode

import numpy as np
import pytest

from pointchart.errors import FormatError
from pointchart.io import read_scan

POINTS = np.array([[1, 2, 3], [4, 5.5, 6], [7, 8, 9]])
HEAD = "# vtk DataFile Version 3.0\nany title\n{}\nDATASET POLYDATA\nPOINTS 3 {}\n"
BEHIND = b"\nVERTICES 1 4\n3 0 1 2\nPOINT_DATA 3\n"


@pytest.fixture
def scan_of(tmp_path):
    def read(content):
        path = tmp_path / "scan.vtk"
        path.write_bytes(content)
        return read_scan(path)

    return read


@pytest.mark.parametrize(("name", "code"), [("float", ">f4"), ("double", ">f8")])
def test_binary_points_come_back(scan_of, name, code):
    head = HEAD.format("BINARY", name).encode()
    scan = scan_of(head + POINTS.astype(code).tobytes() + BEHIND)
    np.testing.assert_array_equal(scan.points, POINTS)
    assert scan.notes == ("only the points are read: VERTICES, POINT_DATA left out; write .ply to keep them",)
    with pytest.raises(FormatError, match="ends after 2 of 3 points"):
        scan_of(head + POINTS.astype(code).tobytes()[:-1])


@pytest.mark.parametrize("rows", ["1 2 3 4 5.5 6 7 8 9", "1 2 3\n4 5.5 6\n7 8 9", "1 2\n3 4 5.5 6\n\n7 8 9"])
def test_text_points_may_be_broken_anywhere(scan_of, rows):
    scan = scan_of(HEAD.format("ASCII", "float").encode() + rows.encode() + BEHIND)
    np.testing.assert_array_equal(scan.points, POINTS)


def test_what_is_no_such_file_is_refused(scan_of):
    with pytest.raises(FormatError, match="ends after 1 of 3 points"):
        scan_of(HEAD.format("ASCII", "float").encode() + b"1 2 3\nVERTICES 1 2\n")
    with pytest.raises(FormatError, match="no line says 'POINTS n type'"):
        scan_of(b"# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n")
    with pytest.raises(FormatError, match="it does not begin with"):
        scan_of(b"vtk")


def xml(body, behind="", packer=""):
    return (
        f'<?xml version="1.0"?><VTKFile type="PolyData" byte_order="LittleEndian" header_type="UInt32" {packer}>'
        f'<PolyData><Piece NumberOfPoints="3"><Points>{body}</Points></Piece></PolyData>{behind}</VTKFile>'
    ).encode()


def test_points_in_xml_come_back_however_they_are_packed(tmp_path):
    data = POINTS.astype("<f8").tobytes()
    plain, deflated = struct.pack("<I", len(data)) + data, zlib.compress(data)
    sizes = struct.pack("<IIII", 1, len(data), len(data), len(deflated))
    packer = 'compressor="vtkZLibDataCompressor"'
    twice = (b64encode(sizes) + b64encode(deflated)).decode()
    array = '<DataArray type="Float64" NumberOfComponents="3" format="{}" offset="0">{}</DataArray>'
    appended = '<AppendedData encoding="base64">\n_{}\n</AppendedData>'
    raw = xml(array.format("appended", ""), '<AppendedData encoding="raw">_HERE</AppendedData>')
    contents = [
        xml(array.format("ascii", "1 2 3 4 5.5 6\n7 8 9")),
        xml(array.format("binary", b64encode(plain).decode())),
        xml(array.format("binary", twice), packer=packer),
        xml(array.format("appended", ""), appended.format(twice), packer),
        raw.replace(b"HERE", plain),
    ]
    path = tmp_path / "scan.vtp"
    for content in contents:
        path.write_bytes(content)
        np.testing.assert_array_equal(read_scan(path).points, POINTS)
    path.write_bytes(raw.replace(b"HERE", plain[:-40]))
    with pytest.raises(FormatError, match="this is no whole VTK file"):
        read_scan(path)
