"""PCD of the Point Cloud Library: text, binary and compressed, organised frames, packed colours.

Our own reader: the Python wheels that read it keep no count of fields, know no packed colours, or hold a whole
viewer.
"""

import re
from dataclasses import dataclass
from struct import unpack_from
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._kernels.io import lzf
from ..errors import FormatError
from ..typing import Attributes
from .scan import Scan, scan_from_columns
from .source import AnyPath, decode, read_bytes, split_lines, without_end_mark
from .table import is_index, parse_rows

_DATA = re.compile(rb"^DATA[ \t]+(\w+)[ \t\r]*(?:\n|$)", re.MULTILINE)  # the last line of the header
_KINDS = {"F": "f", "I": "i", "U": "u"}
_SIZES = {"F": (4, 8), "I": (1, 2, 4, 8), "U": (1, 2, 4, 8)}  # bytes that each kind may have (PCD v0.7)
_NORMALS = {f"normal_{axis}": f"n{axis}" for axis in "xyz"}  # names that other formats give them
_PADDING = "_"  # name of bytes that hold nothing
_MOST_UNPACKED = 88  # times the packed bytes: three of LZF copy at most 264
_NO_TURN = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]  # a viewpoint that changes nothing: no shift, and the unit quaternion


@dataclass(frozen=True, slots=True)
class _Header:
    """The fields with their numpy types and numbers of values, the number of points, and where the rows start."""

    fields: list[tuple[str, str, int]]
    n_points: int
    viewpoint: list[float]
    storage: str
    n_bytes: int
    n_lines: int


def read_pcd(path: AnyPath) -> Scan:
    """Read the points with all their fields; `rgb` and `rgba` become channels, rows without coordinates no points."""
    data = read_bytes(path)
    header = _header(path, data)
    body = data[header.n_bytes :]
    readers = {"ascii": _text, "binary": _binary, "binary_compressed": _compressed}
    if header.storage not in readers:
        raise FormatError(f"{path}: the rows are '{header.storage}', not {', '.join(readers)}; export the file again")
    columns: dict[str, NDArray[Any]] = {}
    for name, column in readers[header.storage](path, header, body).items():
        columns |= _channels(column, name) if name in ("rgb", "rgba") else {_NORMALS.get(name, name): column}
    notes = []
    if header.viewpoint != _NO_TURN:
        notes.append("the viewpoint of the file is not applied: the points are in the frame of the sensor")
    scan = scan_from_columns(path, columns, notes=notes)
    return scan.without_points(np.asarray(~np.isfinite(scan.points).all(axis=1)))


def _header(path: AnyPath, data: bytes) -> _Header:
    end = _DATA.search(data)
    if end is None:
        raise FormatError(f"{path}: no header line 'DATA' in its {len(data)} bytes; give it the suffix of its format")
    entries = {words[0]: words[1:] for line in split_lines(decode(data[: end.start()])) if (words := line.split())}
    names, sizes, kinds = entries.get("FIELDS", []), entries.get("SIZE", []), entries.get("TYPE", [])
    counts = entries.get("COUNT", ["1"] * len(names))
    if not names or not len(names) == len(sizes) == len(kinds) == len(counts):
        raise FormatError(
            f"{path}: the header has {len(names)} FIELDS, {len(sizes)} SIZE, {len(kinds)} TYPE and {len(counts)} COUNT "
            "where each field needs one; export the file again"
        )
    fields: list[tuple[str, str, int]] = []
    for name, size, kind, count in zip(names, sizes, kinds, counts, strict=True):
        is_known = is_index(size) and int(size) in _SIZES.get(kind, ()) and is_index(count)
        if not is_known or int(count) * int(size) > len(data):
            raise FormatError(
                f"{path}: field {name} has type {kind}, size {size}, count {count}; export the file again"
            )
        fields.append((name, f"{_KINDS[kind]}{size}", int(count)))
    numbers = [word for key in ("POINTS", "WIDTH", "HEIGHT") for word in entries.get(key, [])[:1]]
    if not numbers or not all(map(is_index, numbers)):
        raise FormatError(f"{path}: the header gives no whole number of POINTS; export the file again")
    n_points = int(entries["POINTS"][0]) if entries.get("POINTS") else int(numbers[0]) * int(numbers[-1])
    return _Header(
        fields,
        n_points,
        _viewpoint(entries.get("VIEWPOINT", [])),
        decode(end[1]),
        end.end(),
        data[: end.end()].count(b"\n"),
    )


