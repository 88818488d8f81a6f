"""What the commands write besides their results."""

import shlex
import sys
from pathlib import Path
from typing import Any

import numpy as np
import typer

from ..typing import Attributes, Indices
from .inputs import Inputs


def carried(inputs: Inputs, rows: Indices) -> Attributes:
    """Take along what the scan carries per point, and each vertex's row where not every row is a vertex."""
    # A point_index that the scan carries names rows of yet another file.
    attributes = {name: values[rows] for name, values in inputs.scan.attributes.items() if name != "point_index"}
    if len(rows) < len(inputs.scan.points):
        attributes["point_index"] = rows.astype(np.int32)
    return attributes


def given_options(context: typer.Context) -> dict[str, Any]:
    """Return the options of a command as plain data."""
    return {
        name: value if isinstance(value, int | float | None) else str(value) for name, value in context.params.items()
    }


def page_words(scan: Path, out: Path) -> dict[str, Any]:
    """Return what a page says of the run besides its result: as `lay_out` takes it."""
    return {"title": page_title(scan, out), "command": command_line(), "figure": figure_line(out, scan)}


def page_title(scan: Path, out: Path) -> str:
    """Return a heading that tells pages of several runs apart.

    >>> page_title(Path("/data/foot/points.ply"), Path("foot.step"))
    'foot/points.ply to foot.step'
    """
    return f"{Path(scan.absolute().parent.name) / scan.name} to {out.name}"


def figure_line(out: Path, scan: Path) -> str | None:
    """Return the command that draws a figure of what was written; None of what has none.

    >>> figure_line(Path("mesh.ply"), Path("scan.ply"))
    'pointchart figure mesh mesh.ply -o mesh.pdf'
    >>> figure_line(Path("surface.json"), Path("scan.ply"))
    'pointchart figure deviation surface.json --points scan.ply -o surface.pdf'
    >>> figure_line(Path("surface.step"), Path("scan.ply"))
    """
    from ..io import MESH_SUFFIXES

    suffix, picture = out.suffix.lower(), str(out.with_suffix(".pdf"))
    if suffix == ".json":
        return shlex.join(["pointchart", "figure", "deviation", str(out), "--points", str(scan), "-o", picture])
    if suffix in MESH_SUFFIXES:
        return shlex.join(["pointchart", "figure", "mesh", str(out), "-o", picture])
    return None


def command_line() -> str:
    """Return the command that runs, as it can be given again."""
    return shlex.join(["pointchart", *sys.argv[1:]])
