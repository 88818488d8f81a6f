"""Headers as people and programs write them, and first columns that are no coordinates."""

import numpy as np
import pytest

from pointchart.errors import FormatError, Remedy
from pointchart.io import read_scan

POINTS = np.random.default_rng(2).uniform(-5.0, 5.0, (60, 3))
ROWS = POINTS.tolist()


def text_of(rows, separator=","):
    return "".join(separator.join(map(str, row)) + "\n" for row in rows)


@pytest.fixture
def scan_of(tmp_path):
    def read(text, suffix=".csv", **options):
        path = tmp_path / f"scan{suffix}"
        path.write_text(text, encoding="utf-8")
        return read_scan(path, **options)

    return read


@pytest.mark.parametrize(
    "header",
    [
        "X(mm),Y(mm),Z(mm)",
        "X [m],Y [m],Z [m]",
        "X_m,Y_m,Z_m",
        "pos_x,pos_y,pos_z",
        "pX,pY,pZ",
        "x_coord,y_coord,z_coord",
        "position.x,position.y,position.z",
        '"Points:0","Points:1","Points:2"',
        "Points_0,Points_1,Points_2",
        "Easting,Northing,Elevation",
        "EAST (m),NORTH (m),HEIGHT (m)",
        "E,N,H",
        "Rechtswert,Hochwert,Höhe",
        "//X,Y,Z",
        "# x,y,z",
        "title\nX,Y,Z\nm,m,m",
    ],
)
def test_coordinates_are_known_by_the_names_that_people_give_them(scan_of, header):
    id_first = "\n".join("id," + line if i == header.count("\n") else line for i, line in enumerate(header.split("\n")))
    units_below = header.endswith("m,m,m")
    if not units_below and "#" not in header and "//" not in header:
        with_id = scan_of(id_first + "\n" + text_of([7, *row] for row in ROWS))
        np.testing.assert_array_equal(with_id.points, POINTS)
        assert list(with_id.attributes) == ["id"]
    np.testing.assert_array_equal(scan_of(header + "\n" + text_of(ROWS)).points, POINTS)


def test_axes_are_taken_in_the_order_of_the_header_and_not_of_the_file(scan_of):
    scan = scan_of("Northing;Easting;Elevation\n" + text_of(ROWS, ";"))
    np.testing.assert_array_equal(scan.points, POINTS[:, [1, 0, 2]])


@pytest.mark.parametrize("header", ["a,b,c", "time,temp,volt", "x,y,temp", "x,y,height,elevation", "# a,b,c"])
def test_a_header_that_names_no_coordinates_is_quoted_and_columns_are_asked_for(scan_of, header):
    rows = [[*row, 0.5][: header.count(",") + 1] for row in ROWS]
    with pytest.raises(FormatError) as refused:
        scan_of(header + "\n" + text_of(rows))
    assert f"the header '{header.lstrip('# ')}' names {header.count(',') + 1} columns" in str(refused.value)
    assert refused.value.remedies == (Remedy.choose_columns,)
    chosen = scan_of(header + "\n" + text_of(rows), columns=("1", "2", "3"))
    np.testing.assert_array_equal(chosen.points, POINTS)


@pytest.mark.parametrize("header", ["X_local,Y_local,Z_local,X_utm,Y_utm,Z_utm", "x_m,y_m,z_m,Easting,Northing,Height"])
def test_of_two_systems_of_coordinates_none_is_guessed(scan_of, header):
    with pytest.raises(FormatError, match="names 6 columns, not one each x, y and z"):
        scan_of(header + "\n" + text_of([*row, *row] for row in ROWS))


def test_longitude_and_latitude_are_named_as_degrees(scan_of):
    with pytest.raises(
        FormatError, match="names longitude and latitude, which are degrees and no lengths; project them"
    ):
        scan_of("lat,lon,height\n" + text_of(ROWS))


