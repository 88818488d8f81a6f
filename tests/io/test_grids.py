"""ESRI ASCII grids, which have a suffix of point clouds."""

import numpy as np
import pytest

from pointchart.errors import FormatError
from pointchart.io import read_scan

CORNER = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -1\n"
HEIGHTS = "1 2 3\n4 -1 6\n"


@pytest.fixture
def scan_of(tmp_path):
    def read(text):
        path = tmp_path / "scan.asc"
        path.write_text(text)
        return read_scan(path)

    return read


@pytest.mark.parametrize(
    "text",
    [
        CORNER + HEIGHTS,
        CORNER.upper() + HEIGHTS,
        CORNER + "1 2\n3 4 -1\n6\n",
        CORNER.replace("corner 1", "center 1").replace("100", "105").replace("corner 200", "center 205") + HEIGHTS,
        CORNER.replace("cellsize 10", "dx 10\ndy 10") + HEIGHTS.replace("2", "2,0"),
    ],
)
def test_cells_of_a_grid_are_points_at_their_middles(scan_of, text):
    scan = scan_of(text)
    expected = [[105, 215, 1], [115, 215, 2], [125, 215, 3], [105, 205, 4], [115, 205, -1], [125, 205, 6]]
    np.testing.assert_array_equal(scan.points, expected)
    assert np.flatnonzero(~scan.valid).tolist() == [4]
    assert scan.notes == ("1 of 6 rows is no point, and left out",)


def test_other_files_of_that_suffix_are_text(scan_of):
    np.testing.assert_array_equal(scan_of("//X Y Z\n1 2 3\n").points, [[1, 2, 3]])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (CORNER + "1 2 3\n4 5\n", "5 heights follow where 3 columns and 2 rows take 6"),
        (CORNER + "1 2 3\n4 x 6\n", "a height is no number"),
        (CORNER.replace("10\n", "wide\n") + HEIGHTS, "line 5 'cellsize wide' gives no number"),
        (CORNER.replace("cellsize 10\n", "") + HEIGHTS, "has no whole ncols and nrows and a cellsize"),
        (CORNER.replace("ncols 3", "ncols 3.5") + HEIGHTS, "has no whole ncols and nrows and a cellsize"),
    ],
)
def test_a_damaged_grid_is_refused(scan_of, text, message):
    with pytest.raises(FormatError, match=message):
        scan_of(text)
