"""PCD files of every storage."""

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pointchart._kernels.io import lzf
from pointchart.errors import FormatError
from pointchart.io import read_scan

POINTS = np.random.default_rng(3).uniform(-5, 5, (40, 3)).astype(np.float32)
COLORS = np.random.default_rng(4).integers(0, 256, (40, 3), dtype=np.uint8)
BITS = (COLORS.astype(np.uint32) << np.array([16, 8, 0], np.uint32)).sum(axis=1, dtype=np.uint32)
FIELDS = [
    ("x", "F", 4, 1),
    ("y", "F", 4, 1),
    ("z", "F", 4, 1),
    ("_", "U", 1, 4),
    ("rgb", "F", 4, 1),
    ("ring", "U", 2, 1),
]
RING = np.arange(40, dtype=np.uint16)
STORAGES = ("ascii", "binary", "binary_compressed")


def header(storage, n=40, fields=FIELDS, size=None, more=""):
    names, kinds, sizes, counts = zip(*fields, strict=True)
    width, height = size or (n, 1)
    lines = ["# .PCD v0.7", "VERSION 0.7", f"FIELDS {' '.join(names)}"]
    for key, values in (("SIZE", sizes), ("TYPE", kinds), ("COUNT", counts)):
        lines.append(f"{key} {' '.join(map(str, values))}")
    lines += [f"WIDTH {width}", f"HEIGHT {height}", more or "VIEWPOINT 0 0 0 1 0 0 0", f"POINTS {n}", f"DATA {storage}"]
    return "\n".join(lines).encode() + b"\n"


def packed(data):
    """Compress by LZF: copies of four bytes where they stood before, bytes as they are where not."""
    out, literal, seen, i = bytearray(), bytearray(), {}, 0

    def flush():
        while literal:
            out.append(len(literal[:32]) - 1)
            out.extend(literal[:32])
            del literal[:32]

    while i < len(data):
        key = data[i : i + 3]
        start = seen.get(key, -1)
        seen[key] = i
        length = 0
        while start >= 0 and i - start <= 8192 and length < 264 and i + length < len(data):
            if data[start + length] != data[i + length]:
                break
            length += 1
        if length < 3:
            literal.append(data[i])
            i += 1
            continue
        flush()
        back = i - start - 1
        if length - 2 < 7:
            out.append((length - 2) << 5 | back >> 8)
        else:
            out += bytes([7 << 5 | back >> 8, length - 9])
        out.append(back & 255)
        i += length
    flush()
    return bytes(out)


def body(storage, points=POINTS):
    n = len(points)
    columns = [
        points[:, 0],
        points[:, 1],
        points[:, 2],
        np.zeros((n, 4), np.uint8),
        BITS.view(np.float32)[:n],
        RING[:n],
    ]
    if storage == "ascii":
        rows = zip(points.tolist(), BITS.view(np.float32)[:n].tolist(), RING[:n].tolist(), strict=True)
        return "".join(f"{x!r} {y!r} {z!r} 0 0 0 0 {rgb!r} {ring}\n" for (x, y, z), rgb, ring in rows).encode()
    if storage == "binary":
        return b"".join(b"".join(column[i].tobytes() for column in columns) for i in range(n))
    plain = b"".join(column.tobytes() for column in columns)
    short = packed(plain)
    return struct.pack("<II", len(short), len(plain)) + short


@pytest.fixture
def scan_of(tmp_path):
    def read(content):
        path = tmp_path / "scan.pcd"
        path.write_bytes(content)
        return read_scan(path)

    return read


@pytest.mark.parametrize("storage", STORAGES)
def test_every_storage_gives_the_same_points_and_channels(scan_of, storage):
    scan = scan_of(header(storage) + body(storage))
    np.testing.assert_array_equal(scan.points.astype(np.float32), POINTS)
    for channel, values in zip(("red", "green", "blue"), COLORS.T, strict=True):
        np.testing.assert_array_equal(scan.attributes[channel], values)
    np.testing.assert_array_equal(scan.attributes["ring"], RING)
    assert scan.valid is None
    assert scan.notes == ()


