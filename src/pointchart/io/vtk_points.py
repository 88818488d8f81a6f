"""The points of a legacy VTK file, text or binary.

Our own reader: meshio reads no POLYDATA, which clouds are, and vtk weighs a hundred megabytes.
"""

import re

import numpy as np

from ..errors import FormatError
from ..typing import Floats
from .scan import Scan
from .source import AnyPath, decode, read_bytes, split_lines
from .table import parse_rows

_START = b"# vtk DataFile"  # how every legacy file begins
_POINTS = re.compile(rb"^POINTS[ \t]+(\d{1,15})[ \t]+(\w+)[ \t]*\r?\n", re.MULTILINE | re.IGNORECASE)
# What the format calls the types of numbers, as numpy does; in binary files the highest byte comes first.
_TYPES = {"float": ">f4", "double": ">f8", "int": ">i4", "long": ">i8", "short": ">i2", "unsigned_int": ">u4"}
# Words that begin what is left out.
_OTHERS = re.compile(rb"^(VERTICES|LINES|POLYGONS|TRIANGLE_STRIPS|CELLS|POINT_DATA|CELL_DATA)[ \t]+\d", re.MULTILINE)


def read_vtk(path: AnyPath) -> Scan:
    """Read the points; faces and values are left out, with a note."""
    data = read_bytes(path)
    if not data.startswith(_START):
        raise FormatError(f"{path}: it does not begin with '{_START.decode()}'; give it the suffix of its format")
    found = _POINTS.search(data)
    kind = data[: found.start() if found else None].split(b"\n")[2:3]
    if found is None or not kind:
        raise FormatError(f"{path}: no line says 'POINTS n type'; export the data set as points, such as CSV or PLY")
    n, name = int(found[1]), decode(found[2]).lower()
    if name not in _TYPES:
        raise FormatError(f"{path}: the points are of type '{name}', which is not read; export them as double")
    rest, end = data[found.end() :], 0
    if kind[0].strip().upper() == b"BINARY":
        dtype = np.dtype(_TYPES[name])
        end = 3 * n * dtype.itemsize
        if end > len(rest):
            held = len(rest) // (3 * dtype.itemsize)
            raise FormatError(f"{path}: the file ends after {held} of {n} points; copy or export it again")
        points = np.frombuffer(rest, dtype, 3 * n).reshape(n, 3).astype(np.float64)
    else:
        points = _text_points(path, rest, n, data[: found.end()].count(b"\n") + 1)
    others = [word.decode() for word in dict.fromkeys(_OTHERS.findall(rest, end))]
    notes = (f"only the points are read: {', '.join(others)} left out; write .ply to keep them",) if others else ()
    return Scan(points, np.empty((0, 3), np.int64), {}, notes=notes)


def _text_points(path: AnyPath, rest: bytes, n: int, first_line: int) -> Floats:
    """Read the numbers as a stream up to the first word: programs write three points a line."""
    words: list[str] = []
    for line in split_lines(decode(rest)):
        fields = line.split()
        if len(words) >= 3 * n or (fields and fields[0][:1].isalpha() and fields[0].lower() not in ("nan", "inf")):
            break
        words += fields
    if len(words) < 3 * n:
        raise FormatError(f"{path}: the file ends after {len(words) // 3} of {n} points; copy or export it again")
    rows = [" ".join(words[k : k + 3]) for k in range(0, 3 * n, 3)]
    return parse_rows(rows, path=path, line_numbers=range(first_line, first_line + n), width=3)
