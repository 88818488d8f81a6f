"""The page: its scan, its loop, one job at a time, and what every step shares."""

import os
import secrets
import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from threading import Lock
from typing import Any

import viser

from ..errors import InputError, PointchartError
from ..io import Scan, write_loop
from ..typing import Loop
from ..weights import WeightScheme
from .around import Connect
from .command import Option, shell_line
from .drawing import Drawing
from .guard import address, start_server, stop_server
from .job import Cancelled, Job
from .picking import LoopByHand

BRAND = (38, 99, 140)
WIDTH = 440  # pixels of the panel
CLOUDS = "cloud", "boundary scores"  # what shows points that can be clicked

Options = Mapping[str, Sequence[Option]]
Rules = Callable[[str, str, str, str], tuple[Connect, WeightScheme]]


@dataclass(frozen=True, slots=True)
class Commands:
    """What the page knows of the command line.

    Attributes
    ----------
    options : mapping of str to sequence of Option
        The options of each command.
    rules : callable
        ``rules(neighbors, k, radius, weights)``, words all, gives the functions that they name.
    """

    options: Options
    rules: Rules

    def option(self, command: str, flag: str) -> Option | None:
        """Return an option of a command, None if it has no such option."""
        return next((option for option in self.options[command] if option.flag == flag), None)


