"""The page: its scan, its loop, one job at a time, and what every step shares."""

import logging
import os
import secrets
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from threading import RLock
from typing import Any

import viser

from ..errors import InputError, PointchartError
from ..io import Scan, write_loop
from ..typing import Loop
from .command import Commands, shell_line
from .drawing import Drawing
from .guard import address, start_server, stop_server
from .job import Cancelled
from .loop_by_hand import LoopByHand
from .runner import Runner

LOG = logging.getLogger(__name__)
BRAND = (38, 99, 140)
WIDTH = 460  # pixels of the panel
CLOUDS = "cloud", "boundary scores"  # what shows points that can be clicked
LOOP_FILE = "loop.txt"
OUT = 3  # where the words of a run name its file
RUN = "run"  # folder of the files of a run, which are taken out of it when it has ended well
LAST = 0.2  # seconds in which the last words reach the browser

Told = Callable[[Callable[[], None]], object]
Made = tuple[list[str], bytes]  # the words of a run, and the user's own loop if it takes one


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
    tell_close : callable, optional
        Called with `close` as soon as there is something to close.

    Attributes
    ----------
    runner : Runner
        Runs its commands.
    edits : RLock
        Held by whatever changes the loop, or reads it to run a command.
    """

    def __init__(
        self, path: Path, scan: Scan, commands: Commands, loop: Loop | None = None, tell_close: Told | None = None
    ) -> None:
        self.path, self.scan, self.commands = path, scan, commands
        self.hand = LoopByHand(len(scan.points), loop)
        self._seen = _stamp(path)
        self._token, self._entry = secrets.token_urlsafe(32), secrets.token_urlsafe(32)
        self.edits = RLock()
        self.where: Callable[[], list[str]] = list  # words that say what the boundary is, of a step that is built later
        self.on_loop: list[Callable[[], None]] = []
        self._ending = ExitStack()
        self.folder = Path(tempfile.mkdtemp(prefix="pointchart-"))
        self._ending.callback(shutil.rmtree, self.folder, ignore_errors=True)
        if tell_close is not None:
            tell_close(self.close)
        try:
            self.server = start_server(self._token, self._entry)
            self._ending.callback(stop_server, self.server)
            self.drawing = Drawing(self.server, scan.points)
            self._build_head()
        except BaseException:
            self.close()
            raise
        self._ending.callback(self._say_ended)

    @property
    def address(self) -> str:
        """What opens the page, token included."""
        return address(self.server, self._token)

    @property
    def entrance(self) -> str:
        """What opens the page once, for those who start a browser: other users of the machine may see it."""
        return address(self.server, self._entry)

    def close(self) -> None:
        """End the job that runs, say so, end the server, and remove the files between steps."""
        self._ending.close()

    def _say_ended(self) -> None:
        self.runner.end()
        self.server.flush()
        time.sleep(LAST)

    def _build_head(self) -> None:
        gui = self.server.gui
        self.darken(False)
        gui.main_panel.dock_right()
        gui.main_panel.set_width(WIDTH)
        gui.set_panel_label(f"pointchart · {Path(*self.path.absolute().parts[-2:])}")
        self.runner = Runner(gui)
        self.shown: Any = gui.add_dropdown("Show", CLOUDS[:1], hint="What is drawn; each step that has run adds to it.")
        self._groups: dict[str, Callable[[], None]] = {CLOUDS[0]: lambda: self.drawing.show("cloud")}
        self._showing = RLock()  # held while something else comes to be shown, which may take a while
        self.shown.on_update(lambda _: self._show())

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
        """Show one of the things that there are, anew if it is shown already."""
        if self.shown.value == name:
            self._show()
        else:
            self.shown.value = name

    def _show(self) -> None:
        with self._showing:
            self._groups[self.shown.value]()

    def loop_changed(self) -> None:
        """Draw the loop again, and write the command lines again."""
        with self.edits:
            for tell in self.on_loop:
                tell()

    def words(self, command: str, out: str, own: Sequence[str]) -> list[str]:
        """Return the words of a command on this scan, which name the boundary as it is now."""
        words = [command, str(self.path), "-o", out]
        takes_loop = self.commands.option(command, "--boundary") is not None
        if takes_loop and self.hand.is_own:
            words += ["--boundary", LOOP_FILE]
        given = self.where()
        for flag, word in zip(given[::2], given[1::2], strict=True):
            is_moot = flag in own or (flag == "--outer" and takes_loop and self.hand.is_own)
            if self.commands.option(command, flag) is not None and not is_moot:
                words += [flag, word]
        return words + list(own)

    def line(self, command: str, out: str, own: Sequence[str]) -> str:
        """Return the command line that a step amounts to."""
        return shell_line(["pointchart", *self.words(command, out, own)])

    def now(self, command: str, own: Sequence[str]) -> Made:
        """Return what a run would be made by now."""
        with self.edits:
            words = self.words(command, "", own)
            return words, self.hand.loop.tobytes() if "--boundary" in words else b""

    @contextmanager
    def running(
        self,
        command: str,
        out: str,
        own: Sequence[str],
        *,
        keep: Callable[[Made], object],
        beside: Sequence[tuple[str, str]] = (),
    ) -> Iterator[list[str]]:
        """Run a command on this scan into the folder between steps; no other runs before the body has ended.

        Parameters
        ----------
        command, out, own
            As for `words`.
        keep : callable
            Called with what the files are made by when they take the place of those of the run before, which is only if
            the run has ended well.
        beside : sequence of (flag, name)
            Files that are written as well.

        Yields
        ------
        What it said.

        Raises
        ------
        PointchartError
            With the sentence of the command line.
        Cancelled
        """
        names, folder = [out, *(name for _, name in beside)], self.folder / RUN
        with self.runner.alone():
            self._check_unchanged()
            folder.mkdir(exist_ok=True)
            try:
                with self.edits:
                    made_by = self.now(command, own)
                    if self.hand.is_own:
                        write_loop(folder / LOOP_FILE, self.hand.loop)
                aside = [word for flag, name in beside for word in (flag, str(folder / name))]
                words = [*made_by[0][:OUT], str(folder / out), *made_by[0][OUT + 1 :], *aside]
                if words[OUT + 1 : OUT + 3] == ["--boundary", LOOP_FILE]:
                    words[OUT + 2] = str(folder / LOOP_FILE)
                lines = self.runner.run(words)
                with self.edits:
                    for name in names:
                        (folder / name).replace(self.folder / name)
                    keep(made_by)
            finally:
                shutil.rmtree(folder, ignore_errors=True)
            yield [self.plain(line) for line in lines]

    def plain(self, text: str) -> str:
        """Leave the folder between steps out of a text: its files have the names that the user gives them."""
        for folder in (self.folder / RUN, self.folder):
            text = text.replace(f"{folder}{os.sep}", "")
        return text

    def send(self, event: viser.GuiEvent[Any], name: str, write: Callable[[Path], object]) -> None:
        """Write a file in the folder between steps, and have the browser that asks for it download it."""
        path, client = self.folder / name, event.client
        if client is None:
            return
        waiting = client.add_notification(name, "being written", loading=True, with_close_button=False)
        try:
            # No run may put another file in the place of the one that is read here.
            with self.edits:
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
            return
        except Cancelled:
            sentence = "cancelled; run it again for a result"
        except PointchartError as reason:
            sentence = self.plain(str(reason))
        except Exception as reason:
            # Whoever calls back drops what is raised, and the user would wait for ever.
            LOG.exception("%s", title)
            sentence = self.plain(
                f"this went wrong on the page itself ({type(reason).__name__}: {reason}); the terminal shows where"
            )
        if tell is None:
            self.notify(title, sentence)
        else:
            tell(sentence)

    def darken(self, is_dark: bool) -> None:
        """Make the page dark, or light again."""
        self.server.gui.configure_theme(
            show_logo=False, show_share_button=False, brand_color=BRAND, control_width="large", dark_mode=is_dark
        )

    def _check_unchanged(self) -> None:
        try:
            is_same = _stamp(self.path) == self._seen
        except OSError:
            is_same = False
        if not is_same:
            raise InputError(f"{self.path} has changed since this page was opened; start pointchart view again")


def _stamp(path: Path) -> tuple[int, int]:
    seen = path.stat()
    return seen.st_mtime_ns, seen.st_size