@pytest.mark.parametrize("storage", STORAGES)
def test_pixels_of_an_organised_frame_that_saw_nothing_are_no_points(scan_of, storage):
    points = POINTS.copy()
    points[[3, 17]] = np.nan
    scan = scan_of(header(storage, size=(8, 5)) + body(storage, points))
    assert np.flatnonzero(~scan.valid).tolist() == [3, 17]
    assert scan.notes == ("2 of 40 rows are no point, and left out",)


@pytest.mark.parametrize("kind", ["F", "U"])
def test_packed_colours_as_text_may_be_whole_numbers(scan_of, kind):
    fields = [*FIELDS[:3], ("rgba", kind, 4, 1), ("normal_x", "F", 4, 1)]
    scan = scan_of(header("ascii", 1, fields) + b"1 2 3 4278386941 0.5\n")  # 0xff03 0203 - 0x106
    assert {name: values.tolist() for name, values in scan.attributes.items()} == {
        "red": [4278386941 >> 16 & 255],
        "green": [4278386941 >> 8 & 255],
        "blue": [4278386941 & 255],
        "alpha": [255],
        "nx": [0.5],
    }


def test_a_viewpoint_is_not_applied_and_said(scan_of):
    scan = scan_of(header("ascii", more="VIEWPOINT 1 0 0 1 0 0 0") + body("ascii"))
    np.testing.assert_array_equal(scan.points.astype(np.float32), POINTS)
    assert scan.notes == ("the viewpoint of the file is not applied: the points are in the frame of the sensor",)


@given(st.binary(max_size=600), st.integers(1, 40))
def test_lzf_unpacks_what_was_packed(data, times):
    plain = np.empty(len(data) * times, np.uint8)
    assert lzf.unpack(np.frombuffer(packed(data * times), np.uint8), plain)
    assert plain.tobytes() == data * times


@given(st.binary(max_size=60), st.integers(0, 300))
def test_lzf_of_anything_ends_within_its_bounds(data, n):
    guarded = np.full(n + 8, 77, np.uint8)
    lzf.unpack(np.frombuffer(data, np.uint8), guarded[:n])
    assert (guarded[n:] == 77).all()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"x y z\n1 2 3\n", "no header line 'DATA' in its 12 bytes"),
        (header("zipped"), "the rows are 'zipped', not ascii, binary, binary_compressed"),
        (header("binary") + body("binary")[:-1], "ends after 39 of 40 points"),
        (header("ascii") + body("ascii")[:-30], "line|ends after 39 of 40 points"),
        (header("binary_compressed") + body("binary_compressed")[:-1], "bytes are there of"),
        (header("binary_compressed") + b"\x0a\0\0\0\x70\x03\0\0" + b"\xff" * 10, "the 10 compressed bytes are damaged"),
        (header("binary", 10**15) + body("binary"), "ends after 40 of 1000000000000000 points"),
        (header("ascii").replace(b"SIZE 4", b"SIZE 3"), "field x has type F, size 3, count 1"),
        (header("ascii").replace(b"TYPE F", b"TYPE"), "6 FIELDS, 6 SIZE, 5 TYPE and 6 COUNT"),
        (header("ascii").replace(b"POINTS 40", b"POINTS many"), "gives no whole number of POINTS"),
        (
            header("ascii").replace(b"FIELDS x y z", b"FIELDS a b c") + body("ascii"),
            "the coordinate x, y, z is missing",
        ),
        (
            header("ascii") + body("ascii").replace(b" 39\n", b" 70000\n"),
            "point 39 has 70000 for ring, which uint16 can",
        ),
    ],
)
def test_a_damaged_file_is_refused(scan_of, content, message):
    with pytest.raises(FormatError, match=message):
        scan_of(content)
