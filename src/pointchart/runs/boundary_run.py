"""``pointchart boundary``: find and order the boundary of a scan."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from .options import Group, option
from .shared_options import Running, Source, out_option, outer_option

if TYPE_CHECKING:
    from ..clock import StageClock
    from ..report.record import RunReport


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundaryRun:
    """Find the boundary of a scan and write its points in order; the file can be edited and given back to mesh."""

    command: ClassVar[str] = "boundary"

    source: Source
    outer: str | None = outer_option()
    out: Path = out_option("LOOP.txt", "Loop to write: one 0-based point index a line.")
    picture: Path | None = option(
        "--picture",
        default=None,
        metavar="FILE",
        help="Draw the cloud, its scores and the loops: png, svg, pdf.",
        group=Group.output,
    )
    ply: Path | None = option(
        "--ply",
        default=None,
        metavar="PLY",
        help="Write the loops as polylines and the scores as vertex properties.",
        group=Group.output,
    )
    running: Running = Running()

    def execute(self, clock: StageClock) -> RunReport:
        """Read, find, write.

        Raises
        ------
        PointchartError
        """
        from .execution.execute_boundary import execute

        return execute(self, clock)
