"""Grids of heights as points, one a cell: ESRI ASCII grids, which have the suffix of point clouds, and GeoTIFF."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from ..typing import Floats
from .scan import Scan
from .source import AnyPath, read_lines
from .table import is_index, is_number
from .text import read_text

_NO_DATA = -9999.0  # where the header names no other (ESRI)
_KEYS = ("ncols", "nrows", "xllcorner", "xllcenter", "yllcorner", "yllcenter", "cellsize", "dx", "dy", "nodata_value")


def read_asc(path: AnyPath) -> Scan:
    """Read an ESRI ASCII grid, told by its first word, or else point cloud text."""
    lines = read_lines(path)
    header: dict[str, float] = {}
    at = 0
    while at < len(lines) and (words := lines[at].split()) and len(words) == 2 and words[0].lower() in _KEYS:
        if not is_number(words[1].replace(",", ".")):
            raise FormatError(f"{path}: line {at + 1} '{lines[at].strip()[:60]}' gives no number; correct it")
        header[words[0].lower()] = float(words[1].replace(",", "."))
        at += 1
    if "ncols" not in header:
        return read_text(path)
    missing = [key for key in ("nrows", "cellsize") if key not in header and not (key == "cellsize" and "dx" in header)]
    if missing or not all(is_index(f"{header[key]:g}") for key in ("ncols", "nrows")):
        raise FormatError(
            f"{path}: the header of the grid has no whole ncols and nrows and a cellsize; export it again"
        )
    heights = _heights(path, lines, at, (int(header["nrows"]), int(header["ncols"])))
    size = header.get("dx", header.get("cellsize", 1.0)), header.get("dy", header.get("cellsize", 1.0))
    west = header.get("xllcenter", header.get("xllcorner", 0.0) + 0.5 * size[0])
    south = header.get("yllcenter", header.get("yllcorner", 0.0) + 0.5 * size[1])
    x = west + size[0] * np.arange(heights.shape[1])
    y = south + size[1] * np.arange(heights.shape[0])[::-1]
    return grid_scan(x, y, heights, header.get("nodata_value", _NO_DATA))


def grid_scan(x: NDArray[Any], y: NDArray[Any], heights: NDArray[Any], no_data: float | None) -> Scan:
    """Make a scan of a grid, row by row; cells without a height are no points.

    >>> scan = grid_scan(np.array([0.0, 1.0]), np.array([5.0]), np.array([[7.0, -9999.0]]), -9999.0)
    >>> scan.points.tolist(), scan.valid.tolist()
    ([[0.0, 5.0, 7.0], [1.0, 5.0, -9999.0]], [True, False])
    """
    points = np.column_stack([np.tile(x, len(y)), np.repeat(y, len(x)), heights.ravel()])
    is_none = ~np.isfinite(points[:, 2])
    if no_data is not None:
        is_none |= points[:, 2] == no_data
    return Scan(points, np.empty((0, 3), np.int64), {}).without_points(is_none)


def _heights(path: AnyPath, lines: list[str], start: int, shape: tuple[int, int]) -> Floats:
    """Read the numbers of the cells, however they are broken into lines."""
    words = " ".join(lines[start:]).replace(",", ".").split()
    if len(words) != shape[0] * shape[1]:
        raise FormatError(
            f"{path}: {len(words)} heights follow where {shape[1]} columns and {shape[0]} rows take "
            f"{shape[0] * shape[1]}; export the grid again"
        )
    try:
        return np.array(words, dtype=np.float64).reshape(shape)
    except ValueError as error:
        raise FormatError(f"{path}: a height is no number ({error}); export the grid again") from None