def test_columns_are_chosen_by_name_or_number_with_or_without_a_header(scan_of):
    rows = [[1, row[2], 9, row[0], row[1]] for row in ROWS]
    for header, columns in (
        ("t,up,q,a,b\n", ("A", "b", "up")),
        ("", ("4", "5", "2")),
        ("t,x,y,z,b\n", ("4", "b", "2")),
    ):
        np.testing.assert_array_equal(scan_of(header + text_of(rows), columns=columns).points, POINTS)
    assert list(scan_of("t,x,y,z,b\n" + text_of(rows), columns=("4", "b", "2")).attributes) == ["t", "y_3"]
    with pytest.raises(FormatError, match=r"'6' is none of the 5 columns \(1, 2, 3, 4, 5\)"):
        scan_of(text_of(rows), columns=("4", "5", "6"))
    with pytest.raises(FormatError, match=r"\.npy names its coordinates itself; choose columns of text files only"):
        read_scan("scan.npy", columns=("1", "2", "3"))


def test_names_of_rows_are_told_where_the_header_leaves_them_out(scan_of):
    named = scan_of("x y z red\n" + text_of([[f'"p{i}"', *row, 9] for i, row in enumerate(ROWS)], " "), ".txt")
    counted = scan_of("x y z red\n" + text_of([[i, *row, 9] for i, row in enumerate(ROWS)], " "), ".txt")
    for scan, names in ((named, ["red"]), (counted, ["row_name", "red"])):
        np.testing.assert_array_equal(scan.points, POINTS)
        assert list(scan.attributes) == names
    assert named.notes == ("column row_name holds words ('p0') and is left out",)


@pytest.mark.parametrize("first", [0, 1, 1000])
def test_a_first_column_that_counts_the_rows_is_not_x(scan_of, first):
    scan = scan_of(text_of([first + i, *row] for i, row in enumerate(ROWS)))
    np.testing.assert_array_equal(scan.points, POINTS)
    (note,) = scan.notes
    assert note.startswith(f"column 1 counts the rows ({first}, {first + 1}, {first + 2} ...)")
    as_told = scan_of(text_of([first + i, *row] for i, row in enumerate(ROWS)), columns=("1", "2", "3"))
    np.testing.assert_array_equal(as_told.points[:, 0], first + np.arange(60.0))


@pytest.mark.parametrize(
    ("column", "what"),
    [
        (1000.0 + 0.01 * np.arange(60), "rises evenly from row to row (1000, 1000.01, 1000.02 ...), as a time"),
        (3 * np.arange(60), "rises evenly from row to row (0, 3, 6 ...), as a time or a counter does"),
    ],
)
def test_a_first_column_of_times_is_asked_about(scan_of, column, what):
    with pytest.raises(FormatError) as refused:
        scan_of(text_of([t, *row] for t, row in zip(column.tolist(), ROWS, strict=True)))
    assert f"column 1 {what}" in str(refused.value)
    assert refused.value.remedies == (Remedy.choose_columns,)


def test_a_first_column_of_classes_is_asked_about(scan_of):
    many = np.random.default_rng(4).uniform(-5.0, 5.0, (200, 3)).tolist()
    with pytest.raises(FormatError, match=r"column 1 holds 2 whole numbers only \(2, 5\), as classes are"):
        scan_of(text_of([5 if i % 3 else 2, *row] for i, row in enumerate(many)))


@pytest.mark.parametrize("order", ["sorted by x", "a grid by rows", "a grid by columns"])
def test_coordinates_in_order_are_not_taken_for_times_or_classes(scan_of, order):
    x, y = np.meshgrid(np.arange(40.0), np.arange(30.0))
    grid = np.column_stack([x.ravel(), y.ravel(), np.zeros(1200), np.ones(1200)])
    points = {
        "sorted by x": np.column_stack([POINTS[np.argsort(POINTS[:, 0])], np.ones(60)]),
        "a grid by rows": grid,
        "a grid by columns": grid[np.lexsort([grid[:, 1], grid[:, 0]])],
    }[order]
    scan = scan_of(text_of(points.tolist()))
    np.testing.assert_array_equal(scan.points, points[:, :3])
    assert scan.notes == ()


def test_upper_case_is_understood_in_every_format(tmp_path):
    fields = np.array([(1.0, 2.0, 3.0)], dtype=[("X", "f8"), ("Y", "f8"), ("Z", "f8")])
    np.save(tmp_path / "a.npy", fields)
    header = "ply\nformat ascii 1.0\nelement vertex 1\n"
    header += "".join(f"property float {axis}\n" for axis in "XYZ") + "end_header\n1 2 3\n"
    (tmp_path / "a.ply").write_text(header)
    for name in ("a.npy", "a.ply"):
        np.testing.assert_array_equal(read_scan(tmp_path / name).points, [[1, 2, 3]])
