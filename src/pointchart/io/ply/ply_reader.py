"""PLY to a scan: text and binary of either byte order, any properties, polygons."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import FormatError
from ...typing import Indices
from ..scan import Scan, fan_triangles, scan_from_columns
from ..source import AnyPath, decode, read_bytes, split_lines
from .ply_header import Element, Property, parse_header
from .ply_rows import Group, binary_groups, cut_off, text_groups

_CORNERS = ("vertex_indices", "vertex_index")  # both names are in use


def read_ply(path: AnyPath) -> Scan:
    """Read vertices with all their single values, and faces; lists of vertices and other elements are passed over.

    Coordinates written as text are read in double precision, whatever type the header gives them.
    """
    data = read_bytes(path)
    header = parse_header(path, data)
    names = [element.name for element in header.elements]
    if "vertex" not in names:
        raise FormatError(f"{path}: there is no element 'vertex' among {names}; export the file with its points")
    last = max(names.index(name) for name in ("vertex", "face") if name in names)
    wanted = header.elements[: last + 1]
    if header.order:
        groups = _read_binary(path, data, header.n_bytes, wanted, header.order)
    else:
        groups = _read_text(path, data[header.n_bytes :], header.n_lines + 1, wanted)
    vertex = header.elements[names.index("vertex")]
    columns = _columns(vertex, groups[names.index("vertex")])
    polygons: list[tuple[Indices, Indices]] = []
    if "face" in names:
        polygons = _polygons(header.elements[names.index("face")], groups[names.index("face")])
    return scan_from_columns(path, columns, fan_triangles(path, polygons, vertex.n_rows))


def _read_binary(path: AnyPath, data: bytes, start: int, elements: list[Element], order: str) -> list[list[Group]]:
    groups = []
    for element in elements:
        own, start = binary_groups(path, data, start, element, order)
        groups.append(own)
    return groups


def _read_text(path: AnyPath, data: bytes, first_line: int, elements: list[Element]) -> list[list[Group]]:
    lines = split_lines(decode(data))
    kept = [i for i, line in enumerate(lines) if line and not line.isspace()]
    lines = [lines[i] for i in kept]
    groups, start = [], 0
    for element in elements:
        end = start + element.n_rows
        if end > len(lines):
            raise cut_off(path, element, len(lines) - start)
        numbers = [i + first_line for i in kept[start:end]]
        groups.append(text_groups(path, lines[start:end], numbers, _with_double_coordinates(element)))
        start = end
    return groups


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
