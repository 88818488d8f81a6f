"""PTS and PTX of laser scanners."""

import numpy as np
import pytest

from pointchart.errors import FormatError
from pointchart.io import read_scan

TURN = "0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n"  # a quarter turn to the left about z, then a shift
POSE = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
STILL = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"


@pytest.fixture
def scan_of(tmp_path):
    def read(text, suffix):
        path = tmp_path / f"scan{suffix}"
        path.write_text(text)
        return read_scan(path)

    return read


def test_scans_of_a_ptx_file_come_in_their_common_frame(scan_of):
    first = f"2\n1\n{POSE}{STILL}1 2 3 0.5\n0 0 0 0.5\n"
    second = f"1\n2\n{POSE}{TURN}0 0 0 0.5\n1 2 3 0.25\n"
    scan = scan_of(first + "\n" + second, ".ptx")
    assert scan.valid.tolist() == [True, False, False, True]
    np.testing.assert_array_equal(scan.points[scan.valid], [[1, 2, 3], [10 - 2, 20 + 1, 30 + 3]])
    np.testing.assert_array_equal(scan.attributes["intensity"], [0.5, 0.5, 0.5, 0.25])
    assert scan.notes == ("2 of 4 rows are no point, and left out",)


def test_colours_that_all_scans_have_are_kept(scan_of):
    colored = f"1\n1\n{POSE}{STILL}1 2 3 0.5 9 8 7\n"
    assert list(scan_of(colored * 2, ".ptx").attributes) == ["intensity", "red", "green", "blue"]
    assert list(scan_of(colored + f"1\n1\n{POSE}{STILL}1 2 3 0.5\n", ".ptx").attributes) == ["intensity"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (f"2\n2\n{POSE}{STILL}1 2 3 0.5\n", "ends after 1 of 4 points"),
        (f"1\n1\n{POSE}{STILL}1 2 3 0.5\n1 2 3 4\n", "line 12 '1 2 3 4' begins no scan"),
        (f"1\n1\n{POSE}1 0 0\n0 1 0\n0 0 1\n0 0 0\n1 2 3 4\n", "line 7 '1 0 0' has 3 numbers where 4 are due"),
        ("1 2 3\n", "line 1 '1 2 3' begins no scan"),
    ],
)
def test_a_damaged_ptx_file_is_refused(scan_of, text, message):
    with pytest.raises(FormatError, match=message):
        scan_of(text, ".ptx")


@pytest.mark.parametrize(
    ("behind", "names"),
    [
        ("", []),
        (" 5", ["intensity"]),
        (" 1 2 3", ["red", "green", "blue"]),
        (" -900 1 2 3", ["intensity", "red", "green", "blue"]),
        (" 1 2", ["column_4", "column_5"]),
    ],
)
def test_columns_of_a_pts_file_are_known_by_their_number(scan_of, behind, names):
    scan = scan_of(f"2\n1 2 3{behind}\n4 5 6{behind}\n", ".pts")
    np.testing.assert_array_equal(scan.points, [[1, 2, 3], [4, 5, 6]])
    assert list(scan.attributes) == names


def test_clouds_of_a_pts_file_are_joined(scan_of):
    scan = scan_of("2\n1 2 3 7\n4 5 6 8\n1\n7 8 9 9\n", ".pts")
    np.testing.assert_array_equal(scan.points, np.arange(1.0, 10).reshape(3, 3))
    np.testing.assert_array_equal(scan.attributes["intensity"], [7, 8, 9])


def test_a_pts_file_without_a_count_is_text(scan_of):
    np.testing.assert_array_equal(scan_of("x,y,z\n1,2,3\n", ".pts").points, [[1, 2, 3]])


def test_rows_behind_the_count_of_a_pts_file_are_named(scan_of):
    scan = scan_of("1\n1 2 3\n4 5 6\n7 8 9\n", ".pts")
    np.testing.assert_array_equal(scan.points, [[1, 2, 3]])
    assert scan.notes == ("2 rows behind the points announced passed over",)


def test_a_pts_file_that_ends_early_is_refused(scan_of):
    with pytest.raises(FormatError, match="line 4 promises 5 points, but 1 follow"):
        scan_of("1\n1 2 3\n\n5\n4 5 6\n", ".pts")
