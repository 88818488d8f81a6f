"""Point clouds as text: XYZ, TXT, CSV and ASC, whatever stands between the numbers.

A header names the columns; without one the first three columns of numbers are x, y, z, unless the first counts the
rows. A column without a name is `column_4`, `column_5`, ...: colours and normals are never guessed. Columns of words
are left out. A comma is a decimal comma when something else separates the columns. An empty field between two commas
or semicolons is read as not-a-number.
"""

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

from ..errors import FormatError, Remedy
from ..typing import Floats
from .column_names import angles_among, coordinates_among, named_columns
from .first_column import is_row_number, what_else_than_x
from .scan import Scan, scan_from_columns
from .source import AnyPath, read_lines, split_suffix
from .table import is_index, is_number, parse_rows
from .text_fields import COMMENT, Fields, blank_separated, plain_text, rough_fields, separator_of

# What stands behind x, y, z in files of these suffixes (Open3D).
_BEHIND = {".xyzn": ("nx", "ny", "nz"), ".xyzrgb": ("red", "green", "blue"), ".xyzi": ("intensity",)}
ROW_NAME = "row_name"  # what the first column is called where the header names all the others, as R writes it
Columns = tuple[str, str, str]


@dataclass(frozen=True, slots=True)
class _Header:
    """A line above the rows that may name the columns."""

    text: str
    is_comment: bool


@dataclass(frozen=True, slots=True)
class _Layout:
    """Where the rows start (0-based line), what separates their fields, and what stands above them."""

    start: int
    separator: str | None
    headers: list[_Header]
    promised: int | None


def read_text(path: AnyPath, columns: Columns | None = None) -> Scan:
    """Read rows of three or more numbers; see the module for headers and separators."""
    lines = read_lines(path)
    layout = _layout(lines, path)
    fields = blank_separated(plain_text(path, "\n".join(lines[layout.start :])), layout.separator)
    numbers = range(layout.start + 1, len(lines) + 1)
    del lines  # as large as the rows
    table = parse_rows(fields.rows, path=path, line_numbers=numbers, least=3)
    if layout.promised is not None and layout.promised != len(table):
        raise FormatError(
            f"{path}: line {layout.start} promises {layout.promised} points, but {len(table)} follow; "
            "correct the count or export the file again"
        )
    if table.shape[1] + len(fields.words) != fields.n_columns:  # blanks within fields that something else separates
        fields = Fields(fields.rows, {}, table.shape[1])
    return _scan(path, layout, fields, table, columns)


def _layout(lines: list[str], path: AnyPath) -> _Layout:
    """Find the first row of numbers: at least three, or half of the fields."""
    headers: list[_Header] = []
    promised = None
    for i, line in enumerate(lines):
        content = COMMENT.sub("", line).strip()
        if not content:
            if line.strip():
                headers.append(_Header(line.strip().lstrip("#/ \t"), is_comment=True))
            continue
        fields = rough_fields(content)
        n_numbers = sum(map(is_number, fields))
        if n_numbers < 3 and 2 * n_numbers < len(fields):
            headers.append(_Header(content, is_comment=False))
        elif promised is None and len(fields) == 1 and is_index(fields[0].lstrip("-")):
            promised = int(fields[0])
        else:
            return _Layout(i, separator_of(content), headers, promised)
    found = "no row" if promised is None else "a count but no row"
    raise FormatError(f"{path}: {found} of numbers stands in its {len(lines)} lines; give one line 'x y z' a point")


def _scan(path: AnyPath, layout: _Layout, fields: Fields, table: Floats, columns: Columns | None) -> Scan:
    """Name the columns of numbers, and say what is left out or read otherwise than by its place."""
    header, names = _header(layout, fields, split_suffix(path)[0])
    kept = [place for place in range(fields.n_columns) if place not in fields.words]
    notes = [
        f"column {names[place] or place + 1} holds words ({_quoted(word)}) and is left out"
        for place, word in fields.words.items()
    ]
    if columns is not None:
        coordinates = _chosen(path, names, columns, fields)
    elif header is not None:
        coordinates = _named(path, header, names, fields)
    else:
        coordinates, said = _by_place(path, table, kept)
        notes += said
    named = named_columns(coordinates, names)
    found = {named[place]: column for place, column in zip(kept, table.T, strict=True)}
    return scan_from_columns(path, found, notes=notes)


