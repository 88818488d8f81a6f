"""``pointchart figure``: figures for papers, of a scan, a mesh or a surface."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from .option_values import Axis, Figure
from .options import Group, argument, option
from .shared_options import Quiet, out_option

if TYPE_CHECKING:
    from ..clock import StageClock
    from ..report.record import RunReport

# What each kind of figure can be asked for: options that it has no use for are refused, not passed over.
OF_SURFACES, ON_MESHES = (Figure.deviation, Figure.zebra), (Figure.mesh, Figure.plane)
IN_SPACE = (Figure.cloud, Figure.mesh, *OF_SURFACES)
COLORED = (Figure.cloud, *ON_MESHES)


@dataclass(frozen=True, slots=True, kw_only=True)
class FigureLook:
    """What a figure shows, and from where."""

    limit: float | None = option(
        "--limit",
        default=None,
        help="Of deviation: where its colours end; by default 99 % of the points are within.",
        group=Group.figure,
    )
    color: str | None = option(
        "--color",
        default=None,
        metavar="NAME",
        help="Show stretch, or what the file has for each point, such as intensity.",
        group=Group.figure,
    )
    edges: bool | None = option(
        "--edges/--no-edges",
        default=None,
        help="Draw the edges of a mesh; by default up to 20,000 triangles.",
        group=Group.figure,
    )
    view: str | None = option(
        "--view",
        default=None,
        metavar="TURN,TILT",
        help="Degrees to walk around the scan and look down on it; by default onto its mean plane or broad side.",
        group=Group.figure,
    )
    up: Axis | None = option(
        "--up",
        default=None,
        help="Axis of the file that is upwards; by default that of a mesh's opening, z, or y seen along z.",
        group=Group.figure,
    )

    def angles(self) -> tuple[float, float] | None:
        """Return the angles of the view in degrees, if they are given.

        Raises
        ------
        OptionError
        """
        from .choices import view_angles

        return view_angles(self.view)


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetOptions:
    """The sheet that a figure is drawn on."""

    width: float = option(
        "--width", default=85.0, least=20.0, most=1000.0, help="In mm: 85 is a column, 170 a page.", group=Group.output
    )
    dpi: float = option(
        "--dpi",
        default=300.0,
        least=50.0,
        most=2400.0,
        help="Pixels an inch of png, and of images in svg and pdf.",
        group=Group.output,
    )
    transparent: bool = option("--transparent", default=False, help="Leave out the white ground.", group=Group.output)


@dataclass(frozen=True, slots=True, kw_only=True)
class FigureRun:
    """Draw a figure for a paper: a cloud, a parameter plane, a mesh, a deviation map or lines of light (zebra)."""

    command: ClassVar[str] = "figure"

    kind: Figure = argument("KIND", "One of cloud, plane, mesh, deviation, zebra.", is_input=False)
    source: Path = argument(
        "INPUT",
        "Of cloud a scan, of plane and mesh what mesh wrote, of deviation and zebra the JSON that fit wrote.",
    )
    points: Path | None = option(
        "--points",
        default=None,
        metavar="SCAN",
        help="Of deviation: the scan.",
        group=Group.input,
        is_input=True,
    )
    out: Path = out_option("FIGURE", "Figure to write: png, or svg and pdf with lines.")
    look: FigureLook = FigureLook()
    sheet: SheetOptions = SheetOptions()
    running: Quiet = Quiet()

    def check(self) -> None:
        """Check that the options are for the kind of figure.

        Raises
        ------
        OptionError
        """
        from ..errors import OptionError

        look = self.look
        given_for = (
            ("--points", self.points, (Figure.deviation,)),
            ("--limit", look.limit, (Figure.deviation,)),
            ("--color", look.color, COLORED),
            ("--edges", look.edges, ON_MESHES),
            ("--view", look.view, IN_SPACE),
            ("--up", look.up, IN_SPACE),
        )
        for flag, value, kinds in given_for:
            if value is not None and self.kind not in kinds:
                raise OptionError(f"{flag} is for {', '.join(kinds)}, not for {self.kind}")
        if self.kind is Figure.plane and look.edges is False and look.color is None:
            raise OptionError("--no-edges leaves nothing of a plane to see; give --color, too, such as stretch")
        if self.kind is Figure.deviation and self.points is None:
            raise OptionError("deviation needs --points SCAN, the scan that the surface was fitted to")

    def execute(self, clock: StageClock) -> RunReport:
        """Read and draw.

        Raises
        ------
        PointchartError
        """
        from .execution.execute_figure import execute

        return execute(self, clock)
