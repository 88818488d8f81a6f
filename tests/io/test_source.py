"""Packed files, marks before and behind text, and files that cannot be read."""

import bz2
import gzip
import lzma

import numpy as np
import pytest

from pointchart import read_scan, shapes, write_mesh
from pointchart.errors import FormatError
from pointchart.io import READABLE_SUFFIXES

PACKERS = {".gz": gzip.compress, ".bz2": bz2.compress, ".xz": lzma.compress}
CAP = shapes.hemisphere(40)


@pytest.mark.parametrize("packing", PACKERS)
@pytest.mark.parametrize("suffix", [".ply", ".obj", ".off", ".xyz"])
def test_packed_files_are_unpacked(tmp_path, packing, suffix):
    plain = tmp_path / f"scan{suffix}"
    if suffix == ".xyz":
        np.savetxt(plain, CAP.points, fmt="%.17g")
    else:
        write_mesh(plain, CAP.points, CAP.triangles)
    path = tmp_path / f"SCAN{suffix.upper()}{packing.upper()}"
    path.write_bytes(PACKERS[packing](plain.read_bytes()))
    np.testing.assert_array_equal(read_scan(path).points, CAP.points)


@pytest.mark.parametrize("packing", PACKERS)
def test_damaged_packed_files_are_refused(tmp_path, packing):
    path = tmp_path / f"scan.xyz{packing}"
    whole = PACKERS[packing](b"1 2 3\n" * 1000)
    for content in (whole[:-9], b"1 2 3\n"):
        path.write_bytes(content)
        with pytest.raises(FormatError, match="this is no whole packed file"):
            read_scan(path)


@pytest.mark.parametrize("packing", PACKERS)
def test_a_file_that_would_fill_the_memory_is_refused(tmp_path, packing):
    path = tmp_path / f"scan.xyz{packing}"
    path.write_bytes(PACKERS[packing](bytes(1 << 27)))
    with pytest.raises(FormatError, match="unpacks to more than 200 times its size, as no scan does"):
        read_scan(path)


@pytest.mark.parametrize("suffix", [".npy", ".npz", ".las", ".laz", ".e57"])
def test_what_libraries_open_has_to_be_unpacked_before(tmp_path, suffix):
    with pytest.raises(FormatError, match=f"{suffix} is read from the disk as it is; unpack it first"):
        read_scan(tmp_path / f"scan{suffix}.gz")


def test_a_control_z_ends_a_text(tmp_path):
    (tmp_path / "scan.xyz").write_bytes(b"1 2 3\r\n4 5 6\r\n\x1a")
    np.testing.assert_array_equal(read_scan(tmp_path / "scan.xyz").points, [[1, 2, 3], [4, 5, 6]])


@pytest.mark.parametrize(
    ("name", "what"),
    [
        ("a.rcs", "a scan of Autodesk ReCap; export"),
        ("a.DRC", "compressed by Draco; unpack"),
        ("a.fls", "a scan of FARO"),
    ],
)
def test_a_format_that_cannot_be_read_says_with_which_program(tmp_path, name, what):
    with pytest.raises(FormatError, match=f"this is {what}"):
        read_scan(tmp_path / name)


@pytest.mark.parametrize(
    ("suffix", "names"),
    [(".xyzn", ["nx", "ny", "nz"]), (".xyzrgb", ["red", "green", "blue"]), (".xyzi", ["intensity"]), (".dat", [])],
)
def test_suffixes_of_open3d_name_the_columns(tmp_path, suffix, names):
    rows = "".join(f"{i} 2 3 {' '.join(['0.5'] * len(names))}\n" for i in range(3))
    (tmp_path / f"scan{suffix}").write_text(rows)
    assert suffix in READABLE_SUFFIXES
    assert list(read_scan(tmp_path / f"scan{suffix}").attributes) == names
