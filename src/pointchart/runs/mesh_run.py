"""``pointchart mesh``: from a scan to a certified disc."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from .option_values import Chart, Holes, KeptPoint, Swap
from .options import Group, option
from .shared_options import ConvexDomain, GivenBoundary, PaperMethod, Running, Source, Told, out_option

if TYPE_CHECKING:
    from ..clock import StageClock
    from ..report.record import RunReport


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshOptions:
    """What becomes of gaps, edges and parameters, and whether the scan is a height field."""

    holes: Holes | None = option(
        "--holes",
        default=None,
        help="Bridge all gaps of the scan, or leave them open; by default they are bridged unless one may be the "
        "boundary.",
        group=Group.boundary,
    )
    swap: Swap = option(
        "--swap",
        default=Swap.delaunay,
        help="Edge swaps in space: Delaunay, or on from there to edges along creases.",
        group=Group.mesh,
    )
    uv: Chart = option(
        "--uv",
        default=Chart.mesh,
        help="Parameters: one-to-one on the mesh, with low stretch, with a free boundary, or the paper's own.",
        group=Group.parameters,
    )
    plane: str | None = option(
        "--plane",
        default=None,
        metavar="xy|fit|A,B,C",
        help="Mesh a height field, as terrain, by its projection to this plane; fit is the plane of least squares, "
        "A,B,C a normal.",
        group=Group.boundary,
    )
    keep: KeptPoint | None = option(
        "--keep",
        default=None,
        help="Of several points at one place of the plane, keep this one.",
        group=Group.boundary,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshRun:
    """Mesh a scan of one surface patch: a triangle mesh on exactly its points, certified to be a disc, with uv."""

    command: ClassVar[str] = "mesh"

    source: Source
    given: GivenBoundary = GivenBoundary()
    plane: ConvexDomain = ConvexDomain()
    mesh: MeshOptions = MeshOptions()
    method: PaperMethod = PaperMethod()
    out: Path = out_option("MESH", "Mesh to write: ply, obj, off, stl, glb, npz.")
    told: Told = Told()
    running: Running = Running()

    def execute(self, clock: StageClock) -> RunReport:
        """Read, mesh, write.

        Raises
        ------
        PointchartError
        """
        from .execution.execute_mesh import execute

        return execute(self, clock)
