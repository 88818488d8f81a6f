"""Arrays as the text of a page: quantized, compressed, in base64."""

import base64
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...typing import Floats

LEVELS = 65535  # of two bytes: a step is far less than a pixel of any screen


def quantized(values: Floats, low: Floats | float, extent: float) -> NDArray[np.uint16]:
    """Round values from `low` to `low + extent` to 65,536 levels.

    >>> quantized(np.array([1.0, 2.0, 3.0]), 1.0, 2.0)
    array([    0, 32768, 65535], dtype=uint16)
    """
    levels = (values - low) * (LEVELS / (extent or 1.0))
    return np.rint(np.clip(levels, 0.0, LEVELS)).astype(np.uint16)


def packed(arrays: dict[str, NDArray[Any]]) -> tuple[list[dict[str, Any]], str]:
    r"""Put arrays one after the other into one compressed text; return where each lies, too.

    The bytes of numbers are sorted by their rank, all lowest first, which compresses to two thirds.

    >>> table, text = packed({"a": np.array([1, 2], np.uint16), "b": np.zeros(1, np.float32)})
    >>> [(row["name"], row["type"], row["length"], row["offset"]) for row in table]
    [('a', 'Uint16', 2, 0), ('b', 'Float32', 1, 4)]
    >>> zlib.decompress(base64.b64decode(text))
    b'\x01\x02\x00\x00\x00\x00\x00\x00'
    """
    table, parts, offset = [], [], 0
    for name, array in arrays.items():
        flat = np.ascontiguousarray(array).ravel()
        little = flat.astype(flat.dtype.newbyteorder("<"), copy=False)
        part = little.view(np.uint8).reshape(-1, flat.itemsize).T.tobytes()
        table.append({"name": name, "type": flat.dtype.name.capitalize(), "length": len(flat), "offset": offset})
        parts.append(part)
        offset += len(part)
    return table, base64.b64encode(zlib.compress(b"".join(parts), 9)).decode("ascii")


def steps(indices: NDArray[Any]) -> NDArray[np.uint32]:
    """Write indices as differences from one to the next, and those by their size: 0, -1, 1, -2 as 0, 1, 2, 3.

    >>> steps(np.array([5, 4, 6]))
    array([10,  1,  4], dtype=uint32)
    """
    change = np.diff(np.asarray(indices, np.int64), prepend=0)
    return np.where(change < 0, -2 * change - 1, 2 * change).astype(np.uint32)
