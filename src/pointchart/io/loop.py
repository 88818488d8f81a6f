"""Boundary loops as text: one 0-based point index a line, in order, not closed."""

import re
from itertools import chain

import numpy as np

from ..errors import FormatError
from ..typing import Indices, Loop
from .output import replacing
from .source import AnyPath, read_lines
from .table import is_index, write_rows


def read_loop(path: AnyPath) -> Loop:
    """Read point indices, one or more a line, between blanks or commas; what follows # is a comment.

    Parameters
    ----------
    path
        A text file.

    Returns
    -------
    (b,) int64 in the order of the file. Neither range nor repetition is checked here.

    Raises
    ------
    FormatError
        The file cannot be read, holds no index, or something else than an index; the line is named.
    """
    rows = [_parse(line, number, path) for number, line in enumerate(read_lines(path), start=1)]
    loop = np.fromiter(chain.from_iterable(rows), np.int64)
    if not len(loop):
        raise FormatError(f"{path}: the file holds 0 point indices; write one 0-based index a line")
    return loop


def write_loop(path: AnyPath, loop: Indices) -> None:
    """Write one 0-based point index a line, whole or not at all.

    Parameters
    ----------
    path
        The file; one that exists is replaced.
    loop
        (b,) point indices.

    Raises
    ------
    FormatError
        The file cannot be written.
    """
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as file:
        write_rows(file, "{}", np.asarray(loop)[:, None])


def _parse(line: str, number: int, path: AnyPath) -> list[int]:
    fields = line.partition("#")[0].replace(",", " ").split()
    fields = [_whole(field) for field in fields]
    if not all(map(is_index, fields)):
        raise FormatError(
            f"{path}: line {number} '{line.strip()[:60]}' is not a 0-based point index; write whole numbers from 0 on"
        )
    return list(map(int, fields))


def _whole(field: str) -> str:
    """Write a whole number without its fraction: other programs save indices as 1.1e+01."""
    if not re.fullmatch(r"\d+\.\d*(e[+-]?\d\d?)?", field, re.IGNORECASE):
        return field
    number = float(field)
    return str(int(number)) if number.is_integer() else field
