"""Laser scans: LAS and LAZ by laspy, E57 by pye57; both are extras, imported on first use."""

from importlib import import_module
from struct import unpack, unpack_from
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from .scan import Scan, scan_from_columns
from .source import AnyPath, check_readable

# Bytes of the headers of a file up to LAS 1.2 and of 1.4 (ASPRS, LAS specification); formats of points from 64 on are
# compressed, as LASzip sets the highest bit of numbers that are small.
_LAS_HEADER, _LAS_1_4_HEADER, _COMPRESSED = 227, 375, 64
_RECORD_HEADER, _LATE_RECORD_HEADER = 54, 60  # bytes before a record of variable length, and one behind the points
# The names of ASTM E2807, which E57 files use, to those of other formats.
_E57_NAMES = {"cartesianX": "x", "cartesianY": "y", "cartesianZ": "z", "intensity": "intensity"}
_E57_NAMES |= {f"color{colour.capitalize()}": colour for colour in ("red", "green", "blue")}


def read_las(path: AnyPath) -> Scan:
    """Read LAS or LAZ: coordinates scaled and shifted as the header says, all other dimensions as they are."""
    check_readable(path)
    laspy = _extra(path, "laspy", "las")
    _check_las_header(path)
    try:
        with laspy.open(path) as reader:
            cloud = reader.read()
        columns = {axis: np.asarray(cloud[axis], np.float64) for axis in "xyz"}
        dimensions = [name for name in cloud.point_format.dimension_names if name not in ("X", "Y", "Z")]
        columns |= {name: column for name in dimensions if (column := np.asarray(cloud[name])).ndim == 1}
    except BaseException as error:  # a fault inside the LAZ library is a panic, which is no Exception
        if isinstance(error, (KeyboardInterrupt, SystemExit, GeneratorExit)):
            raise
        if "backend" in str(error).lower():
            raise FormatError(f"{path}: LAZ needs a decompressor; pip install 'pointchart[las]'") from None
        raise FormatError(f"{path}: this is no whole LAS or LAZ file ({error}); copy or export it again") from None
    return scan_from_columns(path, columns)


def read_e57(path: AnyPath) -> Scan:
    """Read all scans of an E57 file in its common frame, one after the other; invalid points are left out.

    Intensity and colours are kept when every scan has them; other fields are passed over.
    """
    check_readable(path)
    pye57 = _extra(path, "pye57", "e57")
    try:
        file = pye57.E57(str(path))
        scans = [_e57_scan(file, i) for i in range(file.scan_count)]
        file.close()
    except Exception as error:
        raise FormatError(f"{path}: this is no whole E57 file ({error}); copy or export it again") from None
    if not scans:
        raise FormatError(f"{path}: the file holds 0 scans; export it again with its points")
    common = [name for name in scans[0] if all(name in scan for scan in scans)]
    return scan_from_columns(path, {name: np.concatenate([scan[name] for scan in scans]) for name in common})


def _e57_scan(file: Any, index: int) -> dict[str, NDArray[Any]]:
    fields = file.get_header(index).point_fields
    wanted = {"intensity": "intensity" in fields, "colors": "colorRed" in fields}
    data = file.read_scan(index, ignore_missing_fields=True, **wanted)
    return {_E57_NAMES[name]: column for name, column in data.items() if name in _E57_NAMES}


def _check_las_header(path: AnyPath) -> None:
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
    if form >= _COMPRESSED:
        _check_laz_chunks(path, start, size)
    elif n_points > held:
        raise FormatError(f"{path}: the file ends after {held} of {n_points} points; copy or export it again")


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


def _extra(path: AnyPath, module: str, extra: str) -> ModuleType:
    try:
        return import_module(module)
    except ImportError:
        raise FormatError(f"{path}: the package {module} is not installed; pip install 'pointchart[{extra}]'") from None
