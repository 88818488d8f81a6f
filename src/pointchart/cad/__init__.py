"""Read and write fitted surfaces and the loops that trim them: CAD files, and JSON that keeps every bit."""

from .cad_files import CAD_SUFFIXES, read_cad, write_cad
from .surface_json import read_surface_json, write_surface_json
from .surface_writer import SURFACE_SUFFIXES, write_surface
from .units import MILLIMETRES

__all__ = [
    "CAD_SUFFIXES",
    "MILLIMETRES",
    "SURFACE_SUFFIXES",
    "read_cad",
    "read_surface_json",
    "write_cad",
    "write_surface",
    "write_surface_json",
]