def _header(layout: _Layout, fields: Fields, suffix: str) -> tuple[str | None, list[str]]:
    """Choose the line that names the columns, and return it with the names; none names them if no line does."""
    n_columns = fields.n_columns
    unsure: tuple[str | None, list[str]] = None, _names_by_suffix(suffix, n_columns)
    for header in reversed(layout.headers):
        by_any = re.split(r"[\s,;]+", header.text.replace('"', "").strip(" \t,;"))
        for names in (_split_header(header.text, layout.separator), by_any):
            if len(names) == n_columns - 1:
                names = [ROW_NAME, *names]
            if len(names) != n_columns:
                continue
            if coordinates_among(names) or angles_among(names):
                return header.text, names
            # A comment may be prose of as many words as there are columns, unless it is separated as they are.
            is_sure = layout.separator is not None and layout.separator in header.text
            if unsure[0] is None and (is_sure or not header.is_comment) and ROW_NAME not in names:
                unsure = header.text, names
    return unsure


def _names_by_suffix(suffix: str, n_columns: int) -> list[str]:
    """Name the columns that the suffix tells of, as Open3D has them."""
    behind = _BEHIND.get(suffix, ())
    return [""] * n_columns if n_columns != 3 + len(behind) else ["", "", "", *behind]


def _split_header(text: str, separator: str | None) -> list[str]:
    if separator is None:
        return text.replace('"', "").split()
    return [name.strip() for name in next(csv.reader([text], delimiter=separator), [])]


def _named(path: AnyPath, header: str, names: list[str], fields: Fields) -> Sequence[int]:
    """Return the places of x, y, z that the header names."""
    coordinates, angles = coordinates_among(names), angles_among(names)
    shown = header.strip()[:80]
    if coordinates is None and angles is not None:
        raise FormatError(
            f"{path}: the header '{shown}' names longitude and latitude, which are degrees and no lengths; project "
            "them to metres first, as with PROJ or QGIS"
        )
    if coordinates is None:
        raise FormatError(
            f"{path}: the header '{shown}' names {len(names)} columns, not one each x, y and z",
            remedies=[Remedy.choose_columns],
        )
    return _of_numbers(path, coordinates, fields)


def _chosen(path: AnyPath, names: list[str], columns: Columns, fields: Fields) -> Sequence[int]:
    """Return the places of the columns chosen by name or by number from 1."""
    places = []
    for column in columns:
        matches = [place for place, name in enumerate(names) if name.strip().lower() == column.lower()]
        if not matches and is_index(column) and 1 <= int(column) <= len(names):
            matches = [int(column) - 1]
        if len(matches) != 1:
            known = ", ".join(name.strip() or str(place + 1) for place, name in enumerate(names))
            raise FormatError(
                f"{path}: '{column}' is none of the {len(names)} columns ({known}); give a name, or a number from 1"
            )
        places.append(matches[0])
    return _of_numbers(path, places, fields)


def _of_numbers(path: AnyPath, places: Sequence[int], fields: Fields) -> Sequence[int]:
    for place in places:
        if place in fields.words:
            raise FormatError(
                f"{path}: column {place + 1} holds words ({_quoted(fields.words[place])}), not coordinates",
                remedies=[Remedy.choose_columns],
            )
    return places


def _by_place(path: AnyPath, table: Floats, kept: list[int]) -> tuple[Sequence[int], list[str]]:
    """Take the first three columns of numbers, without one that counts the rows."""
    if table.shape[1] < 4:
        return kept[:3], []
    first, number = table[:, 0], kept[0] + 1
    if is_row_number(first):
        said = (
            f"column {number} counts the rows ({first[0]:g}, {first[1]:g}, {first[2]:g} ...), so x, y, z are the next"
        )
        return kept[1:4], [said]
    if (other := what_else_than_x(first)) is not None:
        raise FormatError(f"{path}: column {number} {other}, not x", remedies=[Remedy.choose_columns])
    return kept[:3], []


def _quoted(word: str) -> str:
    return f"'{word[:40]}'"
