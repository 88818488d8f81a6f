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


def page_title(scan: Path, out: Path) -> str:
    """Return a heading that tells pages of several runs apart.

    >>> page_title(Path("/data/foot/points.ply"), Path("foot.step"))
    'foot/points.ply to foot.step'
    """
    return f"{Path(scan.absolute().parent.name) / scan.name} to {out.name}"


def command_line() -> str:
    """Return the command that runs, as it can be given again."""
    return shlex.join(["pointchart", *sys.argv[1:]])
