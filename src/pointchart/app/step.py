"""A step of the pipeline on the page: its controls, its command line, a button to run it, what it said."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import viser

from ..errors import InputError
from .controls import Controls
from .html import OTHERWISE, command_html, dimmed_html, outdated_html, refused_html, said_html, shortened
from .session import Made, Page


class Step:
    """A command with its controls, in the tab that is open.

    Parameters
    ----------
    page : Page
    command : str
        As `mesh`.
    title : str
        Of its button.
    labels : sequence of (flag, label)
        The options that have controls.
    works_on : str
        The file that a run writes into the folder between steps.
    out : str
        The file that the command line names.
    take : callable
        Called when a run has ended well.
    also : Controls, optional
        Of another step, whose words are given as well.
    beside : sequence of (flag, name)
        Files that the run writes as well, for the page to draw.
    """

    def __init__(
        self,
        page: Page,
        command: str,
        title: str,
        labels: Sequence[tuple[str, str]],
        *,
        works_on: str,
        out: str,
        take: Callable[[], object],
        also: Controls | None = None,
        beside: Sequence[tuple[str, str]] = (),
    ) -> None:
        self._page, self._command, self._works_on, self._out = page, command, works_on, out
        self._take, self._also, self._beside = take, also, beside
        self._made_by: Made | None = None
        self._told: list[str] = []
        self._refused: tuple[Made, str] | None = None  # what was asked for, and why there is none
        self.controls = Controls(page, command, labels)
        button = page.server.gui.add_button(title, color="blue", icon=viser.Icon.PLAYER_PLAY)
        button.on_click(lambda _: self.run())
        self._line = page.server.gui.add_html("")
        self._said = page.server.gui.add_html("")
        self.controls.on_change(self.refresh)
        page.on_loop.append(self.refresh)

    @property
    def words(self) -> list[str]:
        """The options given."""
        return [*(self._also.words if self._also else []), *self.controls.words]

    def exported_as(self, suffix: Any) -> None:
        """Name a file of the format chosen on the command line."""

        def rename() -> None:
            self._out = str(Path(self._out).with_suffix(suffix.value))
            self.refresh()

        suffix.value = Path(self._out).suffix
        suffix.on_update(lambda _: rename())

    def refresh(self) -> None:
        """Write the command line again, and mark what was said if other words or another loop stand now."""
        with self._page.edits:
            self._line.content = command_html(self._page.line(self._command, self._out, self.words))
            self._show_said()

    def run(self) -> None:
        """Run the command, and show what it said or why it stopped; a result before stays where there is no other."""
        words = self.words
        asked = self._page.now(self._command, words)
        with (
            self._page.reporting(self._command, lambda sentence: self._refuse(asked, sentence)),
            self._page.running(self._command, self._works_on, words, keep=self._keep, beside=self._beside) as lines,
        ):
            told = [line.replace(self._works_on, self._out) for line in lines if not line.startswith("pointchart: ")]
            with self._page.edits:
                self._told = shortened(told)
            self._take()
            self.refresh()

    def _keep(self, made_by: Made) -> None:
        self._made_by, self._told, self._refused = made_by, [], None

    def made(self, what: str, remedy: str) -> Path:
        """Return the file of the last run.

        Raises
        ------
        InputError
            If there is none, or other words or another loop stand now than those that made it.
        """
        if self._made_by is None:
            raise InputError(f"there is no {what} yet; {remedy} first")
        if self._made_by != self._page.now(self._command, self.words):
            raise InputError(f"this {what} {OTHERWISE}; {remedy} again first")
        return self._page.folder / self._works_on

    def _refuse(self, asked: Made, sentence: str) -> None:
        with self._page.edits:
            self._refused = asked, sentence.replace(self._works_on, self._out)
            self._show_said()

    def _show_said(self) -> None:
        now = self._page.now(self._command, self.words)
        content = ""
        if self._refused is not None:
            asked, sentence = self._refused
            content = refused_html(sentence) if asked == now else dimmed_html(refused_html(sentence))
        if self._made_by is not None:
            content += said_html(self._told) if self._made_by == now else outdated_html(self._told)
        self._said.content = content


def add_export(page: Page, title: str, stem: str, suffixes: Sequence[str], write: Callable[[Path], object]) -> Any:
    """Add a choice of formats and a button that sends the file; return the choice.

    `write` is called with the path of a file in the folder between steps, and raises where nothing has been run yet.
    """
    gui = page.server.gui
    suffix = gui.add_dropdown("Format", tuple(suffixes))
    button = gui.add_button(title, icon=viser.Icon.DOWNLOAD)

    @button.on_click
    def _(event: viser.GuiEvent[Any]) -> None:
        with page.reporting(title):
            page.send(event, f"{stem}{suffix.value}", write)

    return suffix
