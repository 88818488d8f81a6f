"""Wavefront OBJ in and out.

Our own reader and writer: trimesh drops vertices that no face uses, reorders them by material, and writes a fixed
number of digits, while vertex i must stay point i to the last digit.
"""

from typing import TextIO

import numpy as np

from ..errors import FormatError
from ..typing import UV, Floats, Indices, Points, Triangles
from .scan import Scan, fan_triangles, scan_from_columns
from .source import AnyPath, read_lines
from .table import as_integers, parse_rows, write_rows

# By how many numbers stand behind a v: w is of the format, colours are not, but many programs write them.
_COLUMNS = {
    3: ("x", "y", "z"),
    4: ("x", "y", "z", "w"),
    6: ("x", "y", "z", "red", "green", "blue"),
    7: ("x", "y", "z", "red", "green", "blue", "alpha"),
}
_Records = tuple[list[str], Indices]
_Corners = tuple[Indices, Indices]


def read_obj(path: AnyPath) -> Scan:
    """Read vertices, their colours, faces, and texture coordinates and normals where each vertex has just one."""
    lines = _logical_lines(read_lines(path))
    records = _records(lines)
    vertices = records["v"]
    table = _table(path, vertices, least=3)
    n, width = table.shape
    if width not in _COLUMNS:
        raise FormatError(f"{path}: line {vertices[1][0]} has {width} numbers after 'v'; 3, 4, 6 or 7 can be read")
    columns = dict(zip(_COLUMNS[width], table.T, strict=True))
    faces = _faces(path, records["f"])
    corners = _slot(faces, 0, vertices)
    triangles = fan_triangles(path, corners, n, first=1)
    for slot, keyword, names in ((1, "vt", ("u", "v")), (2, "vn", ("nx", "ny", "nz"))):
        values = _table(path, records[keyword], least=1)[:, : len(names)]
        of_vertex = _per_vertex(values, corners, _slot(faces, slot, records[keyword]), n)
        if of_vertex is not None and values.shape[1] == len(names):
            columns |= dict(zip(names, of_vertex.T, strict=True))
    return scan_from_columns(path, columns, triangles)


def write_obj(file: TextIO, points: Points, triangles: Triangles, uv: UV | None) -> None:
    """Write shortest exact numbers, one `vt` a vertex."""
    write_rows(file, "v {!r} {!r} {!r}", points)
    if uv is None:
        write_rows(file, "f {} {} {}", triangles + 1)
    else:
        write_rows(file, "vt {!r} {!r}", uv)
        write_rows(file, "f {0}/{0} {1}/{1} {2}/{2}", triangles + 1)


def _logical_lines(lines: list[str]) -> list[str]:
    """Strip tabs and comments, and join a line that ends in a backslash with the next, which is left empty."""
    lines = [line.partition("#")[0].replace("\t", " ").strip() for line in lines]
    for i in range(len(lines) - 2, -1, -1):
        if lines[i].endswith("\\"):
            lines[i], lines[i + 1] = f"{lines[i][:-1]} {lines[i + 1]}", ""
    return lines


def _records(lines: list[str]) -> dict[str, _Records]:
    """Return what follows each keyword that is read, and the line numbers."""
    texts: dict[str, list[str]] = {keyword: [] for keyword in ("v", "vt", "vn", "f")}
    numbers: dict[str, list[int]] = {keyword: [] for keyword in texts}
    for number, line in enumerate(lines, start=1):
        keyword, _, rest = line.partition(" ")
        if keyword in texts:
            texts[keyword].append(rest or keyword)
            numbers[keyword].append(number)
    return {keyword: (texts[keyword], np.array(numbers[keyword], dtype=np.int64)) for keyword in texts}


def _table(path: AnyPath, records: _Records, least: int) -> Floats:
    return parse_rows(records[0], path=path, line_numbers=records[1].tolist(), least=least)


def _faces(path: AnyPath, records: _Records) -> list[tuple[Indices, Indices, Indices]]:
    """Group the faces by form: places in the file, line numbers, and (m, corners, slots) indices as written."""
    texts, numbers = records
    forms = np.array([(len(text.split()), text.count("/")) for text in texts], np.int64).reshape(-1, 2)
    groups = []
    for n_corners, n_slashes in np.unique(forms, axis=0):
        places = np.flatnonzero((forms == (n_corners, n_slashes)).all(axis=1))
        rows = [f"{texts[i]} ".replace("//", "/0/").replace("/ ", "/0 ").replace("/", " ") for i in places]
        lines = numbers[places].tolist()
        table = as_integers(parse_rows(rows, path=path, line_numbers=lines))
        if table is None or table.shape[1] != n_corners + n_slashes or table.shape[1] % n_corners:
            raise FormatError(f"{path}: line {lines[0]} '{texts[places[0]].strip()[:60]}' is no face; export it again")
        groups.append((places, numbers[places], table.reshape(len(places), n_corners, -1)))
    return groups


def _slot(faces: list[tuple[Indices, Indices, Indices]], slot: int, records: _Records) -> list[_Corners]:
    """Turn the 1-based or relative indices of one slot into 0-based ones; absent ones are negative."""
    corners = []
    for places, lines, indices in faces:
        if slot >= indices.shape[2]:
            corners.append((places, np.full(indices.shape[:2], -1)))
            continue
        written = indices[:, :, slot]
        n_before = np.searchsorted(records[1], lines)[:, None]
        relative = np.where(written < 0, n_before + written, -1)
        corners.append((places, np.where(written > 0, written - 1, relative)))
    return corners


def _per_vertex(values: Floats, corners: list[_Corners], value_corners: list[_Corners], n_points: int) -> Floats | None:
    """Return one row of values a vertex, or None where a vertex has none or several."""
    if not len(values):
        return None
    vertex = np.concatenate([np.empty(0, np.int64), *(c.ravel() for _, c in corners)])
    value = np.concatenate([np.empty(0, np.int64), *(c.ravel() for _, c in value_corners)])
    if len(values) == n_points and np.array_equal(vertex, value):
        return values
    if not len(value) or value.min() < 0 or value.max() >= len(values):
        return None
    of_vertex = np.full((n_points, values.shape[1]), np.nan)
    of_vertex[vertex] = values[value]
    is_single = np.array_equal(of_vertex[vertex], values[value]) and not np.isnan(of_vertex).any()
    return of_vertex if is_single else None
