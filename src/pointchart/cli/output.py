"""What the commands write besides their results."""

from typing import Any

import numpy as np
import typer

from ..io import Scan
from ..typing import Attributes, Indices


def carried(scan: Scan, rows: Indices) -> Attributes:
    """Take along what the scan carries per point, and each vertex's row where repeated points were merged."""
    attributes = {name: values[rows] for name, values in scan.attributes.items()}
    if len(rows) < len(scan.points):
        attributes["point_index"] = rows.astype(np.int32)
    return attributes


def given_options(context: typer.Context) -> dict[str, Any]:
    """Return the options of a command as plain data."""
    return {
        name: value if isinstance(value, int | float | None) else str(value) for name, value in context.params.items()
    }
