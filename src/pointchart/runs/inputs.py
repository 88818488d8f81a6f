"""What runs read, once it is known that their outputs can be written."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, Remedy
from ..io import Scan, check_output, read_loop, read_scan, seem_degrees, usable_rows
from ..points.parts import largest_component
from ..report.record import Note
from ..typing import Indices, Loop, Points
from .shared_options import ScanFile, Source


@dataclass(frozen=True, slots=True, eq=False)
class Inputs:
    """What a run works on.

    Attributes
    ----------
    scan : Scan
        As read.
    rows : (k,) int64
        The rows of the scan that are worked on.
    loop : (b,) int64 or None
        The boundary given, in places of `rows`.
    corners : (4,) int64 or None
        The corners named, in places of `rows`.
    notes : tuple of Note
        What of the file is left out, or read otherwise than it stands.
    n_in_other_parts : int
        Points left out since they are in other parts than the one that is worked on.
    """

    scan: Scan
    rows: Indices
    loop: Loop | None = None
    corners: Indices | None = None
    notes: tuple[Note, ...] = ()
    n_in_other_parts: int = 0

    @property
    def points(self) -> Points:
        """The points that are worked on, (k, 3)."""
        return self.scan.points[self.rows]

    def places_of(self, named: ArrayLike, what: str) -> Indices:
        """Return the places in `rows` of named rows of the file.

        Raises
        ------
        InputError
            If some are not worked on, or name no row.
        """
        indices, n_points = np.asarray(named, dtype=np.int64), len(self.scan.points)
        wrong = indices[(indices < 0) | (indices >= n_points)]
        if len(wrong):
            raise InputError(
                f"{len(wrong)} {what} name no point, such as {wrong[0]}; they run from 0 to {n_points - 1}"
            )
        place = np.full(n_points, -1, np.int64)
        place[self.rows] = np.arange(len(self.rows))
        outside = indices[place[indices] < 0]
        if len(outside):
            raise InputError(
                f"{what} {{outside}} are not among the {len(self.rows)} points that are taken; name points of them",
                outside=outside,
            )
        return np.asarray(place[indices])


Outputs = Sequence[tuple[Path | None, Sequence[str]]]


def check_outputs(outputs: Outputs, inputs: Sequence[Path | None]) -> None:
    """Check that files can be written, by the suffixes that each may have, and are none that is read or written."""
    taken = [path for path in inputs if path is not None]
    for path, suffixes in outputs:
        if path is not None:
            taken.append(check_output(path, suffixes=suffixes, inputs=taken))


def read_inputs(source: ScanFile, boundary: Path | None = None, corners: Sequence[int] | None = None) -> Inputs:
    """Read the scan, and the boundary if one is given; the corners are named by rows of the file."""
    columns, classes = source.chosen_columns(), source.chosen_classes()
    read = read_scan(source.scan, columns=columns)
    usable, said = usable_rows(read, classes=classes, drop_invalid=source.drop_invalid)
    if columns is None and seem_degrees(read.points[usable]):
        spans = np.ptp(read.points[usable], axis=0)
        raise InputError(
            f"{source.scan}: x and y span {spans[0]:.3g} and {spans[1]:.3g}, z {spans[2]:.3g}, as degrees and metres "
            "do; project them to metres first, as with PROJ or QGIS",
            remedies=[Remedy.choose_columns],
        )
    rows = usable
    if isinstance(source, Source) and source.component is not None:
        rows = usable[largest_component(read.points[usable])]
    notes = tuple(map(Note, (*read.notes, *said)))
    part = Inputs(read, rows, notes=notes, n_in_other_parts=len(usable) - len(rows))
    if boundary is not None:
        loop = read_loop(boundary)
        is_whole = len(rows) == len(read.points)
        part = replace(part, loop=loop if is_whole else part.places_of(loop, "boundary points"))
    return part if corners is None else replace(part, corners=part.places_of(corners, "corners"))
