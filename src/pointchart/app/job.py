"""A command line of pointchart that runs beside the page: its stages are told, and it ends at a word."""

import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from threading import Lock

from ..clock import STAGES
from ..errors import PointchartError, SolveError

PROGRAM = sys.executable, "-P", "-m", "pointchart"
PATIENCE = 1.0  # seconds that a process has to end by itself


class Cancelled(Exception):
    """The user has ended a job; no error."""


class Job:
    """A run of pointchart in a process of its own, so that it can be ended at any time.

    Parameters
    ----------
    words : sequence of str
        What stands behind `pointchart` on the command line.
    program : sequence of str
        What stands for `pointchart`.

    Examples
    --------
    >>> Job(["mesh", "missing.ply", "-o", "mesh.ply"]).run(print)
    Traceback (most recent call last):
        ...
    pointchart.errors.PointchartError: missing.ply: ...
    """

    def __init__(self, words: Sequence[str], *, program: Sequence[str] = PROGRAM) -> None:
        self._words = [*program, *words]
        self._process: subprocess.Popen[str] | None = None
        self._is_cancelled = self._is_over = False
        self._one = Lock()

    def run(self, tell: Callable[[str, int], object]) -> list[str]:
        """Run to the end.

        Parameters
        ----------
        tell : callable
            Called with each stage as it begins and the usual share of the time, in percent, that is over.

        Returns
        -------
        The lines that the command says.

        Raises
        ------
        PointchartError
            With the sentence of the command, if it fails.
        Cancelled
        """
        with subprocess.Popen(
            self._words,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            env=os.environ | {STAGES: "1"},
            encoding="utf-8",
            errors="replace",
        ) as process:
            self._process = process
            if self._is_cancelled:
                self.cancel()
            lines = []
            for line in map(str.rstrip, process.stderr or ()):
                word, _, rest = line.partition(" ")
                name, _, share = rest.partition(" ")
                if word == "stage" and share.isdigit():
                    tell(name, int(share))
                else:
                    lines.append(line)
        with self._one:
            self._is_over = True
        if self._is_cancelled:
            raise Cancelled
        if process.returncode:
            raise _failure(process.returncode, lines)
        return lines

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


def _failure(status: int, lines: list[str]) -> PointchartError:
    last = lines[-1] if lines else ""
    for start in ("pointchart: ", "Error: Invalid value: ", "Error: "):
        if last.startswith(start):
            return PointchartError(last.removeprefix(start))
    return SolveError(
        f"the run ended with status {status} and no word of why, as when memory gives out; thin the scan, or run the "
        "command line below in a terminal"
    )
