"""``pointchart demo``: the whole job on a simulated scan."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from .shared_options import Quiet, out_option

if TYPE_CHECKING:
    from ..clock import StageClock
    from ..report.record import RunReport


@dataclass(frozen=True, slots=True, kw_only=True)
class DemoRun:
    """Simulate a laser scan of a sculpted face, mesh it, print the certificate, write mesh, picture and page."""

    command: ClassVar[str] = "demo"

    out: Path = out_option("DIR", "Folder for the scan, the mesh, the picture and the page.", default=Path("demo"))
    running: Quiet = Quiet()

    def execute(self, clock: StageClock) -> RunReport:
        """Simulate, mesh, write.

        Raises
        ------
        PointchartError
        """
        from .execution.execute_demo import execute

        return execute(self, clock)
