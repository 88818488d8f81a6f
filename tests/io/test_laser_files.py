"""Laser scans: what LAS, LAZ and E57 hold comes back, and a missing extra is named with its command."""

import sys

import numpy as np
import pytest

from pointchart.errors import FormatError
from pointchart.io import read_scan

SURVEY = np.array([[500000.25, 5400000.5, 80.125], [500001.0, 5400002.75, 81.0], [500003.5, 5400000.0, 79.875]])

LOCAL = SURVEY - SURVEY[0]


def las_file(path, points=SURVEY):
    laspy = pytest.importorskip("laspy", reason="laspy is not installed")
    header = laspy.LasHeader(point_format=3, version="1.2")
    header.scales, header.offsets = np.full(3, 0.125 / 64), np.array([5e5, 5.4e6, 0])
    header.add_extra_dim(laspy.ExtraBytesParams(name="amplitude", type=np.float32))
    cloud = laspy.LasData(header)
    cloud.x, cloud.y, cloud.z = points.T
    cloud.intensity = np.arange(len(points), dtype=np.uint16)
    cloud.red = np.full(len(points), 65535, np.uint16)
    cloud.amplitude = np.full(len(points), 0.5, np.float32)
    cloud.write(path)
    return path


def test_las_keeps_survey_coordinates_and_every_dimension(tmp_path):
    scan = read_scan(las_file(tmp_path / "scan.las"))
    np.testing.assert_array_equal(scan.points, SURVEY)
    np.testing.assert_array_equal(scan.attributes["intensity"], [0, 1, 2])
    assert scan.attributes["red"].dtype == np.uint16
    assert scan.attributes["amplitude"].dtype == np.float32
    assert {"gps_time", "classification", "return_number"} <= set(scan.attributes)
    assert all(column.shape == (3,) for column in scan.attributes.values())


def test_laz_equals_las(tmp_path):
    pytest.importorskip("lazrs", reason="lazrs is not installed")
    plain, packed = read_scan(las_file(tmp_path / "scan.las")), read_scan(las_file(tmp_path / "scan.laz"))
    np.testing.assert_array_equal(plain.points, packed.points)
    for name, column in plain.attributes.items():
        np.testing.assert_array_equal(column, packed.attributes[name])


def test_las_without_points_is_refused(tmp_path):
    with pytest.raises(FormatError, match="the file holds 0 points"):
        read_scan(las_file(tmp_path / "scan.las", SURVEY[:0]))


def test_a_cut_off_las_says_how_many_points_of_how_many_it_has(tmp_path):
    path = las_file(tmp_path / "scan.las")
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(FormatError, match="ends after 2 of 3 points; copy or export it again"):
        read_scan(path)


@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_a_las_with_a_false_number_of_records_is_refused_at_once(tmp_path, suffix):
    path = las_file(tmp_path / f"scan{suffix}")
    content = bytearray(path.read_bytes())
    content[100:104] = b"\xff" * 4
    path.write_bytes(content)
    with pytest.raises(FormatError, match=r"the header speaks of 23192823\d+ bytes, but the file has \d+"):
        read_scan(path)


@pytest.mark.parametrize("content", [b"LASF" + bytes(100), b"not a scan" * 100])
def test_a_file_that_is_no_las_is_refused(tmp_path, content):
    path = tmp_path / "scan.laz"
    path.write_bytes(content)
    with pytest.raises(FormatError, match=f"the {len(content)} bytes do not begin with a LAS header"):
        read_scan(path)


def test_a_cut_off_laz_is_refused(tmp_path):
    pytest.importorskip("lazrs", reason="lazrs is not installed")
    path = las_file(tmp_path / "scan.laz", np.tile(SURVEY, (1000, 1)))
    path.write_bytes(path.read_bytes()[:-40])
    with pytest.raises(FormatError, match=r"the table of \d+ chunks at byte \d+ is no part of its \d+ bytes"):
        read_scan(path)


def test_a_laz_with_a_false_byte_in_its_points_is_one_sentence(tmp_path):
    pytest.importorskip("lazrs", reason="lazrs is not installed")
    path = las_file(tmp_path / "scan.laz", np.tile(SURVEY, (1000, 1)))
    content = path.read_bytes()
    end_of_records = int.from_bytes(content[96:100], "little")
    path.write_bytes(content[: end_of_records - 30] + bytes(30) + content[end_of_records:])
    with pytest.raises(FormatError, match="this is no whole LAS or LAZ file"):
        read_scan(path)


def test_laz_without_its_decompressor_names_the_command(tmp_path, monkeypatch):
    laspy = pytest.importorskip("laspy", reason="laspy is not installed")
    path = las_file(tmp_path / "scan.laz")
    monkeypatch.setattr(laspy.LazBackend, "detect_available", classmethod(lambda cls: ()))
    with pytest.raises(FormatError, match=r"LAZ needs a decompressor; pip install 'pointchart\[las\]'"):
        read_scan(path)


