"""OFF in and out.

Our own reader and writer: trimesh passes over colours, normals, a negative count and missing faces, and writes a fixed
number of digits.
"""

import re
from typing import TextIO

import numpy as np

from ..errors import FormatError
from ..typing import Indices, Points, Triangles
from .column_names import named_columns
from .scan import Scan, fan_triangles, scan_from_columns
from .source import AnyPath, read_lines
from .table import as_integers, is_index, parse_rows, write_rows

_KEYWORD = re.compile(r"(C?N?|NC)OFF\b")  # colours and normals, whose letters come in either order
_COLOURS, _NORMALS = ("red", "green", "blue", "alpha"), ("nx", "ny", "nz")  # names that PLY gives the same columns
_Numbered = tuple[list[str], list[int]]


def read_off(path: AnyPath) -> Scan:
    """Read OFF, COFF (colours) and NOFF (normals)."""
    rows, numbers = _content(read_lines(path))
    keyword = _KEYWORD.match(rows[0]) if rows else None
    if keyword is None:
        raise FormatError(f"{path}: the first line is not OFF, COFF or NOFF; give the file the suffix of its format")
    counts, body = rows[0][keyword.end() :].split(), 1
    if not counts and len(rows) > 1:
        counts, body = rows[1].split(), 2
    if len(counts) < 2 or not all(map(is_index, counts[:2])):
        raise FormatError(
            f"{path}: line {numbers[body - 1]} '{' '.join(counts)[:60]}' is not the numbers of vertices and faces; "
            "write both as whole numbers from 0 on"
        )
    n, m = int(counts[0]), int(counts[1])
    if len(rows) - body < n + m:
        found = min(len(rows) - body, n)
        raise FormatError(
            f"{path}: the file ends after {found} of {n} vertices and {len(rows) - body - found} of {m} faces; "
            "copy or export it again"
        )
    end = body + n
    table = parse_rows(rows[body:end], path=path, line_numbers=numbers[body:end], least=3)
    extra = (*(_NORMALS if "N" in keyword[1] else ()), *(_COLOURS if "C" in keyword[1] else ()))
    known = ("x", "y", "z", *extra)[: table.shape[1]]
    names = named_columns((0, 1, 2), [*known, *[""] * (table.shape[1] - len(known))])
    polygons = _polygons(path, (rows[end : end + m], numbers[end : end + m]))
    return scan_from_columns(path, dict(zip(names, table.T, strict=True)), fan_triangles(path, polygons, n))


def write_off(file: TextIO, points: Points, triangles: Triangles) -> None:
    """Write shortest exact numbers."""
    file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
    write_rows(file, "{!r} {!r} {!r}", points)
    write_rows(file, "3 {} {} {}", triangles)


def _content(lines: list[str]) -> _Numbered:
    stripped = [line.partition("#")[0].strip() for line in lines]
    kept = [i for i, line in enumerate(stripped) if line]
    return [stripped[i] for i in kept], [i + 1 for i in kept]


def _polygons(path: AnyPath, numbered: _Numbered) -> list[tuple[Indices, Indices]]:
    """Group the faces by number of corners and of values after them, which are a colour."""
    rows, numbers = numbered
    forms: dict[tuple[str, int], list[int]] = {}
    for i, row in enumerate(rows):
        fields = row.split()
        forms.setdefault((fields[0], len(fields)), []).append(i)
    groups = []
    for (count, width), places in forms.items():
        lines = [numbers[i] for i in places]
        table = parse_rows([rows[i] for i in places], path=path, line_numbers=lines)
        n_corners = int(count) if is_index(count) else width
        corners = as_integers(table[:, 1 : n_corners + 1])
        if corners is None or n_corners >= width:
            raise FormatError(
                f"{path}: line {lines[0]} '{rows[places[0]][:60]}' is not a face of {count} corners; export it again"
            )
        groups.append((np.array(places), corners))
    return groups
