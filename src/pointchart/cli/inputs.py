"""What the commands read, once it is known that their outputs can be written."""

from collections.abc import Sequence
from pathlib import Path

from ..io import Scan, check_output, read_loop, read_scan
from ..typing import Loop


def read_inputs(
    scan: Path, boundary: Path | None, *, out: Path, suffixes: Sequence[str], report: Path | None
) -> tuple[Scan, Loop | None]:
    """Check the output and the report, then read the scan and the boundary, if one is given."""
    inputs = [scan] if boundary is None else [scan, boundary]
    check_output(out, suffixes=suffixes, inputs=inputs)
    if report is not None:
        check_output(report, suffixes=(".json",), inputs=[*inputs, out])
    return read_scan(scan), None if boundary is None else read_loop(boundary)
