"""What runs write and tell besides their results."""

from pathlib import Path
from typing import Any

import numpy as np

from ...clock import StageClock
from ...io import MESH_SUFFIXES
from ...report.record import Stage, WrittenFile
from ...typing import Attributes, Indices
from ..command_line import command_line
from ..commands import Run
from ..figure_run import FigureRun
from ..inputs import Inputs
from ..option_values import Figure
from ..options import values_of

# What a scan carries under names that the result needs: its parameters, and rows of yet another file.
OWN_NAMES = {"u": "scan_u", "v": "scan_v", "point_index": "scan_point_index"}


def carried(inputs: Inputs, rows: Indices) -> Attributes:
    """Take along what the scan carries per point, and each vertex's row where not every row is a vertex."""
    attributes = {OWN_NAMES.get(name, name): values[rows] for name, values in inputs.scan.attributes.items()}
    if len(rows) < len(inputs.scan.points):
        attributes["point_index"] = rows.astype(np.int32)
    return attributes


def options_facts(run: Run) -> dict[str, Any]:
    """Return the options of a run as plain data."""
    return {
        name: value if isinstance(value, int | float | None) else str(value) for name, value in values_of(run).items()
    }


def stages_of(clock: StageClock) -> tuple[Stage, ...]:
    """Return the stages that a clock has timed."""
    return tuple(Stage(name, seconds) for name, seconds in clock.seconds.items())


def untold(**paths: Path | None) -> list[WrittenFile]:
    """List the files that were asked for besides, by their options; the text of a run has no line on them."""
    return [WrittenFile(path, role, is_told=False) for role, path in paths.items() if path is not None]


def page_words(run: Run, scan: Path, out: Path) -> dict[str, Any]:
    """Return what a page says of a run besides its result: as `compose` takes it."""
    return {"title": page_title(scan, out), "command": command_line(run), "figure": figure_line(out, scan)}


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
    'pointchart figure deviation surface.json -o surface.pdf --points scan.ply'
    >>> figure_line(Path("surface.step"), Path("scan.ply"))
    """
    suffix, picture = out.suffix.lower(), out.with_suffix(".pdf")
    if suffix == ".json":
        return command_line(FigureRun(kind=Figure.deviation, source=out, points=scan, out=picture))
    if suffix in MESH_SUFFIXES:
        return command_line(FigureRun(kind=Figure.mesh, source=out, out=picture))
    return None
