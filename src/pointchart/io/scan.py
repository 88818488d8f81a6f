"""What a scan file holds, and how the readers put it together."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from ..typing import UV, Attributes, Indices, Points, Triangles
from .column_names import coordinates_among, named_columns
from .source import AnyPath


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """The content of a scan file, in the order of the file.

    Parameters
    ----------
    points
        (n, 3) float64, in the unit of the file; not-a-number is passed on.
    triangles
        (m, 3) int64 point indices; (0, 3) when the file has no faces.
    attributes
        Everything else that the file carries for each point, by name, each (n,) with the dtype of the file.
    valid
        (n,) bool, false for rows that are no points by the format itself, such as no-returns of an organised frame;
        None where all rows are points.
    notes
        A sentence on each thing in the file that is not in the scan, or is read otherwise than it stands.
    """

    points: Points
    triangles: Triangles
    attributes: Attributes
    valid: NDArray[np.bool_] | None = None
    notes: tuple[str, ...] = ()

    def without_points(self, is_none: NDArray[np.bool_], why: str = "no point") -> "Scan":
        """Return the scan with rows named as no points, and a sentence on how many and why.

        Examples
        --------
        >>> Scan(np.zeros((2, 3)), np.empty((0, 3), np.int64), {}).without_points(np.array([True, False])).notes
        ('1 of 2 rows is no point, and left out',)
        """
        n_none = int(np.count_nonzero(is_none))
        if not n_none:
            return self
        said = f"{n_none} of {len(is_none)} rows {'is' if n_none == 1 else 'are'} {why}, and left out"
        valid = ~is_none if self.valid is None else self.valid & ~is_none
        return replace(self, valid=valid, notes=(*self.notes, said))

    @property
    def uv(self) -> UV | None:
        """The parameters that the file carries as u and v, (n, 2) float64; None if it has none.

        >>> Scan(np.zeros((1, 3)), np.empty((0, 3), np.int64), {"v": np.array([4]), "u": np.array([3])}).uv.tolist()
        [[3.0, 4.0]]
        """
        if "u" not in self.attributes or "v" not in self.attributes:
            return None
        return np.column_stack([self.attributes["u"], self.attributes["v"]]).astype(np.float64)


def scan_from_columns(
    path: AnyPath,
    columns: Mapping[str, NDArray[Any]],
    triangles: Triangles | None = None,
    extra: Attributes | None = None,
    notes: Sequence[str] = (),
) -> Scan:
    """Make a scan of the named columns of a file: x, y, z are the points, the others are attributes."""
    found = coordinates_among(list(columns))
    if found is not None and not {"x", "y", "z"} <= columns.keys():
        columns = dict(zip(named_columns(found, columns), columns.values(), strict=True))
    missing = [axis for axis in "xyz" if axis not in columns]
    if missing:
        raise FormatError(
            f"{path}: the coordinate {', '.join(missing)} is missing among the {len(columns)} columns "
            f"({', '.join(columns) or 'none'}); name the columns x, y and z"
        )
    points = np.stack([columns[axis] for axis in "xyz"], axis=1).astype(np.float64, copy=False)
    attributes = {name: _own(column) for name, column in columns.items() if name not in ("x", "y", "z")}
    return Scan(
        points,
        np.empty((0, 3), np.int64) if triangles is None else triangles,
        attributes | (extra or {}),
        notes=tuple(notes),
    )


def common_columns(parts: Sequence[Mapping[str, NDArray[Any]]]) -> dict[str, NDArray[Any]]:
    """Join the columns of several parts of a file; one that only some of them have has no value for the others.

    >>> common_columns([{"x": np.array([1]), "grey": np.array([9])}, {"x": np.array([2])}])
    {'x': array([1, 2])}
    """
    common = [name for name in parts[0] if all(name in part for part in parts)]
    return {name: np.concatenate([part[name] for part in parts]) for name in common}


def uv_columns(uv: UV | None) -> Attributes:
    """Return parameters as the columns of a file, which `Scan.uv` puts together again.

    >>> uv_columns(np.array([[3.0, 4.0]]))["v"].tolist()
    [4.0]
    """
    return {} if uv is None else {"u": uv[:, 0], "v": uv[:, 1]}


def fan_triangles(
    path: AnyPath, polygons: Sequence[tuple[Indices, Indices]], n_points: int, *, first: int = 0
) -> Triangles:
    """Cut each polygon into triangles that share its first corner.

    Parameters
    ----------
    path
        The file, for messages.
    polygons
        Groups of polygons with equally many corners: (m,) place of each in the file, and (m, corners) point indices.
        Those of fewer than three corners are dropped.
    n_points
        Number of points in the file.
    first
        Index of the file's first point and face, for messages.

    Returns
    -------
    (m, 3) int64 in the order of the file.

    Examples
    --------
    >>> fan_triangles("a.off", [(np.array([0]), np.array([[4, 5, 6, 7]]))], 8)
    array([[4, 5, 6],
           [4, 6, 7]])
    """
    owners, triangles = [np.empty(0, np.int64)], [np.empty((0, 3), np.int64)]
    for places, corners in polygons:
        bad = np.argwhere((corners < 0) | (corners >= n_points))
        if len(bad):
            row, column = bad[0]
            raise FormatError(
                f"{path}: face {places[row] + first} refers to vertex {corners[row, column] + first}, but there are "
                f"{n_points}, numbered from {first}; the file is damaged, so export it again"
            )
        for k in range(1, corners.shape[1] - 1):
            owners.append(places)
            triangles.append(corners[:, [0, k, k + 1]].astype(np.int64, copy=False))
    in_file_order = np.argsort(np.concatenate(owners), kind="stable")
    return np.concatenate(triangles)[in_file_order]


def _own(column: NDArray[Any]) -> NDArray[Any]:
    return np.array(column, dtype=column.dtype.newbyteorder("="))
