"""Colours of points in whatever form they come, as the bytes that programs show."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..typing import Attributes

# What programs call the channels: PLY, OBJ and LAS; CloudCompare as text; Blender and older PLY; CloudCompare's floats.
_NAMES = (
    ("red", "green", "blue"),
    ("r", "g", "b"),
    ("diffuse_red", "diffuse_green", "diffuse_blue"),
    ("rf", "gf", "bf"),
    ("color_r", "color_g", "color_b"),
)
_BYTE, _WORD, _NO_COLOR = 255.0, 65535.0, float("inf")  # full light in channels of 8 and of 16 bits, and in none


def with_byte_colors(attributes: Attributes) -> Attributes:
    """Return attributes whose colours, if they are any, are red, green, blue as bytes, in the place of the first.

    Numbers with a fraction up to 1 or 255 are understood, and whole ones up to 255 or 65535; what is none of these is
    no colour and stays as it is. An alpha beside the colours is treated alike.

    Examples
    --------
    >>> channels = {"R": np.array([0.0, 1.0]), "G": np.array([0.2, 1.0]), "B": np.array([0.0, 0.4])}
    >>> {name: values.tolist() for name, values in with_byte_colors(channels).items()}
    {'red': [0, 255], 'green': [51, 255], 'blue': [0, 102]}
    """
    by_word = {name.lower(): name for name in attributes}
    for channels in _NAMES:
        if not all(channel in by_word for channel in channels):
            continue
        names = [by_word[channel] for channel in channels]
        full = max(map(_full, (attributes[name] for name in names)))
        if full == _NO_COLOR:
            return attributes
        bytes_of = {new: _bytes(attributes[name], full) for new, name in zip(_NAMES[0], names, strict=True)}
        renamed = dict(zip(names, _NAMES[0], strict=True))
        alpha = by_word.get("alpha")
        if alpha is not None and (full_alpha := _full(attributes[alpha])) != _NO_COLOR:
            bytes_of["alpha"], renamed[alpha] = _bytes(attributes[alpha], full_alpha), "alpha"
        new_names = {name: renamed.get(name, name) for name in attributes}
        return {new: bytes_of.get(new, attributes[name]) for name, new in new_names.items()}
    return attributes


def _full(values: NDArray[Any]) -> float:
    """Return the value that full light has in a channel: 1, 255 or 65535; infinity if it is no colour."""
    if values.dtype == np.uint8 or not len(values):
        return _BYTE
    least, most = float(values.min()), float(values.max())
    is_real = values.dtype.kind == "f"
    if not (least >= 0.0 and most <= _WORD):  # not-a-number is in no range
        return _NO_COLOR
    if is_real and most <= 1.0:
        return 1.0
    if most <= _BYTE:
        return _BYTE
    return _NO_COLOR if is_real and (values != np.rint(values)).any() else _WORD


def _bytes(values: NDArray[Any], full: float) -> NDArray[np.uint8]:
    if values.dtype == np.uint8:
        return values
    return np.rint(values.astype(np.float64) / full * _BYTE).astype(np.uint8)
