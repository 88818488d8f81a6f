"""STL in and out: corners without connection, so equal corners are merged to points on reading.

Our own reader: trimesh refuses a binary file with bytes after the last triangle and reads a cut-off text file as empty.
"""

from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from ..typing import Points, Triangles
from .distinct import distinct_rows
from .scan import Scan
from .source import AnyPath, decode, read_bytes, split_lines
from .table import parse_rows

_HEADER = 84  # bytes: 80 of any text, then the number of facets
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])  # 50 bytes, without gaps


def read_stl(path: AnyPath) -> Scan:
    """Read binary or text STL; points come in the order in which they first appear."""
    data = read_bytes(path)
    # Binary files may begin with "solid" too, but hold a zero before long: text never does.
    is_text = data.lstrip()[:5].lower() == b"solid" and b"\0" not in data[:1024]
    corners = _text_corners(path, data) if is_text else _binary_corners(path, data)
    first, kind = distinct_rows(corners)
    with np.errstate(invalid="ignore"):  # a signaling not-a-number
        points = corners[first].astype(np.float64)
    return Scan(points, kind.reshape(-1, 3), {})


def write_stl(file: BinaryIO, points: Points, triangles: Triangles) -> None:
    """Write binary STL in single precision, with unit normals."""
    facets = np.zeros(len(triangles), _FACET)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    facets["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    with np.errstate(over="ignore"):
        facets["corners"] = corners
    file.write(b"pointchart".ljust(80, b"\0") + np.array(len(triangles), "<u4").tobytes())
    file.write(facets.tobytes())


def _binary_corners(path: AnyPath, data: bytes) -> NDArray[np.float32]:
    held = max(len(data) - _HEADER, 0) // _FACET.itemsize
    promised = int(np.frombuffer(data, "<u4", 1, 80)[0]) if len(data) >= _HEADER else None
    if promised is None or promised > held:
        raise FormatError(
            f"{path}: the file ends after {held} of {'?' if promised is None else promised} triangles "
            f"({len(data)} bytes); copy or export it again"
        )
    return np.frombuffer(data, _FACET, promised, _HEADER)["corners"].reshape(-1, 3)


def _text_corners(path: AnyPath, data: bytes) -> NDArray[np.float64]:
    lines = [line.strip().lower() for line in split_lines(decode(data))]
    at = [i for i, line in enumerate(lines) if line.startswith("vertex")]
    n_facets = sum(line.startswith("endfacet") for line in lines)
    if len(at) != 3 * n_facets:
        raise FormatError(
            f"{path}: {len(at)} corners stand in {n_facets} whole facets, which need {3 * n_facets}; export it again"
        )
    rows = [lines[i].removeprefix("vertex") or lines[i] for i in at]
    return parse_rows(rows, path=path, line_numbers=[i + 1 for i in at], width=3)
