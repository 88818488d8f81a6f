"""``pointchart fit``: from a scan to a smooth surface that CAD reads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from .option_values import Domain, Holes, Spacing, SurfaceDomain, Unit
from .options import Group, option
from .shared_options import GivenBoundary, Running, Source, Told, corners_option, out_option

if TYPE_CHECKING:
    from ..clock import StageClock
    from ..map.scan_parameters import LayoutRule
    from ..report.record import RunReport
    from ..surface.loss import Loss
    from ..typing import Indices


@dataclass(frozen=True, slots=True, kw_only=True)
class FitOptions:
    """How near a surface comes to its scan, and how smooth it is."""

    tolerance: str = option(
        "--tolerance",
        default="0.1%",
        help="Largest deviation, in the unit of the scan, such as 0.05, or in % of its diagonal.",
        group=Group.surface,
    )
    outliers: str = option(
        "--outliers",
        default="0.5%",
        help="Share of the points that may deviate by more, such as 0.005 or 0.5%.",
        group=Group.surface,
    )
    max_control_points: int | None = option(
        "--max-control-points",
        default=None,
        least=1,
        help="At most so many, and as many as points; by default half as many.",
        group=Group.surface,
    )
    degree: int = option(
        "--degree", default=3, least=2, most=5, help="Of the surface, in both directions.", group=Group.surface
    )
    fairness: str = option(
        "--fairness",
        default="auto",
        help="Weight of the thin plate energy, such as 1e-5; auto: chosen by points left out.",
        group=Group.surface,
    )
    robust: bool = option(
        "--robust", default=False, help="Give points far off less weight (Huber).", group=Group.surface
    )
    unit: Unit = option(
        "--unit", default=Unit.mm, help="Unit of the scan, for STEP, IGES and JSON.", group=Group.surface
    )
    best_effort: bool = option(
        "--best-effort",
        default=False,
        help="Where the tolerance is not met, write the best surface, and exit with 0.",
        group=Group.surface,
    )

    def allowed(self) -> Callable[[float], float]:
        """Return the function that gives the tolerance for a scan of a diagonal.

        Raises
        ------
        OptionError
        """
        from .choices import amount

        return amount("--tolerance", self.tolerance, positive=True)

    def share(self) -> float:
        """Return the share of the points that may deviate by more.

        Raises
        ------
        OptionError
        """
        from .choices import amount

        return amount("--outliers", self.outliers, below=1.0)(1.0)

    def weight(self) -> float | None:
        """Return the weight of the thin plate energy; None leaves the choice to the library.

        Raises
        ------
        OptionError
        """
        from .choices import fairness_weight

        return fairness_weight(self.fairness)

    def loss(self) -> Loss:
        """Return the loss."""
        from ..surface import huber, squares

        return huber if self.robust else squares


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfacePlane:
    """The domain of a surface."""

    domain: SurfaceDomain = option(
        "--domain",
        default=SurfaceDomain.free,
        help="Of the parameters: with a free boundary, trimmed; or square, a four-sided patch.",
        group=Group.parameters,
    )
    corners: str | None = corners_option()

    def named_corners(self) -> list[int] | None:
        """Return the boundary points named for the corners of the square, if any are.

        Raises
        ------
        OptionError
        """
        from .choices import corner_names

        return corner_names(self.domain, self.corners)

    def square(self, corners: Indices | None) -> LayoutRule | None:
        """Return the function that lays the boundary out on the square, if that is the domain."""
        from .choices import layout_rule

        return layout_rule(Domain.square, Spacing.chord, corners) if self.domain is SurfaceDomain.square else None


@dataclass(frozen=True, slots=True, kw_only=True)
class FitFiles:
    """What a fit writes and tells of its surface."""

    out: Path = out_option(
        "SURFACE", "Surface to write: step, iges, brep (extra cad), json; or its triangles: ply, obj, stl, glb, ..."
    )
    deviations: Path | None = option(
        "--deviations",
        default=None,
        metavar="FILE",
        help="Write x, y, z, u, v and signed deviation of each point: csv, ply, npz.",
        group=Group.output,
    )
    picture: Path | None = option(
        "--picture",
        default=None,
        metavar="FILE",
        help="Draw the deviation map and its histogram: png, svg, pdf.",
        group=Group.output,
    )
    reflections: Path | None = option(
        "--reflections",
        default=None,
        metavar="FILE",
        help="Draw reflection lines and curvature: png, svg, pdf.",
        group=Group.output,
    )
    explain: bool = option("--explain", default=False, help="Say which choices were made and why.", group=Group.output)


@dataclass(frozen=True, slots=True, kw_only=True)
class FitRun:
    """Fit a trimmed B-spline surface to a scan of one surface patch, to a tolerance, for CAD."""

    command: ClassVar[str] = "fit"

    source: Source
    given: GivenBoundary = GivenBoundary()
    holes: Holes | None = option(
        "--holes",
        default=None,
        help="Bridge all gaps of the scan, or cut them out; by default cut out unless one may be the boundary.",
        group=Group.boundary,
    )
    plane: SurfacePlane = SurfacePlane()
    surface: FitOptions = FitOptions()
    files: FitFiles
    told: Told = Told()
    running: Running = Running()

    def execute(self, clock: StageClock) -> RunReport:
        """Read, fit, write.

        Raises
        ------
        PointchartError
        """
        from .execution.execute_fit import execute

        return execute(self, clock)
