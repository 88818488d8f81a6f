"""The rows of one PLY element, as groups of rows of one layout, so that numpy reads each group at once.

The lengths of the lists in a row are its *signature*. Rows of one signature have one dtype, in which the list `a` is
the pair of fields `count of a` and `a`, an array of that length. Mostly all rows have the signature of the first.
"""

from collections.abc import Iterator, Sequence
from struct import Struct
from struct import error as StructError
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...errors import FormatError
from ...typing import Floats, Indices
from ..source import AnyPath
from ..table import is_index, parse_rows
from .ply_header import Element, Property

Group: TypeAlias = tuple[Indices, NDArray[Any]]
_Signature: TypeAlias = tuple[int, ...]
_COUNT_OF = "count of "  # holds a blank, so no property can have the name
_PLURAL = {"vertex": "vertices", "face": "faces"}  # for messages; other elements are "rows of"


def binary_groups(path: AnyPath, data: bytes, start: int, element: Element, order: str) -> tuple[list[Group], int]:
    """Read the rows that start at a byte; return them and the byte where they end."""
    n = element.n_rows
    if n == 0:
        return [], start
    # As if all rows were like the first one: then numpy reads them at once, and the counts in them tell if it was so.
    signature, _ = _binary_signature(path, data, start, element, order, 0)
    dtype = _row_type(element, signature, order)
    if start + n * dtype.itemsize <= len(data):
        rows = np.frombuffer(data, dtype, n, start)
        if _has_signature(rows, element, signature):
            return [(np.arange(n), rows)], start + n * dtype.itemsize
    elif not signature:  # without lists all rows are equally long, so bytes are missing
        raise cut_off(path, element, (len(data) - start) // dtype.itemsize)
    starts, signatures = [], []
    for row in range(n):
        signature, end = _binary_signature(path, data, start, element, order, row)
        starts.append(start)
        signatures.append(signature)
        start = end
    return list(_gathered(data, element, order, np.array(starts), signatures)), start


def text_groups(path: AnyPath, lines: Sequence[str], numbers: Sequence[int], element: Element) -> list[Group]:
    """Read rows of text, one a line."""
    if len(lines) < element.n_rows:
        raise cut_off(path, element, len(lines))
    by_signature: dict[_Signature, list[int]] = {}
    if any(p.count_type for p in element.properties):
        for i, line in enumerate(lines):
            by_signature.setdefault(_text_signature(path, line, numbers[i], element), []).append(i)
    elif lines:
        by_signature[()] = list(range(len(lines)))
    groups = []
    for signature, places in by_signature.items():
        width = len(element.properties) + sum(signature)
        own_numbers = [numbers[i] for i in places]
        table = parse_rows([lines[i] for i in places], path=path, line_numbers=own_numbers, width=width)
        groups.append((np.array(places), _structured(path, table, own_numbers, element, signature)))
    return groups


def cut_off(path: AnyPath, element: Element, n_held: int) -> FormatError:
    """Return the error for a file that ends too early."""
    rows = _PLURAL.get(element.name, f"rows of element {element.name}")
    return FormatError(f"{path}: the file ends after {n_held} of {element.n_rows} {rows}; copy or export it again")


def _row_type(element: Element, signature: _Signature, order: str) -> np.dtype[Any]:
    lengths = iter(signature)
    fields: list[Any] = []
    for p in element.properties:
        if p.count_type is None:
            fields.append((p.name, order + p.type))
        else:
            fields += [(_COUNT_OF + p.name, order + p.count_type), (p.name, order + p.type, (next(lengths),))]
    return np.dtype(fields)


def _has_signature(rows: NDArray[Any], element: Element, signature: _Signature) -> bool:
    lists = [p for p in element.properties if p.count_type]
    return all((rows[_COUNT_OF + p.name] == length).all() for p, length in zip(lists, signature, strict=True))


def _binary_signature(
    path: AnyPath, data: bytes, start: int, element: Element, order: str, row: int
) -> tuple[_Signature, int]:
    """Return the signature of the row that starts at a byte, and the byte where it ends."""
    lengths, at = [], start
    for p in element.properties:
        if p.count_type is None:
            at += _size(p)
            continue
        counter = _COUNTERS[order + p.count_type]
        try:
            (length,) = counter.unpack_from(data, at)
        except StructError:
            raise cut_off(path, element, row) from None
        if length < 0:
            raise FormatError(f"{path}: byte {at} gives list {p.name} {length} values; export the file again")
        lengths.append(length)
        at += counter.size + length * _size(p)
    if at > len(data):
        raise cut_off(path, element, row)
    return tuple(lengths), at


def _gathered(
    data: bytes, element: Element, order: str, starts: Indices, signatures: list[_Signature]
) -> Iterator[Group]:
    places: dict[_Signature, list[int]] = {}
    for i, signature in enumerate(signatures):
        places.setdefault(signature, []).append(i)
    raw = np.frombuffer(data, np.uint8)
    for signature, of_signature in places.items():
        dtype = _row_type(element, signature, order)
        rows = np.array(of_signature)
        bytes_of_rows = raw[starts[rows][:, None] + np.arange(dtype.itemsize)]
        yield rows, bytes_of_rows.view(dtype)[:, 0]


def _text_signature(path: AnyPath, line: str, number: int, element: Element) -> _Signature:
    fields, at, lengths = line.split(), 0, []
    for p in element.properties:
        if p.count_type is not None:
            if at >= len(fields) or not is_index(fields[at]):
                raise FormatError(
                    f"{path}: line {number} '{line.strip()[:60]}' has no number of values for list {p.name}; correct it"
                )
            lengths.append(int(fields[at]))
            at += lengths[-1]
        at += 1
    if at != len(fields):
        raise FormatError(
            f"{path}: line {number} '{line.strip()[:60]}' has {len(fields)} numbers where {at} are due; correct it"
        )
    return tuple(lengths)


def _structured(
    path: AnyPath, table: Floats, numbers: Sequence[int], element: Element, signature: _Signature
) -> NDArray[Any]:
    """Cast the columns of a table to the types of the header; a value that its type cannot hold is an error."""
    rows = np.empty(len(table), _row_type(element, signature, ""))
    at = 0
    for name in rows.dtype.names or ():
        width = rows[name].shape[1] if rows[name].ndim == 2 else 1
        values = table[:, at : at + width].reshape(rows[name].shape)
        at += width
        with np.errstate(over="ignore", invalid="ignore"):  # what does not fit is found by comparing, next
            rows[name] = values
        if rows[name].dtype.kind != "f" and len(bad := np.argwhere(rows[name] != values)):
            line, kind = numbers[bad[0][0]], rows[name].dtype
            raise FormatError(f"{path}: line {line} has {values[tuple(bad[0])]:g} for {name}, which {kind} cannot hold")
    return rows


def _size(p: Property) -> int:
    return int(p.type[1])


# By struct, as there is a number a list, and to read a single one numpy takes eight times as long.
_LETTERS = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "i8": "q", "u8": "Q"}
_COUNTERS = {order + code: Struct(order + letter) for order in "<>" for code, letter in _LETTERS.items()}
