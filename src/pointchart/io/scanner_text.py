"""Text of laser scanners, after Leica's Cyclone: PTS, clouds behind counts, and PTX, scans with their transforms."""

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from ..typing import Attributes, Floats
from .column_names import named_columns
from .scan import Scan, common_columns, scan_from_columns
from .source import AnyPath, read_lines
from .table import is_index, parse_rows
from .text import read_text

_COLORS = ("red", "green", "blue")
# What stands behind x, y, z, by the number of columns.
_BEHIND = {3: (), 4: ("intensity",), 6: _COLORS, 7: ("intensity", *_COLORS)}
_PTX_HEADER = 10  # lines: columns, rows, place and three axes of the scanner, four rows of the transform


def read_pts(path: AnyPath) -> Scan:
    """Read the clouds one after the other; a file that does not begin with a count is read as any text."""
    lines = [line.strip() for line in read_lines(path)]
    filled = [i for i, line in enumerate(lines) if line]
    if not filled or not is_index(lines[filled[0]]):
        return read_text(path)
    clouds, notes, at = [], [], 0
    while at < len(filled):
        if not is_index(lines[filled[at]]):
            left = len(filled) - at
            notes.append(f"{left} row{'s' * (left > 1)} behind the points announced passed over")
            break
        n_points = int(lines[filled[at]])
        own = filled[at + 1 : at + 1 + n_points]
        if len(own) < n_points:
            raise FormatError(
                f"{path}: line {filled[at] + 1} promises {n_points} points, but {len(own)} follow; "
                "correct the count or export the file again"
            )
        clouds.append(_rows(path, lines, own))
        at += 1 + n_points
    return scan_from_columns(path, common_columns(clouds), notes=notes)


def read_ptx(path: AnyPath) -> Scan:
    """Read all scans in their common frame; rows of 0 0 0 are no-returns."""
    lines = [line.strip() for line in read_lines(path)]
    filled = [i for i, line in enumerate(lines) if line]
    scans, no_returns, at = [], [], 0
    while at < len(filled):
        head = filled[at : at + _PTX_HEADER]
        if len(head) < _PTX_HEADER or not all(is_index(lines[i]) for i in head[:2]):
            raise FormatError(
                f"{path}: line {filled[at] + 1} '{lines[filled[at]][:60]}' begins no scan, with the numbers of columns "
                "and of rows each on a line; export the file again"
            )
        transform = parse_rows([lines[i] for i in head[6:]], path=path, line_numbers=[i + 1 for i in head[6:]], width=4)
        n_points = int(lines[head[0]]) * int(lines[head[1]])
        own = filled[at + _PTX_HEADER : at + _PTX_HEADER + n_points]
        if len(own) < n_points:
            raise FormatError(f"{path}: the file ends after {len(own)} of {n_points} points; copy or export it again")
        columns = _rows(path, lines, own)
        no_returns.append(np.all([columns[axis] == 0.0 for axis in "xyz"], axis=0))
        scans.append(columns | _moved(columns, transform))
        at += _PTX_HEADER + n_points
    is_none: NDArray[np.bool_] = np.concatenate([np.zeros(0, bool), *no_returns])
    return scan_from_columns(path, common_columns(scans) if scans else {}).without_points(is_none)


def _moved(columns: Attributes, transform: Floats) -> Attributes:
    """Apply a transform to rows of coordinates; its last row is the shift."""
    with np.errstate(invalid="ignore", over="ignore"):  # what is not finite is named later
        points = np.column_stack([columns[axis] for axis in "xyz"]) @ transform[:3, :3] + transform[3, :3]
    return dict(zip("xyz", points.T, strict=True))


def _rows(path: AnyPath, lines: list[str], own: list[int]) -> Attributes:
    table = parse_rows([lines[i] for i in own], path=path, line_numbers=[i + 1 for i in own], least=3)
    behind = _BEHIND.get(table.shape[1], ("",) * (table.shape[1] - 3))
    return dict(zip(named_columns((0, 1, 2), ["", "", "", *behind]), table.T, strict=True))
