"""The header of a PLY file."""

import re
from dataclasses import dataclass, field

from ...errors import FormatError
from ..source import AnyPath, decode
from ..table import is_index

# The eight types of the format (Turk 1994), which are written, and the names with sizes, which are read as well.
TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "float": "f4",
    "double": "f8",
}
_SIZED = {"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4"}
_SIZED |= {"int64": "i8", "uint64": "u8", "float32": "f4", "float64": "f8"}
_CODES = TYPES | _SIZED  # those of 64 bits are of no standard, but are written
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}  # as numpy and struct call them
# What the errors of looking up a word mean, for whoever wrote the file.
_REASONS = {KeyError: "a type or format is unknown", IndexError: "a word or the element before it is missing"}
_START = re.compile(rb"ply[ \t]*(\r\n|\n|\r)")  # the line end of this line is that of the header


@dataclass(frozen=True, slots=True)
class Property:
    """A value, or with `count_type` a list of values behind their number; types are numpy codes as `f8`."""

    name: str
    type: str
    count_type: str | None = None


@dataclass(slots=True)
class Element:
    """`n_rows` rows of the same properties."""

    name: str
    n_rows: int
    properties: list[Property] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Header:
    """`order` is '<' or '>', or '' for text; the rows start at byte `n_bytes`, line `n_lines` counted from 0."""

    order: str
    elements: list[Element]
    n_bytes: int
    n_lines: int


def parse_header(path: AnyPath, data: bytes) -> Header:
    """Parse the header; a FormatError names the line that cannot be understood."""
    start = _START.match(data)
    if start is None:
        raise FormatError(f"{path}: line 1 is not 'ply'; give the file the suffix of its format")
    newline = start[1]
    # With the line end of the first line alone: another that follows may be a byte of the first point.
    end = re.search(newline + rb"end_header[ \t]*(?:" + newline + rb"|$)", data)
    if end is None:
        raise FormatError(f"{path}: the header has no 'end_header' in {len(data)} bytes; copy or export it again")
    lines = decode(data[: end.start()]).split(newline.decode())
    order: str | None = None
    elements: list[Element] = []
    for number, line in enumerate(lines[1:], start=2):
        words = line.split()
        if not words or words[0] in ("comment", "obj_info"):
            continue
        try:
            if words[0] == "format":
                order = _ORDERS[words[1]]
            elif words[0] == "element":
                elements.append(Element(words[1], _count(words[2])))
            elif words[0] == "property":
                _add(elements[-1], words[1:])
            else:
                raise ValueError(f"'{words[0]}' begins no header line")
        except (KeyError, IndexError, ValueError) as error:
            reason = str(error) if isinstance(error, ValueError) else _REASONS[type(error)]
            raise FormatError(
                f"{path}: header line {number} '{line.strip()[:60]}' is wrong ({reason}); export the file again"
            ) from None
    for element in elements:
        if element.n_rows and not element.properties:
            raise FormatError(f"{path}: the header gives {element.n_rows} rows of {element.name} no property; add them")
    if order is None:
        raise FormatError(f"{path}: none of the {len(lines)} header lines gives the format; add 'format ascii 1.0'")
    return Header(order, elements, end.end(), len(lines) + 1)


def _count(word: str) -> int:
    if not is_index(word):
        raise ValueError("the count must be a whole number from 0 on")
    return int(word)


def _add(element: Element, words: list[str]) -> None:
    if words[0] == "list":
        count_type, value_type, name = _CODES[words[1]], _CODES[words[2]], words[3]
        if count_type[0] == "f":
            raise ValueError("the number of values in a list must have an integer type")
        new = Property(name, value_type, count_type)
    else:
        new = Property(words[1], _CODES[words[0]])
    if any(old.name == new.name for old in element.properties):
        raise ValueError(f"the property {new.name} stands twice in element {element.name}")
    element.properties.append(new)