class Page:
    """A page that is open, with one scan.

    Parameters
    ----------
    path : Path
        The file, as the user named it.
    scan : Scan
        What it holds.
    commands : Commands
    loop : (b,) int array, optional
        The user's own boundary to begin with.
    """

    def __init__(self, path: Path, scan: Scan, commands: Commands, loop: Loop | None = None) -> None:
        self.path, self.scan, self.commands = path, scan, commands
        self.hand = LoopByHand(len(scan.points), loop)
        self._seen = self._stamp()
        self._token = secrets.token_urlsafe(32)
        self.server = start_server(self._token)
        self.folder = Path(tempfile.mkdtemp(prefix="pointchart-"))
        self._job: Job | None = None
        self._one, self._edits = Lock(), Lock()
        self.where: Callable[[], list[str]] = list  # words that say what the boundary is, of a step that is built later
        self.on_loop: list[Callable[[], None]] = []
        self.drawing = Drawing(self.server, scan.points)
        self._build_head()

    @property
    def address(self) -> str:
        """What opens the page, token included."""
        return address(self.server, self._token)

    def close(self) -> None:
        """End the job that runs, the server, and remove the files between steps."""
        self.cancel()
        stop_server(self.server)
        shutil.rmtree(self.folder, ignore_errors=True)

    def _build_head(self) -> None:
        gui = self.server.gui
        self.darken(False)
        gui.main_panel.dock_right()
        gui.main_panel.set_width(WIDTH)
        gui.set_panel_label(f"pointchart · {self.path.name}")
        self._status = gui.add_markdown("", visible=False)
        self._bar: Any = gui.add_progress_bar(0.0, visible=False, animated=True)
        self._stop = gui.add_button("Cancel", color="red", visible=False, hint="Ends the step at once.")
        self._stop.on_click(lambda _: self.cancel())
        self.shown: Any = gui.add_dropdown("Show", CLOUDS[:1], hint="What is drawn; each step that has run adds to it.")
        self._groups: dict[str, Callable[[], None]] = {CLOUDS[0]: lambda: self.drawing.show("cloud")}
        self.shown.on_update(lambda _: self._groups[self.shown.value]())

    @property
    def shows_cloud(self) -> bool:
        """Whether the cloud is shown, so that a click can mean a point of it."""
        return self.shown.value in CLOUDS

    def add_view(self, name: str, show: Callable[[], None], *, is_next: bool = True) -> None:
        """Add something to show, and show it."""
        self._groups[name] = show
        self.shown.options = tuple(self._groups)
        if is_next:
            self.look_at(name)

    def look_at(self, name: str) -> None:
        """Show one of the things that there are."""
        self.shown.value = name
        self._groups[name]()

    def loop_changed(self) -> None:
        """Draw the loop again, and write the command lines again."""
        for tell in self.on_loop:
            tell()

    def words(self, command: str, out: str, own: Sequence[str], *, loop_file: str = "loop.txt") -> list[str]:
        """Return the words of a command on this scan, which name the boundary as it is now."""
        words = [command, str(self.path), "-o", out]
        takes_loop = self.commands.option(command, "--boundary") is not None
        if takes_loop and self.hand.is_own:
            words += ["--boundary", loop_file]
        given = self.where()
        for flag, word in zip(given[::2], given[1::2], strict=True):
            is_moot = flag == "--outer" and takes_loop and self.hand.is_own
            if self.commands.option(command, flag) is not None and not is_moot:
                words += [flag, word]
        return words + list(own)

    def line(self, command: str, out: str, own: Sequence[str]) -> str:
        """Return the command line that a step amounts to."""
        return shell_line(["pointchart", *self.words(command, out, own)])

    def run(self, command: str, out: str, own: Sequence[str]) -> list[str]:
        """Run a command on this scan into the folder between steps; return what it said.

        Raises
        ------
        PointchartError
            With the sentence of the command line.
        Cancelled
        """
        with self._alone(command):
            self._check_unchanged()
            loop_file = self.folder / "loop.txt"
            if self.hand.is_own:
                write_loop(loop_file, self.hand.loop)
            words = self.words(command, str(self.folder / out), own, loop_file=str(loop_file))
            self._job = Job(words)
            try:
                return [
                    self.plain(line) for line in self._job.run(lambda name, share: self._tell(command, name, share))
                ]
            except PointchartError as failure:
                raise PointchartError(self.plain(str(failure))) from None
            finally:
                self._job = None

    def plain(self, text: str) -> str:
        """Leave the folder between steps out of a text: its files have the names that the user gives them."""
        return text.replace(f"{self.folder}{os.sep}", "")

    def cancel(self) -> None:
        """End the job that runs, if one does."""
        if self._job is not None:
            self._job.cancel()

    def send(self, event: viser.GuiEvent[Any], name: str, write: Callable[[Path], object]) -> None:
        """Write a file in the folder between steps, and have the browser that asks for it download it."""
        path, client = self.folder / name, event.client
        if client is None:
            return
        waiting = client.add_notification(name, "being written", loading=True, with_close_button=False)
        try:
            write(path)
            client.send_file_download(name, path.read_bytes(), save_immediately=True)
        finally:
            waiting.remove()

    def notify(self, title: str, sentence: str, *, color: Any = "red") -> None:
        """Show a sentence in the corner of the page."""
        for client in self.server.get_clients().values():
            client.add_notification(title, sentence, color=color, auto_close_seconds=12.0)

    @contextmanager
    def reporting(self, title: str, tell: Callable[[str], object] | None = None) -> Iterator[None]:
        """Show errors of the body as the sentences that they are: where `tell` puts them, or in the corner."""
        try:
            yield
        except (Cancelled, PointchartError) as reason:
            sentence = "cancelled; nothing was changed" if isinstance(reason, Cancelled) else self.plain(str(reason))
            if tell is None:
                self.notify(title, sentence)
            else:
                tell(sentence)

    @contextmanager
    def editing(self) -> Iterator[None]:
        """Let clicks change the page one after the other."""
        with self._edits, self.reporting("click"):
            yield

    def darken(self, is_dark: bool) -> None:
        """Make the page dark, or light again."""
        self.server.gui.configure_theme(
            show_logo=False, show_share_button=False, brand_color=BRAND, control_width="large", dark_mode=is_dark
        )

    @contextmanager
    def _alone(self, command: str) -> Iterator[None]:
        if not self._one.acquire(blocking=False):
            raise InputError("another step is running; wait for its end, or cancel it")
        try:
            self._tell(command, "starting", 0)
            self._show_progress(True)
            yield
        finally:
            self._show_progress(False)
            self._one.release()

    def _tell(self, command: str, stage: str, share: int) -> None:
        self._status.content = f"**{command}**: {stage}"
        self._bar.value = float(share) if stage == "starting" else max(float(share), self._bar.value)

    def _show_progress(self, is_shown: bool) -> None:
        self._status.visible = self._bar.visible = self._stop.visible = is_shown

    def _stamp(self) -> tuple[int, int]:
        seen = self.path.stat()
        return seen.st_mtime_ns, seen.st_size

    def _check_unchanged(self) -> None:
        try:
            is_same = self._stamp() == self._seen
        except OSError:
            is_same = False
        if not is_same:
            raise InputError(f"{self.path} has changed since this page was opened; start pointchart view again")
