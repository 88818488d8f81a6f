"""Word of the stages on stderr while a run goes on."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from subprocess import DEVNULL

from .._parallel import n_threads
from ..clock import StageClock

# Usual share of the whole time that is over when a stage begins; each loop that is tried begins them again.
OVER_BY = {
    "prepare": 0,
    "neighbours": 3,
    "boundary": 30,
    "assemble": 45,
    "map": 46,
    "triangulate": 50,
    "recover": 51,
    "swap": 52,
    "relocate": 58,
    "parameters": 65,
    "certify": 92,
    "fit": 95,
}


@contextmanager
def staged(quiet: bool) -> Iterator[StageClock]:
    """Give a clock that shows stages as they begin: a bar with an estimate on a terminal, nothing if quiet or piped."""
    with _first_run(quiet), _shown(quiet) as clock:
        yield clock


@contextmanager
def _shown(quiet: bool) -> Iterator[StageClock]:
    if quiet or not sys.stderr.isatty():
        yield StageClock()
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


@contextmanager
def _first_run(quiet: bool) -> Iterator[None]:
    """On the first run on a machine say why it waits, and compile the kernels of late stages in another process."""
    if not _has_to_compile():
        yield
        return
    if not quiet:
        print("pointchart: first run on this machine: compiling its kernels, once, some 20 seconds", file=sys.stderr)
    command = [sys.executable, "-m", "pointchart._ahead"]
    ahead = subprocess.Popen(command, stdin=DEVNULL, stdout=DEVNULL, stderr=DEVNULL) if n_threads() > 1 else None
    try:
        yield
    finally:
        if ahead is not None:
            ahead.terminate()
            ahead.wait()


def _has_to_compile() -> bool:
    """Tell whether one of the kernels is not kept yet: they are compiled once on a machine."""
    from .._kernels.stars import delaunay_stars

    stats = getattr(delaunay_stars, "stats", None)  # none where compiling is turned off
    kept = f"stars.delaunay_stars-{delaunay_stars.__code__.co_firstlineno}.*.nbi"
    return stats is not None and not any(Path(stats.cache_path).glob(kept))
