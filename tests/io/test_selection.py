"""Rows that are points, and rows that are none."""

import numpy as np
import pytest

from pointchart.errors import InputError, Remedy
from pointchart.io import Scan, usable_rows

SHEET = np.array([[x, y, 10.0] for x in range(6) for y in range(6)], float)


def scan_of(points, **attributes):
    return Scan(np.asarray(points, float), np.empty((0, 3), np.int64), attributes)


def test_every_row_of_a_sound_scan_is_a_point():
    rows, notes = usable_rows(scan_of(SHEET))
    assert rows.tolist() == list(range(36))
    assert notes == []


@pytest.mark.parametrize(
    ("rows_more", "what"),
    [([[np.nan] * 3, [1, np.inf, 2]], "2 rows without coordinates"), ([[0, 0, 0]] * 3, "3 rows of exactly 0 0 0")],
)
def test_rows_that_are_no_points_are_counted_and_left_out_only_if_asked_for(rows_more, what):
    scan = scan_of(np.r_[SHEET[:5], rows_more, SHEET[5:]])
    with pytest.raises(InputError, match=f"there are {what}, the first is row 5") as refused:
        usable_rows(scan)
    assert refused.value.remedies == (Remedy.leave_out_invalid,)
    rows, notes = usable_rows(scan, drop_invalid=True)
    np.testing.assert_array_equal(scan.points[rows], SHEET)
    assert notes == [f"{what} left out"]


def test_an_origin_on_the_surface_is_a_point_however_often_it_stands_there():
    flat = SHEET * [1, 1, 0]
    rows, _ = usable_rows(scan_of(np.r_[flat, flat[:1]]))
    assert len(rows) == 37


def test_what_the_format_calls_no_point_is_left_out_without_asking():
    scan = Scan(np.r_[SHEET, [[np.nan] * 3]], np.empty((0, 3), np.int64), {}, valid=np.arange(37) < 36)
    rows, notes = usable_rows(scan)
    assert rows.tolist() == list(range(36))
    assert notes == []


def test_classes_are_listed_and_chosen():
    classes = np.repeat([2, 5, 6], 12).astype(np.uint8)
    scan = scan_of(SHEET, classification=classes)
    assert usable_rows(scan)[1] == ["the scan holds points of classes 2 (12), 5 (12), 6 (12)"]
    rows, notes = usable_rows(scan, classes=[2, 6])
    np.testing.assert_array_equal(classes[rows], np.repeat([2, 6], 12))
    assert notes == ["12 points of other classes left out; the scan holds 2 (12), 5 (12), 6 (12)"]
    with pytest.raises(InputError, match=r"the scan has no point of class 9; it has classes 2 \(12\), 5"):
        usable_rows(scan, classes=[9])
    with pytest.raises(InputError, match=r"the scan has no classes among what it carries \(grey\)"):
        usable_rows(scan_of(SHEET, grey=classes), classes=[2])
