"""What the commands read, once it is known that their outputs can be written."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..components import largest_component
from ..errors import InputError
from ..io import Scan, check_output, read_loop, read_scan
from ..typing import Indices, Loop, Points
from .choices import Component


@dataclass(frozen=True, slots=True, eq=False)
class Inputs:
    """What a command works on.

    Attributes
    ----------
    scan : Scan
        As read.
    rows : (k,) int64
        The rows of the scan that are worked on.
    loop : (b,) int64 or None
        The boundary given, in places of `rows`.
    """

    scan: Scan
    rows: Indices
    loop: Loop | None

    @property
    def points(self) -> Points:
        """The points that are worked on, (k, 3)."""
        return self.scan.points[self.rows]


def read_inputs(
    scan: Path,
    boundary: Path | None,
    *,
    out: Path,
    suffixes: Sequence[str],
    report: Path | None = None,
    component: Component | None = None,
) -> Inputs:
    """Check the output and the report, then read the scan and the boundary, if one is given."""
    inputs = [scan] if boundary is None else [scan, boundary]
    check_output(out, suffixes=suffixes, inputs=inputs)
    if report is not None:
        check_output(report, suffixes=(".json",), inputs=[*inputs, out])
    read = read_scan(scan)
    loop = None if boundary is None else read_loop(boundary)
    if component is None:
        return Inputs(read, np.arange(len(read.points)), loop)
    rows = largest_component(read.points)
    return Inputs(read, rows, None if loop is None else _places(loop, rows, len(read.points)))


def _places(loop: Loop, rows: Indices, n_points: int) -> Loop:
    place = np.full(n_points, -1, np.int64)
    place[rows] = np.arange(len(rows))
    named = loop[(loop >= 0) & (loop < n_points)]
    outside = named[place[named] < 0]
    if len(outside) or len(named) < len(loop):
        raise InputError(
            f"{len(loop) - len(named) + len(outside)} boundary points are not among the {len(rows)} points of the "
            "largest part ({outside}); give a boundary of that part",
            outside=outside,
        )
    return np.asarray(place[loop])
