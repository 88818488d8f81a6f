"""``pointchart param``: the paper's parameters of a scan."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from .shared_options import (
    ConvexDomain,
    GivenBoundary,
    PaperMethod,
    Running,
    ScanFile,
    out_option,
    report_option,
)

if TYPE_CHECKING:
    from ..clock import StageClock
    from ..report.record import RunReport


@dataclass(frozen=True, slots=True, kw_only=True)
class ParamRun:
    """Give every point of a scan planar parameters by the paper's method, without a mesh; row i is point i."""

    command: ClassVar[str] = "param"

    source: ScanFile
    given: GivenBoundary = GivenBoundary()
    plane: ConvexDomain = ConvexDomain()
    method: PaperMethod = PaperMethod()
    out: Path = out_option("UV", "Parameters to write: csv, txt, xyz, npy, npz, ply.")
    report: Path | None = report_option()
    running: Running = Running()

    def execute(self, clock: StageClock) -> RunReport:
        """Read, map, write.

        Raises
        ------
        PointchartError
        """
        from .execution.execute_param import execute

        return execute(self, clock)
