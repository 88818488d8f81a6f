"""Laser scans: LAS and LAZ by laspy, E57 by pye57; both are extras, imported on first use."""

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from struct import unpack, unpack_from
from tempfile import TemporaryDirectory
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from .extras import extra_module
from .scan import Scan, common_columns, scan_from_columns
from .source import AnyPath, check_readable

# Bytes of the headers of a file up to LAS 1.2 and of 1.4 (ASPRS, LAS specification); formats of points from 64 on are
# compressed, as LASzip sets the highest bit of numbers that are small.
_LAS_HEADER, _LAS_1_4_HEADER, _COMPRESSED = 227, 375, 64
_RECORD_HEADER, _LATE_RECORD_HEADER = 54, 60  # bytes before a record of variable length, and one behind the points
_NOISE = (7, 18)  # classes of low and high noise (ASPRS, LAS specification 1.4, table 17)
_NOTHING = np.zeros(1, np.uint8)  # of a dimension that the file does not have
# Seconds that an interpreter takes to start on a busy machine, and points a second that any decoder unpacks there: it
# is 2 to 5 millions on an idle one.
_START, _SLOWEST = 20.0, 50_000
_MOST_UNPACKED = 1000  # times its size: LAZ packs to a tenth, and to a hundredth where hardly anything differs
# The names of ASTM E2807, which E57 files use, to those of other formats.
_E57_NAMES = {"cartesianX": "x", "cartesianY": "y", "cartesianZ": "z", "intensity": "intensity"}
_E57_NAMES |= {f"color{colour.capitalize()}": colour for colour in ("red", "green", "blue")}


def read_las(path: AnyPath) -> Scan:
    """Read LAS or LAZ: coordinates scaled and shifted as the header says, all other dimensions as they are.

    Points that the file withholds, or that are classified as noise, are no points.
    """
    check_readable(path)
    laspy = extra_module(path, "laspy", "las")
    header = _check_las_header(path)
    if not header.is_packed:
        return _las_scan(path, laspy, path)
    if not laspy.LazBackend.detect_available():
        raise FormatError(f"{path}: LAZ needs a decompressor; pip install 'pointchart[las]'")
    with TemporaryDirectory(prefix="pointchart-") as folder:
        plain = Path(folder) / "plain.las"
        _unpack(path, plain, header.n_points)
        return _las_scan(path, laspy, plain)


def _las_scan(path: AnyPath, laspy: ModuleType, plain: AnyPath) -> Scan:
    try:
        with laspy.open(plain) as reader:
            cloud = reader.read()
        columns = {axis: np.asarray(cloud[axis], np.float64) for axis in "xyz"}
        dimensions = [name for name in cloud.point_format.dimension_names if name not in ("X", "Y", "Z")]
        columns |= {name: column for name in dimensions if (column := np.asarray(cloud[name])).ndim == 1}
    except Exception as error:
        raise FormatError(f"{path}: this is no whole LAS or LAZ file ({error}); copy or export it again") from None
    scan = scan_from_columns(path, columns)
    for is_none, what in (
        (columns.get("withheld", _NOTHING) != 0, "withheld"),
        (np.isin(columns.get("classification", _NOTHING), _NOISE), "noise"),
    ):
        if is_none.any():
            scan = scan.without_points(is_none, f"{what}, as the file says")
    return scan


def _unpack(path: AnyPath, plain: Path, n_points: int) -> None:
    """Unpack LAZ in a process of its own, which its decoder may end."""
    program = [sys.executable, "-P", "-m", "pointchart.io.unpack_laz", os.fspath(path), str(plain)]
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}  # whose threads take addresses, and are of no use here
    most = _START + n_points / _SLOWEST
    try:
        done = subprocess.run(program, capture_output=True, text=True, env=environment, timeout=most)
    except subprocess.TimeoutExpired:
        raise FormatError(
            f"{path}: its {n_points} points are not unpacked after {most:.0f} s, so the file is damaged; copy it again"
        ) from None
    if done.returncode:
        said = (done.stderr.strip().splitlines() or [f"its decoder ended with {done.returncode}"])[-1]
        raise FormatError(f"{path}: this is no whole LAS or LAZ file ({said[:200]}); copy or export it again")


