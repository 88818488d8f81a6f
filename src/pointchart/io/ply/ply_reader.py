"""PLY to a scan: text and binary of either byte order, any properties, polygons."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import FormatError
from ...typing import Indices
from ..scan import Scan, fan_triangles, scan_from_columns
from ..source import AnyPath, decode, read_bytes, split_lines, without_end_mark
from ..table import is_index
from .ply_header import Element, Header, Property, parse_header
from .ply_rows import Group, binary_groups, cut_off, text_groups

_BYTE_ORDER_MARK = b"\xef\xbb\xbf"  # of UTF-8, which editors put before text
_CORNERS = ("vertex_indices", "vertex_index")  # both names are in use


def read_ply(path: AnyPath) -> Scan:
    """Read vertices with all their single values, and faces; lists of vertices and other elements are passed over.

    Coordinates written as text are read in double precision, whatever type the header gives them.
    """
    data = read_bytes(path).removeprefix(_BYTE_ORDER_MARK)
    header = parse_header(path, data)
    names = [element.name for element in header.elements]
    if "vertex" not in names:
        raise FormatError(f"{path}: there is no element 'vertex' among {names}; export the file with its points")
    last = max(names.index(name) for name in ("vertex", "face") if name in names)
    wanted = header.elements[: last + 1]
    body = _Body(path, data, header, wanted)
    groups, notes = body.binary() if header.order else body.text()
    vertex = header.elements[names.index("vertex")]
    columns = _columns(vertex, groups[names.index("vertex")])
    polygons: list[tuple[Indices, Indices]] = []
    if "face" in names:
        polygons = _polygons(header.elements[names.index("face")], groups[names.index("face")])
    return scan_from_columns(path, columns, fan_triangles(path, polygons, vertex.n_rows), notes=notes)


@dataclass(frozen=True, slots=True)
class _Body:
    """What follows the header, and the elements up to the last one that is wanted.

    Both readers return the groups of rows of each element, and a sentence on each thing passed over.
    """

    path: AnyPath
    data: bytes
    header: Header
    wanted: list[Element]

    def binary(self) -> tuple[list[list[Group]], list[str]]:
        groups, start = [], self.header.n_bytes
        for element in self.wanted:
            own, start = binary_groups(self.path, self.data, start, element, self.header.order)
            groups.append(own)
        return groups, self._behind(len(self.data) - start, "byte")

    def text(self) -> tuple[list[list[Group]], list[str]]:
        lines = split_lines(without_end_mark(decode(self.data[self.header.n_bytes :])))
        numbers = [i for i, line in enumerate(lines, start=self.header.n_lines + 1) if line and not line.isspace()]
        lines = [lines[number - self.header.n_lines - 1] for number in numbers]
        groups, start, notes = [], 0, []
        for element in self.wanted:
            own, own_numbers, n_lines = _rows(lines, numbers, start, element)
            if len(own) < element.n_rows:
                raise cut_off(self.path, element, len(own))
            if n_more := _numbers_behind_lists(own, element):
                own = [" ".join(line.split()[:-n_more]) for line in own]
                notes.append(f"each {element.name} has {n_more} more numbers than the header names; they are left out")
            groups.append(text_groups(self.path, own, own_numbers, _with_double_coordinates(element)))
            start += n_lines
        return groups, notes + self._behind(len(lines) - start, "line")

    def _behind(self, n_left: int, unit: str) -> list[str]:
        """Say how much follows the last element; what follows an element that is not wanted is another one."""
        if n_left <= 0 or len(self.wanted) < len(self.header.elements):
            return []
        announced = self.wanted[-1]
        return [
            f"{n_left} {unit}{'s' * (n_left > 1)} behind the {announced.n_rows} rows of {announced.name} passed over"
        ]


def _rows(lines: list[str], numbers: list[int], start: int, element: Element) -> tuple[list[str], list[int], int]:
    """Return the rows of an element with their line numbers, and of how many lines they are made.

    A row without lists may be broken into lines, all in the same way, as RealSense Viewer does.
    """
    n_each = 1
    if not any(p.count_type for p in element.properties):
        n_fields = 0
        for k, line in enumerate(lines[start : start + len(element.properties)], start=1):
            n_fields += len(line.split())
            if n_fields >= len(element.properties):
                n_each = k if n_fields == len(element.properties) else 1
                break
    end = start + element.n_rows * n_each
    own = lines[start:end] if n_each == 1 else [" ".join(lines[i : i + n_each]) for i in range(start, end, n_each)]
    return [row for row in own if row], numbers[start:end:n_each], element.n_rows * n_each


def _numbers_behind_lists(rows: list[str], element: Element) -> int:
    """Return how many numbers more than the header names stand in every row of an element of one list."""
    if len(element.properties) != 1 or element.properties[0].count_type is None or not rows:
        return 0
    more = {len(fields) - 1 - int(fields[0]) if is_index(fields[0]) else 0 for fields in map(str.split, rows)}
    return max(0, *more) if len(more) == 1 else 0


def _with_double_coordinates(element: Element) -> Element:
    is_coordinate = {p.name: p.count_type is None and p.name in ("x", "y", "z") for p in element.properties}
    properties = [Property(p.name, "f8") if is_coordinate[p.name] else p for p in element.properties]
    return Element(element.name, element.n_rows, properties)


def _columns(element: Element, groups: list[Group]) -> dict[str, NDArray[Any]]:
    """Bring each single value of the rows back into the order of the file."""
    single = [p for p in element.properties if p.count_type is None]
    if len(groups) == 1:
        return {p.name: groups[0][1][p.name] for p in single}
    columns = {p.name: np.empty(element.n_rows, p.type) for p in single}
    for places, rows in groups:
        for name, column in columns.items():
            column[places] = rows[name]
    return columns


def _polygons(element: Element, groups: list[Group]) -> list[tuple[Indices, Indices]]:
    lists = [p.name for p in element.properties if p.count_type is not None]
    named = [name for name in lists if name in _CORNERS] or lists[:1]
    return [(places, rows[name]) for name in named[:1] for places, rows in groups]
