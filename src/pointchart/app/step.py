"""A step of the pipeline on the page: its controls, its command line, a button to run it, what it came to."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import viser

from ..errors import InputError
from ..report.record import RunReport
from ..runs.commands import Run
from .controls import Controls
from .html import OTHERWISE, command_html, dimmed_html, outdated_html, refused_html, report_html
from .session import Made, Session
from .step_files import StepFiles


class Step:
    """A run with its controls, in the tab that is open.

    Parameters
    ----------
    session : Session
    record : type
        Of the run.
    title : str
        Of its button.
    labels : sequence of (name, label)
        The options that have controls.
    files : StepFiles
    take : callable
        Called when a run has ended well.
    also : Controls, optional
        Of another step, whose values are given as well.
    """

    def __init__(
        self,
        session: Session,
        record: type[Run],
        title: str,
        labels: Sequence[tuple[str, str]],
        *,
        files: StepFiles,
        take: Callable[[], object],
        also: Controls | None = None,
    ) -> None:
        self._session, self._record, self._files, self._take, self._also = session, record, files, take, also
        self._made_by: Made | None = None
        self._report: RunReport | None = None
        self._refused: tuple[Made | None, str] | None = None  # what was asked for, and why there is none
        gui = session.server.gui
        self.controls = Controls(gui, record, labels)
        button = gui.add_button(title, color="blue", icon=viser.Icon.PLAYER_PLAY)
        button.on_click(lambda _: self.run())
        self._line = gui.add_html("")
        self._said = gui.add_html("")
        self.controls.on_change(self.refresh)
        session.on_loop.append(self.refresh)

    @property
    def values(self) -> dict[str, Any]:
        """The options given, by their names.

        Raises
        ------
        InputError
            If a word is no value of its option.
        """
        return (self._also.values if self._also else {}) | self.controls.values

    def exported_as(self, suffix: Any) -> None:
        """Name a file of the format chosen on the command line."""

        def rename() -> None:
            self._files = replace(self._files, out=str(Path(self._files.out).with_suffix(suffix.value)))
            self.refresh()

        suffix.value = Path(self._files.out).suffix
        suffix.on_update(lambda _: rename())

    def refresh(self) -> None:
        """Write the command line again, and mark what was said if other options or another loop stand now."""
        with self._session.edits:
            try:
                self._line.content = command_html(self._session.line(self._record, self._files.out, self.values))
            except InputError as reason:
                self._line.content = refused_html(str(reason))
            self._show_said()

    def run(self) -> None:
        """Execute the run, and show what it came to or why it stopped; a result stays where there is no other."""
        session, asked = self._session, self._now()
        with (
            session.reporting(self._record.command, lambda sentence: self._refuse(asked, sentence)),
            session.running(self._record, self._files, self.values, keep=self._keep) as report,
        ):
            with session.edits:
                self._report = report
            self._take()
            self.refresh()

    def _keep(self, made_by: Made) -> None:
        self._made_by, self._report, self._refused = made_by, None, None

    def _now(self) -> Made | None:
        """Return what a run would be made by now, None while a word is no value of its option."""
        try:
            return self._session.now(self._record, self.values)
        except InputError:
            return None

    def made(self, what: str, remedy: str) -> Path:
        """Return the file of the last run.

        Raises
        ------
        InputError
            If there is none, or other options or another loop stand now than those that made it.
        """
        if self._made_by is None:
            raise InputError(f"there is no {what} yet; {remedy} first")
        if self._made_by != self._now():
            raise InputError(f"this {what} {OTHERWISE}; {remedy} again first")
        return self._session.folder / self._files.works_on

    def _refuse(self, asked: Made | None, sentence: str) -> None:
        with self._session.edits:
            self._refused = asked, sentence
            self._show_said()

    def _show_said(self) -> None:
        now, content = self._now(), ""
        if self._refused is not None:
            asked, sentence = self._refused
            content = refused_html(sentence) if asked == now else dimmed_html(refused_html(sentence))
        if self._made_by is not None:
            said = "" if self._report is None else report_html(self._report, self._files.out)
            content += said if self._made_by == now else outdated_html(said)
        self._said.content = content


def add_export(
    session: Session, title: str, stem: str, suffixes: Sequence[str], write: Callable[[Path], object]
) -> Any:
    """Add a choice of formats and a button that sends the file; return the choice.

    `write` is called with the path of a file in the folder between steps, and raises where nothing has been run yet.
    """
    gui = session.server.gui
    suffix = gui.add_dropdown("Format", tuple(suffixes))
    button = gui.add_button(title, icon=viser.Icon.DOWNLOAD)

    @button.on_click
    def _(event: viser.GuiEvent[Any]) -> None:
        with session.reporting(title):
            session.send(event, f"{stem}{suffix.value}", write)

    return suffix