def _viewpoint(words: list[str]) -> list[float]:
    try:
        return [float(word) for word in words] or _NO_TURN
    except ValueError:
        return _NO_TURN


def _text(path: AnyPath, header: _Header, body: bytes) -> Attributes:
    lines = split_lines(without_end_mark(decode(body)))
    first = header.n_lines + 1
    width = sum(count for _, _, count in header.fields)
    table = parse_rows(lines, path=path, line_numbers=range(first, first + len(lines)), width=width)
    _check_length(path, header, len(table))
    columns, at = {}, 0
    for name, kind, count in header.fields:
        for k in range(count):
            column = table[: header.n_points, at]
            is_packed = name in ("rgb", "rgba")
            columns[_part(name, k, count)] = column if is_packed or kind[0] == "f" else _whole(path, name, column, kind)
            at += 1
    return columns


def _whole(path: AnyPath, name: str, column: NDArray[Any], kind: str) -> NDArray[Any]:
    """Cast a column to the whole numbers that the header names."""
    with np.errstate(invalid="ignore", over="ignore"):  # what does not fit is found by comparing, next
        cast = column.astype(kind)
    bad = np.flatnonzero(cast != column)
    if len(bad):
        raise FormatError(f"{path}: point {bad[0]} has {column[bad[0]]:g} for {name}, which {cast.dtype} cannot hold")
    return cast


def _binary(path: AnyPath, header: _Header, body: bytes) -> Attributes:
    dtype = np.dtype([(f"{i}", "<" + kind, (count,)) for i, (_, kind, count) in enumerate(header.fields)])
    _check_length(path, header, len(body) // dtype.itemsize if dtype.itemsize else 0)
    rows = np.frombuffer(body, dtype, header.n_points)
    return _parts(header, [rows[f"{i}"] for i in range(len(header.fields))])


def _compressed(path: AnyPath, header: _Header, body: bytes) -> Attributes:
    """Unpack: the values of each field stand together."""
    sizes = [count * int(kind[1]) * header.n_points for _, kind, count in header.fields]
    n_packed, n_plain = unpack_from("<II", body.ljust(8, b"\0"))
    if n_plain != sum(sizes) or len(body) - 8 < n_packed or n_plain > _MOST_UNPACKED * n_packed:
        raise FormatError(
            f"{path}: {len(body) - 8} bytes are there of {n_packed}, for {n_plain} of {sum(sizes)} that "
            f"{header.n_points} points take; copy or export the file again"
        )
    plain = np.empty(n_plain, np.uint8)
    if not lzf.unpack(np.frombuffer(body, np.uint8, n_packed, 8), plain):
        raise FormatError(f"{path}: the {n_packed} compressed bytes are damaged; copy or export the file again")
    arrays = []
    for (_, kind, count), part in zip(header.fields, np.split(plain, np.cumsum(sizes)[:-1]), strict=True):
        arrays.append(part.view("<" + kind).reshape(header.n_points, count))
    return _parts(header, arrays)


def _parts(header: _Header, arrays: list[NDArray[Any]]) -> Attributes:
    columns: Attributes = {}
    for (name, _, count), values in zip(header.fields, arrays, strict=True):
        if name != _PADDING:
            columns |= {_part(name, k, count): values[:, k] for k in range(count)}
    return columns


def _part(name: str, k: int, count: int) -> str:
    return name if count == 1 else f"{name}_{k + 1}"


def _check_length(path: AnyPath, header: _Header, n_held: int) -> None:
    if n_held < header.n_points:
        raise FormatError(f"{path}: the file ends after {n_held} of {header.n_points} points; copy or export it again")


def _channels(packed: NDArray[Any], name: str) -> Attributes:
    """Unpack the channels of 0xAARRGGBB, whole or in the bits of a float."""
    if (
        packed.dtype == np.float64
    ):  # from text: whole numbers are the bits themselves, for as floats they mean no colour
        is_bits = bool(np.isfinite(packed).all() and (packed == np.rint(packed)).all() and (packed >= 1).any())
        packed = packed.astype(np.uint32) if is_bits else packed.astype(np.float32)
    bits = packed.astype("<f4").view("<u4") if packed.dtype.kind == "f" else packed.astype(np.uint32)
    shifts = {"red": 16, "green": 8, "blue": 0} | ({"alpha": 24} if name == "rgba" else {})
    return {channel: (bits >> shift & 255).astype(np.uint8) for channel, shift in shifts.items()}
