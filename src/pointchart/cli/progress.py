"""Word of the stages on stderr while a run goes on."""

import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from ..clock import StageClock
from ..runs.usual_shares import share_over


@contextmanager
def staged(quiet: bool) -> Iterator[StageClock]:
    """Give a clock that shows stages as they begin: a bar with an estimate on a terminal, nothing if quiet or piped."""
    with ExitStack() as shown:
        yield StageClock(None if quiet else _Word(shown).tell)


class _Word:
    """Tells nothing before the first stage begins: what is wrong with the options is said before that."""

    def __init__(self, shown: ExitStack) -> None:
        self._shown, self._has_begun = shown, False
        self._bar: Any = None

    def tell(self, stage: str) -> None:
        """Show that a stage begins."""
        if not self._has_begun:
            self._has_begun = True
            _warn_of_first_run()
            self._bar = _bar(self._shown) if sys.stderr.isatty() else None
        if self._bar is not None:
            task = self._bar.tasks[0]
            self._bar.update(task.id, description=stage, completed=max(share_over(stage), task.completed))


def _bar(shown: ExitStack) -> Any:
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
    bar = shown.enter_context(Progress(*columns, console=Console(stderr=True), transient=True))
    bar.add_task("reading", total=100)
    return bar


def _warn_of_first_run() -> None:
    """Say why the first run on a machine waits: the kernels are compiled once and kept."""
    from .._kernels.points.inversion import delaunay_stars

    stats = getattr(delaunay_stars, "stats", None)  # none where compiling is turned off
    kept = (
        f"{delaunay_stars.__module__.rpartition('.')[2]}.delaunay_stars-{delaunay_stars.__code__.co_firstlineno}.*.nbi"
    )
    if stats is not None and not any(Path(stats.cache_path).glob(kept)):
        print("pointchart: first run on this machine: compiling its kernels, once, some 35 seconds", file=sys.stderr)