def read_e57(path: AnyPath) -> Scan:
    """Read all scans of an E57 file in its common frame, one after the other; invalid points are left out.

    Intensity and colours are kept when every scan has them; other fields are passed over.
    """
    check_readable(path)
    pye57 = extra_module(path, "pye57", "e57")
    try:
        file = pye57.E57(str(path))
        scans = [_e57_scan(file, i) for i in range(file.scan_count)]
        file.close()
    except Exception as error:
        raise FormatError(f"{path}: this is no whole E57 file ({error}); copy or export it again") from None
    if not scans:
        raise FormatError(f"{path}: the file holds 0 scans; export it again with its points")
    return scan_from_columns(path, common_columns(scans))


def _e57_scan(file: Any, index: int) -> dict[str, NDArray[Any]]:
    fields = file.get_header(index).point_fields
    wanted = {"intensity": "intensity" in fields, "colors": "colorRed" in fields}
    data = file.read_scan(index, ignore_missing_fields=True, **wanted)
    return {_E57_NAMES[name]: column for name, column in data.items() if name in _E57_NAMES}


@dataclass(frozen=True, slots=True)
class _LasHeader:
    """Whether the points are packed, and how many there are to be."""

    is_packed: bool
    n_points: int


def _check_las_header(path: AnyPath) -> _LasHeader:
    """Hold the counts of the header against the size of the file: laspy believes them, and loops over billions."""
    with open(path, "rb") as file:
        head = file.read(_LAS_1_4_HEADER)
        size = file.seek(0, 2)
    if head[:4] != b"LASF" or len(head) < _LAS_HEADER:
        raise FormatError(f"{path}: the {size} bytes do not begin with a LAS header; give it the suffix of its format")
    # One after the other from byte 94 on: the point count of 32 bits gives way to one of 64 in LAS 1.4.
    header_size, start, n_records, form, length, n_points = unpack_from("<HIIBHI", head, 94)
    end_of_records = header_size + n_records * _RECORD_HEADER
    if head[25] >= 4 and len(head) == _LAS_1_4_HEADER:
        first_late, n_late, n_points = unpack_from("<QIQ", head, 235)
        end_of_records = max(end_of_records, first_late + n_late * _LATE_RECORD_HEADER if n_late else 0)
    if max(end_of_records, start) > size:
        raise FormatError(
            f"{path}: the header speaks of {max(end_of_records, start)} bytes, but the file has {size}; export it again"
        )
    held = (size - start) // max(length, 1)
    if form < _COMPRESSED and n_points > held:
        raise FormatError(f"{path}: the file ends after {held} of {n_points} points; copy or export it again")
    if form >= _COMPRESSED:
        _check_laz_chunks(path, start, size)
        if n_points * length > _MOST_UNPACKED * size:
            raise FormatError(f"{path}: {n_points} points are in no {size} bytes; copy or export it again")
    return _LasHeader(form >= _COMPRESSED, n_points)


def _check_laz_chunks(path: AnyPath, start: int, size: int) -> None:
    """Hold the number of chunks against the size: the decompressor believes it, and dies when memory ends."""
    with open(path, "rb") as file:
        file.seek(start)
        (table,) = unpack("<q", file.read(8).ljust(8, b"\0"))
        if table == -1:  # written to where one could not go back: then its place stands at the end
            file.seek(size - 8)
            (table,) = unpack("<q", file.read(8))
        file.seek(min(max(table, 0), size))
        _, n_chunks = unpack("<II", file.read(8).ljust(8, b"\xff"))
    if not start < table < size or n_chunks > size:
        raise FormatError(
            f"{path}: the table of {n_chunks} chunks at byte {table} is no part of its {size} bytes; copy it again"
        )
