"""Read scans and loops, write meshes and parameters: the format is chosen by the suffix."""

from .degrees import seem_degrees
from .loop import read_loop, write_loop
from .output import check_output, replacing
from .readers import READABLE_SUFFIXES, read_scan
from .scan import Scan
from .selection import classes_in, usable_rows
from .writers import MESH_SUFFIXES, UV_SUFFIXES, check_digits, write_curves, write_mesh, write_uv

__all__ = [
    "MESH_SUFFIXES",
    "READABLE_SUFFIXES",
    "UV_SUFFIXES",
    "Scan",
    "check_digits",
    "check_output",
    "classes_in",
    "read_loop",
    "read_scan",
    "replacing",
    "seem_degrees",
    "usable_rows",
    "write_curves",
    "write_loop",
    "write_mesh",
    "write_uv",
]
