"""A run in a process of its own: its stages are told, and it ends at a word."""

import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from threading import Lock
from typing import IO, Any

from ..errors import PointchartError, SolveError
from ..report.record import RunReport
from .commands import Run

PROGRAM = sys.executable, "-P", "-m", "pointchart.runs"  # -P: no module of the folder in which it runs is imported
PATIENCE = 1.0  # seconds that a process has to end by itself


class Cancelled(Exception):
    """The user has ended a run; no error."""


class RunProcess:
    """A run in a process of its own, so that it can be ended at any time.

    Parameters
    ----------
    run : Run
    folder : Path, optional
        Where it runs: what relative paths of the run, of inputs too, are relative to.
    program : sequence of str
        What takes the run from its stdin.

    Examples
    --------
    >>> from pointchart.runs.check_run import CheckRun
    >>> RunProcess(CheckRun(mesh=Path("missing.ply"))).execute(print)
    Traceback (most recent call last):
        ...
    pointchart.errors.FormatError: missing.ply: ...
    """

    def __init__(self, run: Run, *, folder: Path | None = None, program: Sequence[str] = PROGRAM) -> None:
        self._order, self._program = pickle.dumps((run, folder)), program
        self._process: subprocess.Popen[bytes] | None = None
        self._is_cancelled = self._is_over = False
        self._one = Lock()

    def execute(self, tell: Callable[[str, int], object]) -> RunReport:
        """Execute the run to its end.

        Parameters
        ----------
        tell : callable
            Called with each stage as it begins and the usual share of the time, in percent, that is over.

        Returns
        -------
        RunReport

        Raises
        ------
        PointchartError
            That of the run, if it fails.
        Cancelled
        """
        outcome: Any = None
        with subprocess.Popen(self._program, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            self._process = process
            if self._is_cancelled:
                self.cancel()
            for event in _events(process, self._order):
                if isinstance(event, tuple):
                    tell(*event)
                else:
                    outcome = event
        with self._one:
            self._is_over = True
        if self._is_cancelled:
            raise Cancelled
        return _checked(outcome, process.returncode)

    def cancel(self) -> None:
        """End the run within a second or so, unless it is over: then its result stands."""
        with self._one:
            if self._is_over:
                return
            self._is_cancelled = True
        if self._process is not None:
            self._process.terminate()
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(PATIENCE)
            self._process.kill()


def _events(process: subprocess.Popen[bytes], order: bytes) -> Iterator[Any]:
    """Hand the run over, and give what the process tells until it ends."""
    assert process.stdin is not None, "it is a pipe"
    assert process.stdout is not None, "it is a pipe"
    with suppress(BrokenPipeError), process.stdin:
        process.stdin.write(order)
    yield from _pickled(process.stdout)


def _pickled(stream: IO[bytes]) -> Iterator[Any]:
    # A process that is killed may end in the middle of an event.
    with suppress(EOFError, pickle.UnpicklingError):
        while True:
            yield pickle.load(stream)


def _checked(outcome: Any, status: int) -> RunReport:
    if isinstance(outcome, PointchartError):
        raise outcome
    if not isinstance(outcome, RunReport) or status:
        raise SolveError(
            f"the run ended with status {status} and no word of why, as when memory gives out; thin the scan, or run "
            "the command line below in a terminal"
        )
    if outcome.failure is not None:
        raise outcome.failure
    return outcome
