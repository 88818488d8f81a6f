"""Text clouds: one table of numbers, whatever stands between, above and beside them."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from pointchart.errors import FormatError
from pointchart.io import read_scan

ROWS = ["1.5 2 -3e2", "4 5.25 6", "7 8 9"]
POINTS = [[1.5, 2, -300], [4, 5.25, 6], [7, 8, 9]]
doubles = st.floats(allow_nan=False, allow_infinity=False)


@pytest.fixture
def scan_of(tmp_path):
    def read(content, suffix=".xyz"):
        path = tmp_path / f"scan{suffix}"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_scan(path)

    return read


@pytest.mark.parametrize("suffix", [".xyz", ".txt", ".csv", ".pts", ".asc"])
@pytest.mark.parametrize("separator", [" ", "   ", "\t", ",", ", ", " , ", ";", "; ", "\t;\t"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_every_separator_and_line_end_gives_the_same_points(scan_of, suffix, separator, end):
    scan = scan_of("".join(row.replace(" ", separator) + end for row in ROWS), suffix)
    np.testing.assert_array_equal(scan.points, POINTS)
    assert scan.attributes == {}
    assert scan.triangles.shape == (0, 3)


@pytest.mark.parametrize("separator", [";", "; ", "\t", " ", "  "])
def test_a_comma_is_decimal_when_something_else_separates_the_columns(scan_of, separator):
    scan = scan_of("".join(row.replace(".", ",").replace(" ", separator) + "\n" for row in ROWS))
    np.testing.assert_array_equal(scan.points, POINTS)


@pytest.mark.parametrize("separator", [";", "\t", " "])
def test_a_decimal_comma_may_appear_first_in_a_later_row(scan_of, separator):
    scan = scan_of("1 2 3\n4,5 5 6\n".replace(" ", separator))
    np.testing.assert_array_equal(scan.points, [[1, 2, 3], [4.5, 5, 6]])


@given(points=arrays(float, st.tuples(st.integers(1, 5), st.just(3)), elements=doubles))
@settings(max_examples=50, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_the_shortest_text_of_a_double_comes_back_as_that_double(scan_of, points):
    text = "\n".join(" ".join(map(repr, row)) for row in points.tolist())
    np.testing.assert_array_equal(scan_of(text).points, points)


@pytest.mark.parametrize("mark", [b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff"])
def test_byte_order_marks_are_understood(scan_of, mark):
    encoding = {b"\xef\xbb\xbf": "utf-8", b"\xff\xfe": "utf-16-le", b"\xfe\xff": "utf-16-be"}[mark]
    scan = scan_of(mark + "x;y;z;Höhe\n1;2;3;4\n".encode(encoding), ".csv")
    np.testing.assert_array_equal(scan.points, [[1, 2, 3]])
    assert list(scan.attributes) == ["Höhe"]


def test_comments_and_blank_lines_may_stand_anywhere(scan_of):
    scan = scan_of("# a scan of 3 points\n\n1 2 3\n  \n// middle\n4 5 6 # the second\n7 8 9\n\n#end")
    np.testing.assert_array_equal(scan.points, np.arange(1, 10).reshape(3, 3))


@pytest.mark.parametrize(
    "header", ["x y z red my-label", "X Y Z red my-label", "title\nx y z red my-label", "# x y z red my-label"]
)
def test_a_header_names_the_columns(scan_of, header):
    scan = scan_of(f"{header}\n1 2 3 255 7\n4 5 6 254 8\n", ".txt")
    np.testing.assert_array_equal(scan.points, [[1, 2, 3], [4, 5, 6]])
    assert list(scan.attributes) == ["red", "my-label"]
    np.testing.assert_array_equal(scan.attributes["red"], [255, 254])


def test_a_comment_of_cloudcompare_names_the_columns(scan_of):
    assert list(scan_of("//X,Y,Z,R,G,B\n1,2,3,4,5,6\n", ".asc").attributes) == ["R", "G", "B"]


def test_coordinates_are_found_by_name_behind_other_columns(scan_of):
    scan = scan_of('"id","z","x","y"\n"17","3","1","2"\n', ".csv")
    np.testing.assert_array_equal(scan.points, [[1, 2, 3]])
    np.testing.assert_array_equal(scan.attributes["id"], [17])


def test_a_name_may_hold_blanks_when_a_character_separates_the_columns(scan_of):
    assert list(scan_of("x;y;z;scan angle\n1;2;3;4\n", ".csv").attributes) == ["scan angle"]


@pytest.mark.parametrize("header", ["", "# measured in a big hall\n", "title\n"])
def test_columns_without_a_name_are_numbered_and_not_guessed(scan_of, header):
    scan = scan_of(header + "1 2 3 255 0 0.5\n")
    assert list(scan.attributes) == ["column_4", "column_5", "column_6"]


def test_columns_of_one_name_are_told_apart(scan_of):
    assert list(scan_of("x,y,z,a,a,\n1,2,3,4,5,6\n", ".csv").attributes) == ["a", "a_5", "column_6"]


def test_an_empty_field_is_not_a_number_and_a_last_separator_is_nothing(scan_of):
    scan = scan_of("x;y;z;red;green\n1;2;3;;5;\n4;5;6; ;7;\n", ".csv")
    np.testing.assert_array_equal(scan.attributes["green"], [5, 7])
    assert np.isnan(scan.attributes["red"]).all()


def test_not_a_number_and_infinity_are_passed_on(scan_of):
    points = scan_of("1 nan 3\nNaN 5 -inf\n").points
    np.testing.assert_array_equal(points, [[1, np.nan, 3], [np.nan, 5, -np.inf]])


def test_a_first_line_with_the_number_of_points_is_checked_and_passed_over(scan_of):
    scan = scan_of("2\n1 2 3 -1000 9 8 7\n4 5 6 -900 9 8 7\n")
    np.testing.assert_array_equal(scan.points, [[1, 2, 3], [4, 5, 6]])
    assert list(scan.attributes) == ["column_4", "column_5", "column_6", "column_7"]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("x y z\n1 2 3\n4 five 6\n", "line 3 '4 five 6' is not a row of numbers; correct it or start it with #"),
        ("1 2 three\n", "line 1 '1 2 three' is not a row of numbers"),
        ("1 2 3\n\n# c\n4 5\n", "line 4 '4 5' has 2 numbers where 3 are due"),
        ("1,2,3\n4,5,6,7\n", "line 2 '4 5 6 7' has 4 numbers where 3 are due"),
        ("1 2 3\n4 5 6_0\n", "line 2 '4 5 6_0' is not a row of numbers"),
        ("x y\n1 2\n3 4\n", "line 2 '1 2' has 2 numbers where at least 3 are due"),
        ("1\n2\n3\n", "line 2 '2' has 1 numbers where at least 3 are due"),
        ("1,5 2,5\n", "line 1 '1.5 2.5' has 2 numbers where at least 3"),
        ("3\n1 2 3\n4 5 6\n", "line 1 promises 3 points, but 2 follow"),
        ("-1\n1 2 3\n", "line 1 promises -1 points, but 1 follow"),
        ("99999999999999\n1 2 3\n", "line 1 promises 99999999999999 points, but 1 follow"),
        ("5\n", "a count but no row of numbers stands in its 2 lines"),
        (" \n\n", "no row of numbers stands in its 3 lines"),
        ("only words\nand more\n", "no row of numbers stands in its 3 lines"),
        ("ncols 4\nnrows 5\n1 2 3 4\n", "line 1 'ncols 4' is not a row of numbers"),
        (b"1 2 3\n\0\0\0", "byte 6 is zero, so this is no text file"),
    ],
)
def test_a_damaged_file_is_refused_with_line_and_text(scan_of, content, message):
    with pytest.raises(FormatError, match=message):
        scan_of(content)
