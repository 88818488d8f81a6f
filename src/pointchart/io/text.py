"""Point clouds as text: XYZ, TXT, CSV, ASC and PTS, whatever stands between the numbers.

The first three columns are x, y, z, unless a header names columns x, y and z. A column without a name is `column_4`,
`column_5`, ...: colours and normals are never guessed. A comma is a decimal comma when something else separates the
columns. An empty field between two commas or semicolons is read as not-a-number.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from ..errors import FormatError
from .scan import Scan, scan_from_columns
from .source import AnyPath, read_lines
from .table import is_index, is_number, parse_rows

_COMMENT = re.compile(r"(#|//)[^\n]*")  # programs mark comments and column names by one or the other
# A number whose comma is a decimal one: where all fields between blanks are such, no comma separates them.
_DECIMAL_COMMA = re.compile(r"[+-]?\d*(,\d+)?([eE][+-]?\d+)?")


@dataclass(frozen=True, slots=True)
class _Layout:
    """Where the rows start (0-based line), what separates their fields, and what stands above them."""

    start: int
    separator: str | None
    header: str | None
    is_header_comment: bool
    promised: int | None


def read_text(path: AnyPath, columns: tuple[str, str, str] | None = None) -> Scan:
    """Read rows of three or more numbers; see the module for headers and separators."""
    lines = read_lines(path)
    layout = _layout(lines, path)
    rows = _blank_separated("\n".join(lines[layout.start :]), layout.separator).split("\n")
    numbers = range(layout.start + 1, len(lines) + 1)
    del lines  # as large as the rows
    table = parse_rows(rows, path=path, line_numbers=numbers, least=3)
    if layout.promised is not None and layout.promised != len(table):
        raise FormatError(
            f"{path}: line {layout.start} promises {layout.promised} points, but {len(table)} follow; "
            "correct the count or export the file again"
        )
    names = _names(layout, table.shape[1])
    if columns is not None:
        names = _with_coordinates(path, names, columns)
    return scan_from_columns(path, dict(zip(names, table.T, strict=True)))


def column_names(n_columns: int, names: Iterable[str] = ()) -> list[str]:
    """Name the columns x, y, z, column_4, ... where `names` does not, and make every name differ from the others.

    >>> column_names(5), column_names(4, ["X", "Y", "Z", "Red"]), column_names(4, ["id", "x", "y", "z"])
    (['x', 'y', 'z', 'column_4', 'column_5'], ['x', 'y', 'z', 'Red'], ['id', 'x', 'y', 'z'])
    >>> column_names(4, ["east", "north", "up", "x"])
    ['x', 'y', 'z', 'x_4']
    """
    given = [name.strip() for name in names] or [""] * n_columns
    lowered = [name.lower() for name in given]
    if all(lowered.count(axis) == 1 for axis in "xyz"):
        given = [low if low in ("x", "y", "z") else name for low, name in zip(lowered, given, strict=True)]
    else:
        given[:3] = ["x", "y", "z"]
    unique: list[str] = []
    for number, name in enumerate(given, start=1):
        name = name or f"column_{number}"
        unique.append(f"{name}_{number}" if name in unique else name)
    return unique


def _with_coordinates(path: AnyPath, names: list[str], columns: tuple[str, str, str]) -> list[str]:
    """Call the columns chosen x, y, z; those that had these names get others."""
    places = []
    for column in columns:
        matches = [i for i, name in enumerate(names) if name.lower() == column.lower()]
        if not matches and is_index(column) and 1 <= int(column) <= len(names):
            matches = [int(column) - 1]
        if len(matches) != 1:
            raise FormatError(
                f"{path}: column '{column}' is none of the {len(names)} columns ({', '.join(names)}); name "
                "one of them, or give its number from 1"
            )
        places.append(matches[0])
    chosen = dict(zip(places, "xyz", strict=True))
    return [chosen.get(i, f"column_{i + 1}" if name in ("x", "y", "z") else name) for i, name in enumerate(names)]


def _layout(lines: list[str], path: AnyPath) -> _Layout:
    """Find the first row of numbers: a line of which at least one field is a number."""
    header, is_comment, promised = None, False, None
    for i, line in enumerate(lines):
        content = _COMMENT.sub("", line).strip()
        if not content:
            if line.strip():
                header, is_comment = line.strip().lstrip("#/ \t"), True
            continue
        fields = re.split(r"[\s,;]+", content.replace('"', "").strip(" \t,;"))
        if not any(map(is_number, fields)):
            header, is_comment = content, False
        elif promised is None and len(fields) == 1 and is_index(fields[0].lstrip("-")):
            promised = int(fields[0])
        else:
            return _Layout(i, _separator(content), header, is_comment, promised)
    found = "no row" if promised is None else "a count but no row"
    raise FormatError(f"{path}: {found} of numbers stands in its {len(lines)} lines; give one line 'x y z' a point")


def _separator(row: str) -> str | None:
    """Return ';' or ',', or None for blanks and tabs."""
    if ";" in row:
        return ";"
    fields = row.split()
    are_decimal = len(fields) >= 2 and all(_DECIMAL_COMMA.fullmatch(field) for field in fields)
    return "," if "," in row and not are_decimal else None


def _blank_separated(text: str, separator: str | None) -> str:
    if "#" in text or "//" in text:
        text = _COMMENT.sub("", text)
    text = text.replace('"', "")
    if separator is not None:
        if re.search(rf"{separator}[ \t]*{separator}", text):
            text = re.sub(rf"(?<={separator})[ \t]*(?={separator})", "nan", text)
        text = text.replace(separator, " ")
    return text.replace(",", ".") if separator != "," else text


def _names(layout: _Layout, n_columns: int) -> list[str]:
    header = (layout.header or "").replace('"', "")
    by_separator = [name.strip() for name in header.split(layout.separator)]
    by_any = re.split(r"[\s,;]+", header.strip(" \t,;"))
    for names in (by_separator, by_any):
        if len(names) != n_columns:
            continue
        # a comment is a header only if it says so; else it may be prose of as many words as there are columns
        if not layout.is_header_comment or {"x", "y", "z"} <= {name.lower() for name in names}:
            return column_names(n_columns, names)
    return column_names(n_columns)
