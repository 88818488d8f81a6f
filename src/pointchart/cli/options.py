"""Arguments and options that several commands share."""

from pathlib import Path
from typing import Annotated

import typer

from ..runs.option_values import Component, Domain, Holes, Neighbors, Spacing, Weighting

ScanArgument = Annotated[
    Path,
    typer.Argument(
        metavar="SCAN",
        readable=False,
        help="Point cloud: ply, obj, off, stl, glb, xyz, txt, csv, pts, npy, npz, las, laz, e57.",
    ),
]
BoundaryOption = Annotated[
    Path | None,
    typer.Option(
        "--boundary",
        metavar="LOOP.txt",
        readable=False,
        help="Boundary points in order, one 0-based index a line; found, if not given.",
    ),
]
OuterOption = Annotated[
    str | None,
    typer.Option("--outer", metavar="X,Y,Z", help="Of the loops found, the boundary is the one nearest to this place."),
]
HolesOption = Annotated[
    Holes | None,
    typer.Option(
        "--holes",
        help="Bridge all gaps of the scan, or leave them open; by default they are bridged unless one may be the "
        "boundary.",
    ),
]
ComponentOption = Annotated[
    Component | None,
    typer.Option("--component", help="Of a scan in several parts, take the largest; point_index names its rows."),
]
NeighborsOption = Annotated[
    Neighbors | None,
    typer.Option("--neighbors", help="Neighbourhoods of the paper's methods instead of linked Delaunay stars."),
]
KOption = Annotated[
    int | None, typer.Option("-k", min=1, help="Number of nearest points that neighbours are taken from.")
]
RadiusOption = Annotated[float | None, typer.Option("--radius", help="Radius of the ball, in the unit of the scan.")]
WeightsOption = Annotated[
    Weighting | None,
    typer.Option(
        "--weights",
        help="Convex weights of the paper's methods; by default mean-value, reciprocal for ball and nearest.",
    ),
]
DomainOption = Annotated[
    Domain, typer.Option("--domain", help="Convex domain of the parameters: unit circle or unit square.")
]
CornersOption = Annotated[
    str | None,
    typer.Option(
        "--corners",
        metavar="A,B,C,D",
        help="Four boundary points for the corners of the square, else the sharpest turns.",
    ),
]
SpacingOption = Annotated[Spacing, typer.Option("--spacing", help="Spacing of the parameters along the boundary.")]
ThreadsOption = Annotated[
    int | None,
    typer.Option("--threads", min=1, help="Number of threads; by default the cores that the process may use."),
]
ReportOption = Annotated[
    Path | None, typer.Option("--report", metavar="RUN.json", help="Write what was done and proved as JSON.")
]
HtmlOption = Annotated[
    Path | None,
    typer.Option(
        "--html", metavar="RUN.html", help="Write a page that opens offline: mesh and uv to turn and point at."
    ),
]
QuietOption = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but errors.")]
