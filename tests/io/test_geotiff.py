"""Heights of GeoTIFF."""

import numpy as np
import pytest

from pointchart.errors import FormatError
from pointchart.io import read_scan

tifffile = pytest.importorskip("tifffile", reason="tifffile is not installed")
HEIGHTS = np.array([[1.0, 2, 3], [4, -9, 6]], np.float32)
PIXEL, PLACE = (33550, 12, 3, (10.0, 5.0, 0.0)), (33922, 12, 6, (0.0, 0.0, 0.0, 100.0, 200.0, 0.0))
NO_DATA, IS_POINT = (42113, 2, 0, "-9"), (34735, 3, 8, (1, 1, 0, 1, 1025, 0, 1, 2))


@pytest.mark.parametrize("compression", [None, "zlib"])
@pytest.mark.parametrize("suffix", [".tif", ".tiff"])
def test_pixels_are_points_at_their_middles(tmp_path, compression, suffix):
    path = tmp_path / f"dem{suffix}"
    tifffile.imwrite(path, HEIGHTS, extratags=[PIXEL, PLACE, NO_DATA], compression=compression)
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points[:, 0], [105, 115, 125] * 2)
    np.testing.assert_array_equal(scan.points[:, 1], np.repeat([197.5, 192.5], 3))
    np.testing.assert_array_equal(scan.points[:, 2], HEIGHTS.ravel())
    assert np.flatnonzero(~scan.valid).tolist() == [4]


def test_places_may_be_those_of_middles(tmp_path):
    tifffile.imwrite(tmp_path / "dem.tif", HEIGHTS, extratags=[PIXEL, PLACE, IS_POINT])
    np.testing.assert_array_equal(read_scan(tmp_path / "dem.tif").points[0], [100, 200, 1])


def test_an_image_without_a_place_and_a_damaged_file_are_refused(tmp_path, capsys):
    path = tmp_path / "dem.tif"
    tifffile.imwrite(path, HEIGHTS)
    with pytest.raises(FormatError, match=r"without size and place of its pixels; gdal_translate -of XYZ"):
        read_scan(path)
    path.write_bytes(path.read_bytes()[:20])
    with pytest.raises(FormatError, match="this is no TIFF that can be read"):
        read_scan(path)
    assert capsys.readouterr().err == ""
