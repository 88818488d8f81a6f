"""Laser scans: LAS and LAZ by laspy, E57 by pye57; both are extras, imported on first use."""

from importlib import import_module
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pointchart.errors import FormatError
from pointchart.io.scan import Scan, scan_from_columns
from pointchart.io.source import AnyPath, check_readable

_E57_NAMES = {"cartesianX": "x", "cartesianY": "y", "cartesianZ": "z", "intensity": "intensity"}
_E57_NAMES |= {f"color{colour.capitalize()}": colour for colour in ("red", "green", "blue")}


def read_las(path: AnyPath) -> Scan:
    """Read LAS or LAZ: coordinates scaled and shifted as the header says, all other dimensions as they are."""
    check_readable(path)
    laspy = _extra(path, "laspy", "las")
    try:
        with laspy.open(path) as reader:
            header = reader.header
            if not header.are_points_compressed:
                _check_size(path, header)
            cloud = reader.read()
        columns = {axis: np.asarray(cloud[axis], np.float64) for axis in "xyz"}
        dimensions = [name for name in cloud.point_format.dimension_names if name not in ("X", "Y", "Z")]
        columns |= {name: column for name in dimensions if (column := np.asarray(cloud[name])).ndim == 1}
    except FormatError:
        raise
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


def _check_size(path: AnyPath, header: Any) -> None:
    with open(path, "rb") as file:
        size = file.seek(0, 2)
    held = max(size - header.offset_to_point_data, 0) // header.point_format.size
    if header.point_count > held:
        raise FormatError(f"{path}: the file ends after {held} of {header.point_count} points; copy or export it again")


def _extra(path: AnyPath, module: str, extra: str) -> ModuleType:
    try:
        return import_module(module)
    except ImportError:
        raise FormatError(f"{path}: the package {module} is not installed; pip install 'pointchart[{extra}]'") from None
