"""``pointchart check``: certify a mesh from a file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from .options import Group, argument, option
from .shared_options import Quiet, report_option

if TYPE_CHECKING:
    from ..clock import StageClock
    from ..report.record import RunReport


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckRun:
    """Check that a mesh is a disc, on the points of a scan if one is given; exit 1 if it is not."""

    command: ClassVar[str] = "check"

    mesh: Path = argument("MESH", "Mesh to check: ply, obj, off, stl, glb, npz.")
    points: Path | None = option(
        "--points",
        default=None,
        metavar="SCAN",
        help="The scan: vertex i has to be its point i.",
        group=Group.input,
        is_input=True,
    )
    holes: int = option(
        "--holes",
        default=0,
        least=0,
        help="How many holes the disc should have: gaps that were left open.",
        group=Group.boundary,
    )
    report: Path | None = report_option()
    running: Quiet = Quiet()

    def execute(self, clock: StageClock) -> RunReport:
        """Read and certify; a mesh that is not as asked has a report all the same, with a failure in it.

        Raises
        ------
        PointchartError
        """
        from .execution.execute_check import execute

        return execute(self, clock)
