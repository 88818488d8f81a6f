"""Fields of text: quotes, words, numbers that are none."""

import numpy as np
import pytest

from pointchart.errors import FormatError
from pointchart.io import read_scan


@pytest.fixture
def scan_of(tmp_path):
    def read(text, suffix=".csv"):
        path = tmp_path / f"scan{suffix}"
        path.write_text(text, encoding="utf-8")
        return read_scan(path)

    return read


@pytest.mark.parametrize(
    "word",
    ["1.#QNAN", "-1.#IND", "1.#INF00", "1.#SNAN", "-1.#IND00", "nan(ind)", "-nan(ind)", "NA", "N/A", "NULL", "null"],
)
@pytest.mark.parametrize("separator", [" ", ",", ";", "\t"])
def test_what_is_no_number_is_none_and_starts_no_comment(scan_of, word, separator):
    points = scan_of(f"1 2 3\n4 5 {word}\n{word} 8 9 # a comment\n".replace(" ", separator, 6)).points
    assert np.isnan(points[1, 2])
    assert np.isnan(points[2, 0])
    assert points[2, 2] == 9


@pytest.mark.parametrize(
    ("rows", "points"),
    [
        ('"694,385.513","5,155,563.964","381.559"\n', [[694385.513, 5155563.964, 381.559]]),
        ('"1,234,567","2","3"\n"1,234","5","6"\n', [[1234567, 2, 3], [1234, 5, 6]]),
        ('"694385,513","2,5","3"\n', [[694385.513, 2.5, 3]]),
        ('"1,5","2,25","381,559"\n', [[1.5, 2.25, 381.559]]),
        ('"1.5","2.25","3"\n', [[1.5, 2.25, 3]]),
        ('"a, b","1","2","3"\n"c","4","5","6"\n', [[1, 2, 3], [4, 5, 6]]),
    ],
)
def test_a_comma_in_quotes_separates_nothing(scan_of, rows, points):
    np.testing.assert_array_equal(scan_of(rows).points, points)


@pytest.mark.parametrize("rows", ['"381,559","2","3"\n', '"1,234,567","2,5","3"\n'])
def test_a_comma_in_quotes_that_may_mean_either_is_asked_about(scan_of, rows):
    with pytest.raises(FormatError, match="a comma may group thousands or be decimal; write the numbers with a point"):
        scan_of(rows)


@pytest.mark.parametrize(
    ("text", "note"),
    [
        ("name,x,y,z\nP 1,1,2,3\nP 2,4,5,6\n", "column name holds words ('P 1') and is left out"),
        ("P1 1 2 3\nP2 4 5 6\n", "column 1 holds words ('P1') and is left out"),
        ("1;2;3;GRD\n4;5;6;TREE\n", "column 4 holds words ('GRD') and is left out"),
        ("P1 1,0 2,0 3,0\nP2 4,0 5,0 6,0\n", "column 1 holds words ('P1') and is left out"),
    ],
)
def test_columns_of_words_are_left_out_and_named(scan_of, text, note):
    scan = scan_of(text)
    np.testing.assert_array_equal(scan.points, [[1, 2, 3], [4, 5, 6]])
    assert scan.notes == (note,)


def test_a_coordinate_in_words_is_refused(scan_of):
    with pytest.raises(FormatError, match=r"column 3 holds words \('low'\), not coordinates"):
        scan_of("x,y,z,a\n1,2,low,4\n5,6,high,8\n")


def test_a_row_of_another_length_among_words_is_named(scan_of):
    with pytest.raises(FormatError, match="line 3 'P3 7 8' is not a row of numbers"):
        scan_of("P1 1 2 3\nP2 4 5 6\nP3 7 8\n", ".txt")
