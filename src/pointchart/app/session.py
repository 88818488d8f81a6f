"""A page that is open: its scan, its loop, one run at a time, and what every step shares."""

import logging
import os
import secrets
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from threading import RLock
from typing import Any

import viser

from ..errors import PointchartError
from ..io import Scan, write_loop
from ..report.record import RunReport
from ..runs.command_line import command_line
from ..runs.commands import Run
from ..runs.options import changed, options_of, record_of
from ..runs.process import Cancelled
from ..typing import Loop
from .drawing import Drawing
from .guard import address, start_server, stop_server
from .loop_by_hand import LoopByHand
from .runner import Runner
from .scan_file import ScanFile
from .step_files import StepFiles
from .views import Views

LOG = logging.getLogger(__name__)  # for errors that are ours: the page says that there was one, the terminal which
BRAND = (38, 99, 140)  # of buttons: dark enough for white words on it
WIDTH = 460  # pixels of the panel
LOOP_FILE = "loop.txt"  # the user's own loop, as the commands on the page name it
RUN = "run"  # folder of the files of a run, which are taken out of it when it has ended well
LAST = 0.2  # seconds in which the last words reach the browser

Told = Callable[[Callable[[], None]], object]
Made = tuple[Run, bytes]  # a run, and the user's own loop if it takes one
Values = Mapping[str, Any]  # of options, by their names


class Session:
    """A page that is open, with one scan.

    Parameters
    ----------
    path : Path
        The file, as the user named it.
    scan : Scan
        What it holds.
    loop : (b,) int array, optional
        The user's own boundary to begin with.
    tell_close : callable, optional
        Called with `close` as soon as there is something to close.

    Attributes
    ----------
    runner : Runner
        Executes its runs.
    edits : RLock
        Held by whatever changes the loop, or reads it for a run.
    """

    def __init__(self, path: Path, scan: Scan, loop: Loop | None = None, tell_close: Told | None = None) -> None:
        self.path, self.scan = path, scan
        self.hand = LoopByHand(len(scan.points), loop)
        self._file = ScanFile(path)
        self._token, self._entry = secrets.token_urlsafe(32), secrets.token_urlsafe(32)
        self.edits = RLock()
        self.where: Callable[[], Values] = dict  # options that say what the boundary is, of a step that is built later
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
        """End the run that goes on, say so, end the server, and remove the files between steps."""
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
        self.views = Views(gui, lambda: self.drawing.show("cloud"))

    def loop_changed(self) -> None:
        """Draw the loop again, and write the command lines again."""
        with self.edits:
            for tell in self.on_loop:
                tell()

    def run_of(self, record: type[Run], out: str, own: Values) -> Run:
        """Return a run on this scan: its boundary is named as it is now, other options are its own."""
        known = _names(record)
        has_loop = "boundary" in known and self.hand.is_own
        values = {name: value for name, value in self.where().items() if name in known}
        if has_loop:
            values.pop("outer", None)
            values["boundary"] = Path(LOOP_FILE)
        return record_of(record, {"scan": self.path, "out": Path(out), **values, **own})

    def line(self, record: type[Run], out: str, own: Values) -> str:
        """Return the command line that a step amounts to."""
        return command_line(self.run_of(record, out, own))

    def now(self, record: type[Run], own: Values) -> Made:
        """Return what a run would be made by now."""
        with self.edits:
            is_by_hand = self.hand.is_own and "boundary" in _names(record)
            return self.run_of(record, "", own), self.hand.loop.tobytes() if is_by_hand else b""

    @contextmanager
    def running(
        self, record: type[Run], files: StepFiles, own: Values, *, keep: Callable[[Made], object]
    ) -> Iterator[RunReport]:
        """Execute a run on this scan into the folder between steps; no other is executed before the body has ended.

        Parameters
        ----------
        record : type
            Of the run.
        files : StepFiles
        own : mapping
            See `run_of`.
        keep : callable
            Called with what the files are made by when they take the place of those of the run before, which is only if
            the run has ended well.

        Yields
        ------
        RunReport

        Raises
        ------
        PointchartError
            That of the run.
        Cancelled
        """
        folder = self.folder / RUN
        with self.runner.alone():
            self._file.check_unchanged()
            folder.mkdir(exist_ok=True)
            try:
                with self.edits:
                    made_by = self.now(record, own)
                    if self.hand.is_own:
                        write_loop(folder / LOOP_FILE, self.hand.loop)
                beside = {name: Path(file) for name, file in files.beside}
                run = changed(made_by[0], scan=self.path.absolute(), out=Path(files.written), **beside)
                report = self.runner.execute(run, folder)
                with self.edits:
                    (folder / files.written).replace(self.folder / files.works_on)
                    for _, file in files.beside:
                        (folder / file).replace(self.folder / file)
                    keep(made_by)
            finally:
                shutil.rmtree(folder, ignore_errors=True)
            yield report

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


def _names(record: Any) -> set[str]:
    return {option.name for option in options_of(record)}
