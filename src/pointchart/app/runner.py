"""One run at a time, its progress at the head of the page, and a button that cancels it."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Lock
from typing import Any

import viser

from ..errors import InputError, PointchartError
from ..report.record import RunReport
from ..runs.commands import Run
from ..runs.process import Cancelled, RunProcess
from ..runs.remedies import sentence

ENDED = "**ended**; start pointchart view again"  # stays on a page whose server has gone


class Runner:
    """What executes the runs of a page, one after the other.

    Parameters
    ----------
    gui : viser.GuiApi
        The status, a progress bar and a button to cancel are added to it, and are seen while a run goes on.
    """

    def __init__(self, gui: viser.GuiApi) -> None:
        self._process: RunProcess | None = None
        self._one, self._is_ended = Lock(), False
        self._status = gui.add_markdown("", visible=False)
        self._bar: Any = gui.add_progress_bar(0.0, visible=False, animated=True)
        self._stop = gui.add_button("Cancel", color="red", visible=False, hint="Ends the step at once.")
        self._stop.on_click(lambda _: self.cancel())

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Let nothing else run during the body.

        Raises
        ------
        InputError
            If something does.
        """
        if not self._one.acquire(blocking=False):
            raise InputError("another step is running; wait for its end, or cancel it")
        try:
            yield
        finally:
            self._one.release()

    def execute(self, run: Run, folder: Path) -> RunReport:
        """Execute a run in a folder; errors are those of `RunProcess`, in the words of the run."""
        process = self._process = RunProcess(run, folder=folder)
        try:
            if self._is_ended:
                raise Cancelled
            self._bar.value = 0.0
            self._tell(run.command, "starting", 0)
            self._show_progress(True)
            return process.execute(lambda stage, share: self._tell(run.command, stage, share))
        except PointchartError as failure:
            raise PointchartError(sentence(failure, run)) from None
        finally:
            self._show_progress(False)
            self._process = None

    def cancel(self) -> None:
        """End the run that goes on, if one does."""
        process = self._process
        if process is not None:
            process.cancel()

    def end(self) -> None:
        """End the run that goes on, let none begin any more, and say so."""
        self._is_ended = True
        self.cancel()
        self._status.content = ENDED
        self._show_progress(False)

    def _tell(self, command: str, stage: str, share: int) -> None:
        self._status.content = f"**{command}**: {stage}"
        self._bar.value = max(float(share), self._bar.value)

    def _show_progress(self, is_shown: bool) -> None:
        self._bar.visible = self._stop.visible = is_shown
        self._status.visible = is_shown or self._is_ended
