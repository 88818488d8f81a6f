"""The bytes and the lines of an input file, or one sentence on why there are none."""

import os
from pathlib import Path
from typing import TypeAlias

from ..errors import FormatError

AnyPath: TypeAlias = str | os.PathLike[str]

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


def read_bytes(path: AnyPath) -> bytes:
    """Return all bytes of a file that is not empty."""
    check_readable(path)
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise FormatError(f"{path}: it cannot be read ({error.strerror}); copy it to a local disk") from error


def read_lines(path: AnyPath) -> list[str]:
    """Return the lines of a text file without their ends, whatever the line ends and the encoding."""
    data = read_bytes(path)
    if data.startswith(_UTF16_MARKS):
        text = data.decode("utf-16", errors="replace")
    elif (nul := data.find(b"\0")) >= 0:
        raise FormatError(f"{path}: byte {nul} is zero, so this is no text file; give it the suffix of its format")
    else:
        text = decode(data)
    return split_lines(text)


def decode(data: bytes) -> str:
    """Decode UTF-8 with or without a byte order mark, and anything else as Latin-1."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def split_lines(text: str) -> list[str]:
    r"""Split at line feeds, carriage returns or both, and nowhere else.

    >>> split_lines("1 2\r\n3 4")
    ['1 2', '3 4']
    """
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    return text.split("\n")
