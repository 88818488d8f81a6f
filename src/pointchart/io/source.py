"""The bytes and the lines of an input file, unpacked, or one sentence on why there are none."""

import bz2
import gzip
import lzma
import os
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

from ..errors import FormatError

AnyPath: TypeAlias = str | os.PathLike[str]

# What unpacks a file, by the suffix behind that of its format.
_UNPACKERS: dict[str, Callable[..., Any]] = {".gz": gzip.open, ".bz2": bz2.open, ".xz": lzma.open}
PACKED_SUFFIXES = tuple(_UNPACKERS)
# Numbers as text pack to a third or a tenth; a file that unpacks to more than this many times its size, and to more
# than a small file has, is no scan but would fill the memory.
_MOST_PACKED, _SMALL = 200, 1 << 26
_END_OF_FILE = "\x1a"  # Ctrl-Z, which programs for DOS write behind the last line
_UTF16_MARKS = (b"\xff\xfe", b"\xfe\xff")  # byte order marks: half of the bytes of such text are zero, all the same


def check_readable(path: AnyPath) -> None:
    """Raise a FormatError unless `path` is a file that is not empty and may be read."""
    try:
        with Path(path).open("rb") as file:
            is_empty = not file.read(1)
    except FileNotFoundError:
        raise FormatError(f"{path}: there is no such file; check the name and the folder") from None
    except IsADirectoryError:
        raise FormatError(f"{path}: this is a folder; name a file in it") from None
    except PermissionError:
        raise FormatError(f"{path}: there is no permission to read it; ask its owner or copy it") from None
    except OSError as error:
        raise FormatError(f"{path}: it cannot be read ({error.strerror}); copy it to a local disk") from error
    if is_empty:
        raise FormatError(f"{path}: the file is empty (0 bytes); copy or export it again")


def split_suffix(path: AnyPath) -> tuple[str, str]:
    """Return the suffix of the format and that of the packing, both in lower case and empty where there is none.

    >>> split_suffix("Scan.XYZ.gz"), split_suffix("scan.ply")
    (('.xyz', '.gz'), ('.ply', ''))
    """
    last = Path(path).suffix.lower()
    if last in _UNPACKERS:
        return Path(path).with_suffix("").suffix.lower(), last
    return last, ""


def read_bytes(path: AnyPath) -> bytes:
    """Return all bytes of a file that is not empty, unpacked if its last suffix says that it is packed."""
    check_readable(path)
    _, packing = split_suffix(path)
    if packing:
        return _unpacked(path, _UNPACKERS[packing])
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise FormatError(f"{path}: it cannot be read ({error.strerror}); copy it to a local disk") from error


def _unpacked(path: AnyPath, opener: Callable[..., Any]) -> bytes:
    most = max(_SMALL, _MOST_PACKED * Path(path).stat().st_size)
    try:
        with opener(path, "rb") as file:
            data = bytes(file.read(most + 1))
    except (OSError, EOFError, zlib.error, lzma.LZMAError) as error:
        raise FormatError(f"{path}: this is no whole packed file ({error}); copy it again, or unpack it") from None
    if len(data) > most:
        raise FormatError(
            f"{path}: it unpacks to more than {_MOST_PACKED} times its size, as no scan does; unpack it and look at it"
        )
    if not data:
        raise FormatError(f"{path}: the file unpacks to 0 bytes; export it again")
    return data


def read_lines(path: AnyPath) -> list[str]:
    """Return the lines of a text file without their ends, whatever the line ends and the encoding."""
    data = read_bytes(path)
    if data.startswith(_UTF16_MARKS):
        text = data.decode("utf-16", errors="replace")
    elif (nul := data.find(b"\0")) >= 0:
        raise FormatError(f"{path}: byte {nul} is zero, so this is no text file; give it the suffix of its format")
    else:
        text = decode(data)
    return split_lines(without_end_mark(text))


def decode(data: bytes) -> str:
    """Decode UTF-8 with or without a byte order mark, and anything else as Latin-1."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def without_end_mark(text: str) -> str:
    r"""Take away a Ctrl-Z behind the last line.

    >>> without_end_mark("1 2 3\n\x1a"), without_end_mark("1 2 3\n")
    ('1 2 3\n', '1 2 3\n')
    """
    return text.rstrip().removesuffix(_END_OF_FILE) if text.rstrip().endswith(_END_OF_FILE) else text


def split_lines(text: str) -> list[str]:
    r"""Split at line feeds, carriage returns or both, and nowhere else.

    >>> split_lines("1 2\r\n3 4")
    ['1 2', '3 4']
    """
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    return text.split("\n")
