"""Rows of text to numbers and back: numpy's bulk parser, and a search for the faulty line only once it has failed."""

from collections.abc import Sequence
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from ..typing import Floats
from .source import AnyPath

_BLOCK = 1 << 17  # rows at a time, whose numbers and text take tens of bytes each as Python's objects


def parse_rows(
    rows: Sequence[str], *, path: AnyPath, line_numbers: Sequence[int], width: int | None = None, least: int = 1
) -> Floats:
    """Parse rows of numbers that are separated by blanks; blank rows are passed over.

    Parameters
    ----------
    rows
        Text of each row.
    path
        The file, for messages.
    line_numbers
        Line number of each row, for messages.
    width
        Numbers that every row must have; that of the first row by default.
    least
        Fewest numbers in a row.

    Returns
    -------
    (n, width) float64.

    Raises
    ------
    FormatError
        A row is not numbers or has another length than the rest; the line is named.

    Examples
    --------
    >>> parse_rows(["1 2.5", "3 nan"], path="a.xyz", line_numbers=[1, 2])
    array([[1. , 2.5],
           [3. , nan]])
    """
    if not any(row and not row.isspace() for row in rows):
        return np.empty((0, width or least))
    try:
        table = np.loadtxt(rows, comments=None, ndmin=2)
    except (ValueError, OverflowError):
        raise _first_fault(rows, path, line_numbers, width, least) from None
    if table.shape[1] < least or (width is not None and table.shape[1] != width):
        raise _first_fault(rows, path, line_numbers, width, least)
    return table


def is_number(field: str) -> bool:
    """Return whether `field` is a decimal number, nan or inf."""
    try:
        float(field)
    except ValueError:
        return False
    return "_" not in field


def is_index(field: str) -> bool:
    """Return whether `field` is a whole number from 0 on that int64 holds."""
    return field.isascii() and field.isdigit() and len(field) < 19


def as_integers(table: Floats) -> NDArray[np.int64] | None:
    """Return the numbers as int64, or None if one of them is not a whole number that int64 holds."""
    if not np.isfinite(table).all() or (np.abs(table) > 2.0**53).any() or (table != np.rint(table)).any():
        return None
    return table.astype(np.int64)


def write_rows(file: TextIO, template: str, table: NDArray[np.generic]) -> None:
    """Write one line for each row of `table`; `{!r}` in the template is the shortest text that reads back exactly."""
    for start in range(0, len(table), _BLOCK):
        block = table[start : start + _BLOCK]
        file.write("\n".join(map(template.format, *block.T.tolist())) + "\n")


def _first_fault(
    rows: Sequence[str], path: AnyPath, line_numbers: Sequence[int], width: int | None, least: int
) -> FormatError:
    for number, row in zip(line_numbers, rows, strict=False):
        fields = row.split()
        if not fields:
            continue
        where, shown = f"{path}: line {number}", row.strip()[:60]
        if not all(map(is_number, fields)):
            return FormatError(f"{where} '{shown}' is not a row of numbers; correct it or start it with #")
        if width is None and len(fields) < least:
            return FormatError(
                f"{where} '{shown}' has {len(fields)} numbers where at least {least} are due; correct it"
            )
        width = width or len(fields)
        if len(fields) != width:
            return FormatError(f"{where} '{shown}' has {len(fields)} numbers where {width} are due; correct that line")
    return FormatError(f"{path}: lines {line_numbers[0]} to {line_numbers[-1]} hold numbers out of range; correct them")
