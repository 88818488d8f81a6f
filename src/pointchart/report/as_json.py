"""A report as a file of JSON."""

import json
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

from ..io import replacing
from .record import RunReport


def as_json(report: RunReport) -> dict[str, Any]:
    """Return the facts of a report, and its stages, as plain data.

    >>> from pointchart.report.record import Stage
    >>> as_json(RunReport("mesh", stages=(Stage("certify", 0.25),), facts={"solve": {"unknowns": 9}}))
    {'stages': [{'name': 'certify', 'seconds': 0.25}], 'solve': {'unknowns': 9}}
    """
    stages = [{"name": stage.name, "seconds": round(stage.seconds, 4)} for stage in report.stages]
    return {"stages": stages, **report.facts}


@contextmanager
def writing_json(path: Path | None, report: RunReport) -> Iterator[None]:
    """Write a report as JSON, if a path is given; the file is in its place when the block has ended well."""
    with nullcontext() if path is None else replacing(path) as temporary:
        if temporary is not None:
            temporary.write_text(json.dumps(as_json(report), indent=1, allow_nan=False) + "\n", encoding="utf-8")
        yield
