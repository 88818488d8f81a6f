"""``pointchart figure``: figures for papers, of a scan, a mesh or a surface."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from . import options as given
from .words import Axis, Figure

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..io import Scan

OF_SURFACES, IN_SPACE, ON_MESHES = (
    (Figure.deviation, Figure.zebra),
    (Figure.cloud, Figure.mesh, Figure.deviation, Figure.zebra),
    (Figure.mesh, Figure.plane),
)
COLORED = (Figure.cloud, *ON_MESHES)


def figure(
    kind: Annotated[Figure, typer.Argument(metavar="KIND", help="One of cloud, plane, mesh, deviation, zebra.")],
    source: Annotated[
        Path,
        typer.Argument(
            metavar="INPUT",
            readable=False,
            help="Of cloud a scan, of plane and mesh what mesh wrote, of deviation and zebra the JSON that fit wrote.",
        ),
    ],
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="FIGURE", help="Figure to write: png, or svg and pdf with lines.")
    ],
    points: Annotated[
        Path | None, typer.Option("--points", metavar="SCAN", readable=False, help="Of deviation: the scan.")
    ] = None,
    limit: Annotated[
        float | None,
        typer.Option("--limit", help="Of deviation: where its colours end; by default 99 % of the points are within."),
    ] = None,
    color: Annotated[
        str | None,
        typer.Option(
            "--color", metavar="NAME", help="Show stretch, or what the file has for each point, such as intensity."
        ),
    ] = None,
    edges: Annotated[
        bool | None,
        typer.Option("--edges/--no-edges", help="Draw the edges of a mesh; by default up to 20,000 triangles."),
    ] = None,
    view: Annotated[
        str | None,
        typer.Option(
            "--view",
            metavar="TURN,TILT",
            help="Degrees to walk around the scan and look down on it; by default onto its mean plane or broad side.",
        ),
    ] = None,
    up: Annotated[
        Axis | None,
        typer.Option(
            "--up", help="Axis of the file that is upwards; by default that of a mesh's opening, z, or y seen along z."
        ),
    ] = None,
    width: Annotated[
        float, typer.Option("--width", min=20.0, max=1000.0, help="In mm: 85 is a column, 170 a page.")
    ] = 85.0,
    dpi: Annotated[
        float, typer.Option("--dpi", min=50.0, max=2400.0, help="Pixels an inch of png, and of images in svg and pdf.")
    ] = 300.0,
    transparent: Annotated[bool, typer.Option("--transparent", help="Leave out the white ground.")] = False,
    quiet: given.QuietOption = False,
) -> None:
    """Draw a figure for a paper: a cloud, a parameter plane, a mesh, a deviation map or lines of light (zebra)."""
    from ..io import check_output
    from ..look.figures import Sheet
    from ..look.paint import PICTURE_SUFFIXES

    _check_options(
        kind,
        {
            "--points": (points is not None, (Figure.deviation,)),
            "--limit": (limit is not None, (Figure.deviation,)),
            "--color": (color is not None, COLORED),
            "--edges": (edges is not None, ON_MESHES),
            "--view": (view is not None, IN_SPACE),
            "--up": (up is not None, IN_SPACE),
        },
    )
    if kind is Figure.plane and edges is False and color is None:
        raise typer.BadParameter("--no-edges leaves nothing of a plane to see; give --color, too, such as stretch")
    if kind is Figure.deviation and points is None:
        raise typer.BadParameter("deviation needs --points SCAN, the scan that the surface was fitted to")
    look: dict[str, Any] = {} if kind is Figure.plane else {"view": _angles(view), "up": up}
    check_output(out, suffixes=PICTURE_SUFFIXES, inputs=[source] if points is None else [source, points])
    look["sheet"] = Sheet(width, dpi, transparent)
    if kind in OF_SURFACES:
        _draw_surface(out, source, points, limit, look)
    else:
        _draw_scan(kind, out, source, color, look if kind is Figure.cloud else look | {"edges": edges})
    if not quiet:
        print(out, file=sys.stderr)


def _check_options(kind: Figure, given_for: dict[str, tuple[bool, tuple[Figure, ...]]]) -> None:
    for name, (is_given, kinds) in given_for.items():
        if is_given and kind not in kinds:
            raise typer.BadParameter(f"{name} is for {', '.join(kinds)}, not for {kind}")


def _angles(text: str | None) -> tuple[float, float] | None:
    try:
        turn, tilt = (0.0, 0.0) if text is None else (float(word) for word in text.split(","))
        if not (abs(turn) <= 360.0 and abs(tilt) <= 90.0):
            raise ValueError
    except ValueError:
        raise typer.BadParameter(
            f"--view is '{text}'; two angles in degrees are needed, such as 30,20, the second from -90 to 90"
        ) from None
    return None if text is None else (turn, tilt)


def _draw_surface(out: Path, source: Path, points: Path | None, limit: float | None, look: dict[str, Any]) -> None:
    from ..cad import read_surface_json
    from ..io import read_scan
    from ..look.figures import draw_deviation_map, draw_zebra

    surface, loops, unit = read_surface_json(source)
    if points is None:
        draw_zebra(out, surface, loops, **look)
    else:
        draw_deviation_map(out, surface, loops, read_scan(points).points, limit=limit, unit=unit, **look)


def _draw_scan(kind: Figure, out: Path, source: Path, color: str | None, look: dict[str, Any]) -> None:
    from ..errors import InputError
    from ..io import read_scan
    from ..look.figures import draw_cloud, draw_mesh, draw_plane
    from .inputs import uv_of

    read = read_scan(source)
    if kind in ON_MESHES and len(read.triangles) == 0:
        raise InputError(
            f"{source}: the file has {len(read.points)} points and no triangles; mesh it, or draw its cloud"
        )
    if color is not None:
        look = look | {"values": _values(source, read, color), "label": color}
    if kind is Figure.cloud:
        draw_cloud(out, read.points, **look)
    elif kind is Figure.mesh:
        draw_mesh(out, read.points, read.triangles, **look)
    elif (uv := uv_of(read)) is None:
        raise InputError(f"{source}: its {len(read.points)} points have no u and v; give a mesh that mesh wrote as PLY")
    else:
        draw_plane(out, uv, read.triangles, **look)


def _values(source: Path, read: Scan, name: str) -> NDArray[Any]:
    """Return what a file has for each point by a name; stretch is measured where it is not in the file."""
    from ..errors import InputError
    from ..mesh.distortion import vertex_stretches
    from .inputs import uv_of

    if name in read.attributes:
        return read.attributes[name]
    uv = uv_of(read)
    if name == "stretch" and uv is not None and len(read.triangles):
        return vertex_stretches(read.points, read.triangles, uv)
    known = ", ".join(read.attributes) or "nothing"
    raise InputError(
        f"{source}: there is no '{name}' for its {len(read.points)} points, only {known}; name one of these"
    )