@pytest.mark.parametrize(
    ("module", "suffix", "extra"), [("laspy", ".las", "las"), ("laspy", ".laz", "las"), ("pye57", ".e57", "e57")]
)
def test_a_missing_extra_is_named_with_its_command(tmp_path, monkeypatch, module, suffix, extra):
    path = tmp_path / f"scan{suffix}"
    path.write_bytes(b"LASF")
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(FormatError, match=rf"{module} is not installed; pip install 'pointchart\[{extra}\]'"):
        read_scan(path)


def test_e57_scans_are_placed_and_follow_one_another(tmp_path):
    pye57 = pytest.importorskip("pye57", reason="pye57 is not installed")
    path, places = tmp_path / "scan.e57", SURVEY[:2]
    file = pye57.E57(str(path), mode="w")
    for i, place in enumerate(places):
        data = dict(zip(("cartesianX", "cartesianY", "cartesianZ"), LOCAL.T.copy(), strict=True))
        data |= {"intensity": np.array([0.25, 0.5, 1]), "colorRed": np.array([1, 2, 3], np.uint8)}
        data |= {"colorGreen": data["colorRed"], "colorBlue": data["colorRed"]}
        data |= {"rowIndex": np.arange(3), "columnIndex": np.arange(3)} if i else {}
        file.write_scan_raw(data, translation=place, rotation=np.array([1.0, 0, 0, 0]))
    file.close()
    scan = read_scan(path)
    np.testing.assert_allclose(scan.points, np.concatenate([LOCAL + place for place in places]), rtol=1e-12)
    np.testing.assert_array_equal(scan.attributes["red"], [1, 2, 3, 1, 2, 3])
    np.testing.assert_array_equal(scan.attributes["intensity"], [0.25, 0.5, 1] * 2)


def test_a_damaged_e57_is_refused(tmp_path):
    pytest.importorskip("pye57", reason="pye57 is not installed")
    path = tmp_path / "scan.e57"
    path.write_bytes(b"ASTM-E57" + bytes(100))
    with pytest.raises(FormatError, match="this is no whole E57 file"):
        read_scan(path)


@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_points_that_are_withheld_or_noise_are_none(tmp_path, suffix):
    laspy = pytest.importorskip("laspy", reason="laspy is not installed")
    path = las_file(tmp_path / f"scan{suffix}", np.tile(SURVEY, (4, 1)))
    with laspy.open(path) as reader:
        cloud = reader.read()
    cloud.classification = np.array([2, 2, 7, 5, 2, 2, 18, 7, 2, 2, 2, 2], np.uint8)
    cloud.withheld = np.arange(12) == 4
    cloud.write(path)
    scan = read_scan(path)
    assert np.flatnonzero(~scan.valid).tolist() == [2, 4, 6, 7]
    assert scan.notes == (
        "1 of 12 rows is withheld, as the file says, and left out",
        "3 of 12 rows are noise, as the file says, and left out",
    )


def test_a_decoder_that_ends_its_process_ends_not_ours(tmp_path, monkeypatch):
    pytest.importorskip("lazrs", reason="lazrs is not installed")
    path = las_file(tmp_path / "scan.laz")
    (tmp_path / "sitecustomize.py").write_text(
        "import os, sys\nif 'pointchart.io.unpack_laz' in sys.orig_argv: os.abort()\n"
    )
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=":")
    with pytest.raises(FormatError, match=r"this is no whole LAS or LAZ file \(.*\); copy or export it again"):
        read_scan(path)


def test_a_count_that_no_file_of_that_size_holds_is_refused_at_once(tmp_path):
    path = las_file(tmp_path / "scan.laz", np.tile(SURVEY, (1000, 1)))
    content = bytearray(path.read_bytes())
    content[107:111] = b"\xff" * 4
    path.write_bytes(content)
    with pytest.raises(FormatError, match=r"4294967295 points are in no \d+ bytes"):
        read_scan(path)


@pytest.mark.parametrize("seed", range(8))
def test_damaged_laz_is_read_or_refused(tmp_path, seed):
    pytest.importorskip("lazrs", reason="lazrs is not installed")
    path = las_file(tmp_path / "scan.laz", np.tile(SURVEY, (400, 1)))
    content = bytearray(path.read_bytes())
    draw = np.random.default_rng(seed)
    for place in draw.integers(227, len(content), 12):
        content[place] = draw.integers(256)
    path.write_bytes(content)
    try:
        n_points = len(read_scan(path).points)
    except FormatError:
        return
    assert n_points > 0
