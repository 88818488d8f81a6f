"""Options that several runs share, and the functions of the library that their words name."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .option_values import Component, Domain, Neighbors, Spacing, Weighting
from .options import Group, argument, option

if TYPE_CHECKING:
    from ..map.scan_parameters import Connect, LayoutRule
    from ..map.weights import WeightScheme
    from ..typing import Floats, Indices


def scan_argument() -> Any:
    """Describe the scan."""
    told = "Point cloud: ply, pcd, las, laz, e57, xyz, txt, csv, pts, ptx, asc, vtk, obj, off, stl, glb, npz; or .gz."
    return argument("SCAN", told)


def boundary_option() -> Any:
    """Describe the boundary that is given."""
    told = "Boundary points in order, one 0-based index a line; found, if not given."
    return option("--boundary", default=None, metavar="LOOP.txt", help=told, group=Group.boundary, is_input=True)


def outer_option() -> Any:
    """Describe the place that the boundary passes nearest to."""
    told = "Of the loops found, the boundary is the one nearest to this place."
    return option("--outer", default=None, metavar="X,Y,Z", help=told, group=Group.boundary)


def corners_option() -> Any:
    """Describe the corners of the square."""
    told = "Four boundary points for the corners of the square, else the sharpest turns."
    return option("--corners", default=None, metavar="A,B,C,D", help=told, group=Group.parameters)


def out_option(metavar: str, help: str, **more: Any) -> Any:
    """Describe the file or folder that a run is there to write."""
    return option("--out", "-o", metavar=metavar, help=help, group=Group.output, **more)


def report_option() -> Any:
    """Describe the report."""
    told = "Write what was done and proved as JSON."
    return option("--report", default=None, metavar="RUN.json", help=told, group=Group.output)


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanFile:
    """A file that holds a scan, and which of its columns and rows are the points."""

    scan: Path = scan_argument()
    columns: str | None = option(
        "--columns",
        default=None,
        metavar="X,Y,Z",
        help="Of a text file, the columns that are x, y, z: names of its header, or numbers from 1.",
        group=Group.input,
    )
    classes: str | None = option(
        "--classes",
        default=None,
        metavar="A,B,...",
        help="Take the points of these classes only, such as 2 for ground in LAS.",
        group=Group.input,
    )
    drop_invalid: bool = option(
        "--drop-invalid",
        default=False,
        help="Leave out rows without coordinates and repeated rows of 0 0 0; of PCD, PTX and LAS always.",
        group=Group.input,
    )

    def chosen_columns(self) -> tuple[str, str, str] | None:
        """Return the columns of x, y, z by name or number, if they are given.

        Raises
        ------
        OptionError
        """
        from .choices import column_names

        return column_names(self.columns)

    def chosen_classes(self) -> list[int] | None:
        """Return the classes to take, if not all are.

        Raises
        ------
        OptionError
        """
        from .choices import class_numbers

        return class_numbers(self.classes)


@dataclass(frozen=True, slots=True, kw_only=True)
class Source(ScanFile):
    """A scan, or a part of it."""

    component: Component | None = option(
        "--component",
        default=None,
        help="Of a scan in several parts, take the largest; point_index names its rows.",
        group=Group.input,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenBoundary:
    """What is known of the boundary: all of it, or a place."""

    boundary: Path | None = boundary_option()
    outer: str | None = outer_option()

    @property
    def is_given(self) -> bool:
        """Whether all of it is known."""
        return self.boundary is not None

    def place(self) -> Floats | None:
        """Return the place that the boundary passes nearest to, unless it is given.

        Raises
        ------
        OptionError
        """
        from .choices import outer_place

        return outer_place(self.outer, self.boundary)


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperMethod:
    """Neighbourhoods and weights of the paper's methods."""

    neighbors: Neighbors | None = option(
        "--neighbors",
        default=None,
        help="Neighbourhoods of the paper's methods instead of linked Delaunay stars.",
        group=Group.methods,
    )
    k: int | None = option(
        "-k",
        default=None,
        least=1,
        help="Number of nearest points that neighbours are taken from.",
        group=Group.methods,
    )
    radius: float | None = option(
        "--radius", default=None, help="Radius of the ball, in the unit of the scan.", group=Group.methods
    )
    weights: Weighting | None = option(
        "--weights",
        default=None,
        help="Convex weights of the paper's methods; by default mean-value, reciprocal for ball and nearest.",
        group=Group.methods,
    )

    def connect(self) -> Connect | None:
        """Return the function that finds neighbourhoods; None leaves the choice to the library.

        Raises
        ------
        OptionError
        """
        from .choices import connect_rule

        return connect_rule(self.neighbors, self.k, self.radius)

    def scheme(self) -> WeightScheme | None:
        """Return the weights; None leaves the choice to the library."""
        from .choices import weights_rule

        return weights_rule(self.weights, self.neighbors)


@dataclass(frozen=True, slots=True, kw_only=True)
class ConvexDomain:
    """The domain of the parameters, and how the boundary lies on it."""

    domain: Domain = option(
        "--domain",
        default=Domain.circle,
        help="Convex domain of the parameters: unit circle or unit square.",
        group=Group.parameters,
    )
    corners: str | None = corners_option()
    spacing: Spacing = option(
        "--spacing",
        default=Spacing.chord,
        help="Spacing of the parameters along the boundary.",
        group=Group.parameters,
    )

    def named_corners(self) -> list[int] | None:
        """Return the boundary points named for the corners of the square, if any are.

        Raises
        ------
        OptionError
        """
        from .choices import corner_names

        return corner_names(self.domain, self.corners)

    def layout(self, corners: Indices | None) -> LayoutRule:
        """Return the function that lays the boundary out, with the corners at the points given, if any are."""
        from .choices import layout_rule

        return layout_rule(self.domain, self.spacing, corners)


@dataclass(frozen=True, slots=True, kw_only=True)
class Told:
    """Files that tell of a run."""

    report: Path | None = report_option()
    html: Path | None = option(
        "--html",
        default=None,
        metavar="RUN.html",
        help="Write a page that opens offline: mesh and uv to turn and point at.",
        group=Group.output,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Quiet:
    """Whether a run is to say how it goes."""

    quiet: bool = option("--quiet", "-q", default=False, help="Say nothing but errors.", group=Group.running)


@dataclass(frozen=True, slots=True, kw_only=True)
class Running(Quiet):
    """The same, and on how many threads it computes."""

    threads: int | None = option(
        "--threads",
        default=None,
        least=1,
        help="Number of threads; by default the cores that the process may use.",
        group=Group.running,
    )
