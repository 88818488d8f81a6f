"""The points of VTK's files in XML, .vtp and .vtu: text or base64 in place, or appended, packed by zlib or not.

Our own reader: meshio reads no .vtp, and vtk weighs a hundred megabytes.
"""

import re
import zlib
from base64 import b64decode
from typing import Any
from xml.etree import ElementTree

import numpy as np

from ..errors import FormatError
from ..typing import Floats
from .scan import Scan
from .source import AnyPath, read_bytes
from .table import is_index

_TYPES = {"Float32": "f4", "Float64": "f8", "Int32": "i4", "Int64": "i8"}  # names of the format to those of numpy
_APPENDED = re.compile(rb"<AppendedData[^>]*?encoding=[\"'](\w+)[\"'][^>]*>\s*_")  # the data begin behind the line
_PACKER = "vtkZLibDataCompressor"  # what VTK packs by if nothing else is asked for


def read_vtk_xml(path: AnyPath) -> Scan:
    """Read the points of all pieces, one after the other; faces, cells and values are left out, with a note."""
    data = read_bytes(path)
    appended = _APPENDED.search(data)
    head = data[: appended.start()] + b"</VTKFile>" if appended else data
    try:
        root = ElementTree.fromstring(head)
        pieces = [_points(root, piece, data, appended) for piece in root.iter("Piece")]
    except (ElementTree.ParseError, ValueError, KeyError, AttributeError, LookupError, zlib.error) as error:
        raise FormatError(
            f"{path}: this is no whole VTK file that can be read ({error}); export it as .ply, or as .vtk"
        ) from None
    if not pieces:
        raise FormatError(f"{path}: the file holds 0 points; export it again with its points")
    has = {"PointData": "PointData/DataArray", "CellData": "CellData/DataArray", "Cells": "Cells/DataArray"}
    parts = list(root.iter("Piece"))
    others = [name for name, inside in has.items() if any(part.find(inside) is not None for part in parts)]
    others += ["Polys"] if any(part.get("NumberOfPolys", "0") != "0" for part in parts) else []
    notes = (f"only the points are read: {', '.join(others)} left out; write .ply to keep them",) if others else ()
    return Scan(np.concatenate(pieces), np.empty((0, 3), np.int64), {}, notes=notes)


def _points(
    root: ElementTree.Element, piece: ElementTree.Element, data: bytes, appended: re.Match[bytes] | None
) -> Floats:
    array, count = piece.find("Points/DataArray"), piece.get("NumberOfPoints", "")
    if array is None or not is_index(count):
        raise ValueError("a piece has no points")
    form, text = array.get("format", "ascii"), (array.text or "").encode()
    order = ">" if root.get("byte_order") == "BigEndian" else "<"
    dtype = np.dtype(order + _TYPES[array.get("type", "")])
    size = 3 * int(count)
    if form == "ascii":
        values = np.array(text.split(), np.float64)
    else:
        is_raw = False
        if form == "appended":
            if appended is None:
                raise ValueError("the appended data are missing")
            is_raw = appended[1] == b"raw"
            text = data[appended.end() + int(array.get("offset", "0")) :]
        word = np.dtype(order + ("u8" if root.get("header_type") == "UInt64" else "u4"))
        values = np.frombuffer(_content(root, text, word, size * dtype.itemsize, is_raw), dtype)
    if len(values) < size:
        raise ValueError(f"{len(values) // 3} of {count} points")
    return values[:size].reshape(-1, 3).astype(np.float64)


def _content(root: ElementTree.Element, text: bytes, word: np.dtype[Any], size: int, is_raw: bool) -> bytes:
    """Return the `size` bytes that stand behind their own header, in blocks where they are packed."""
    text = text if is_raw else text.strip()
    packer = root.get("compressor")
    if packer is None:
        return _decoded(text, word.itemsize + size, is_raw)[word.itemsize :]
    if packer != _PACKER:
        raise ValueError(f"the data are packed by {packer}")
    n_blocks = int(np.frombuffer(_decoded(text, word.itemsize, is_raw), word)[0])
    length = (3 + n_blocks) * word.itemsize
    sizes = np.frombuffer(_decoded(text, length, is_raw), word)[3:].astype(np.int64)
    behind = text[length if is_raw else 4 * -(-length // 3) :]
    packed = _decoded(behind, int(sizes.sum()), is_raw)
    ends = np.cumsum(sizes)
    blocks = [packed[end - n : end] for end, n in zip(ends.tolist(), sizes.tolist(), strict=True)]
    return b"".join(zlib.decompressobj().decompress(block, size) for block in blocks)


def _decoded(text: bytes, n_bytes: int, is_raw: bool) -> bytes:
    content = text[:n_bytes] if is_raw else b64decode(text[: 4 * -(-n_bytes // 3)])[:n_bytes]
    if len(content) < n_bytes:
        raise ValueError(f"{len(content)} of {n_bytes} bytes")
    return content
