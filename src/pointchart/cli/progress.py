"""Word of the stages on stderr while a run goes on."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..clock import STAGES, StageClock

# Usual share of the whole time that is over when a stage begins; each loop that is tried begins them again.
OVER_BY = {
    "prepare": 0,
    "neighbours": 4,
    "boundary": 31,
    "assemble": 44,
    "map": 45,
    "triangulate": 47,
    "recover": 48,
    "swap": 49,
    "relocate": 52,
    "parameters": 55,
    "certify": 90,
    "fit": 95,
    "page": 95,
}


@contextmanager
def staged(quiet: bool) -> Iterator[StageClock]:
    """Give a clock that shows stages as they begin: a bar with an estimate on a terminal, nothing if quiet or piped.

    A program that runs pointchart and sets POINTCHART_STAGES reads `stage NAME PERCENT` lines instead of the bar.
    """
    if not quiet:
        _warn_of_first_run()
    if quiet or not sys.stderr.isatty():
        yield StageClock(_tell if STAGES in os.environ and not quiet else None)
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    columns = (
        SpinnerColumn(),
        TextColumn("{task.description:12}"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("left about"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("reading", total=100)

        def show(name: str) -> None:
            progress.update(task, description=name, completed=max(OVER_BY.get(name, 0), progress.tasks[task].completed))

        yield StageClock(show)


def _tell(name: str) -> None:
    print(f"stage {name} {OVER_BY.get(name, 0)}", file=sys.stderr, flush=True)


def _warn_of_first_run() -> None:
    """Say why the first run on a machine waits: the kernels are compiled once and kept."""
    from .._kernels.points.inversion import delaunay_stars

    stats = getattr(delaunay_stars, "stats", None)  # none where compiling is turned off
    kept = (
        f"{delaunay_stars.__module__.rpartition('.')[2]}.delaunay_stars-{delaunay_stars.__code__.co_firstlineno}.*.nbi"
    )
    if stats is not None and not any(Path(stats.cache_path).glob(kept)):
        print("pointchart: first run on this machine: compiling its kernels, once, some 35 seconds", file=sys.stderr)
