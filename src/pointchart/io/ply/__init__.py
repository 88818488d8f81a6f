"""PLY in and out.

Our own reader and writer: trimesh refuses trailing bytes, list properties of vertices, mixed polygons and a comment
before the format, reads a truncated or negative count without a word, and writes single precision without the
properties that it does not know.
"""

from .ply_reader import read_ply
from .ply_writer import write_ply

__all__ = ["read_ply", "write_ply"]
