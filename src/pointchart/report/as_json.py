"""The facts of a run as a file of JSON."""

import json
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

from ..io import replacing


def write_json(path: Path, facts: dict[str, Any]) -> None:
    """Write facts as JSON."""
    with writing_json(path, facts):
        pass


@contextmanager
def writing_json(path: Path | None, facts: dict[str, Any]) -> Iterator[None]:
    """Write facts as JSON, if a path is given; the file is in its place when the block has ended well."""
    with nullcontext() if path is None else replacing(path) as temporary:
        if temporary is not None:
            temporary.write_text(json.dumps(facts, indent=1, allow_nan=False) + "\n", encoding="utf-8")
        yield
