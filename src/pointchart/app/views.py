"""What is drawn on the page: one thing at a time, of those that the steps have added."""

from collections.abc import Callable
from threading import RLock
from typing import Any

import viser

CLOUDS = "cloud", "boundary scores"  # what shows points that can be clicked


class Views:
    """A choice of what is drawn; the cloud, to begin with.

    Parameters
    ----------
    gui : viser.GuiApi
    show_cloud : callable
        Draws the cloud.
    """

    def __init__(self, gui: viser.GuiApi, show_cloud: Callable[[], None]) -> None:
        self.shown: Any = gui.add_dropdown("Show", CLOUDS[:1], hint="What is drawn; each step that has run adds to it.")
        self._groups = {CLOUDS[0]: show_cloud}
        self._showing = RLock()  # held while something else comes to be shown, which may take a while
        self.shown.on_update(lambda _: self._show())

    @property
    def has_cloud(self) -> bool:
        """Whether the cloud is shown, so that a click can mean a point of it."""
        return self.shown.value in CLOUDS

    def add(self, name: str, show: Callable[[], None], *, is_next: bool = True) -> None:
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
