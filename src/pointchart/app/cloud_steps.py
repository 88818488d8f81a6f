"""The first steps: the cloud, and the neighbourhood of a point that is picked."""

from threading import Lock
from typing import Any

import numpy as np
import viser

from ..errors import InputError
from ..look.camera import AXES
from .controls import CHOSEN, Controls
from .html import command_html, refused_html, said_html
from .one_neighborhood import around_point
from .session import Page

SHOW = "shows its neighbourhood"
NEAREST = 20
METHODS = (("--neighbors", "Neighbourhood"), ("-k", "k nearest"), ("--radius", "Radius"), ("--weights", "Weights"))


def add_cloud(page: Page) -> None:
    """Say what was read, in the tab that is open."""
    points, drawn = page.scan.points, len(page.drawing.drawn)
    lines = [f"{len(points):,} points"]
    if drawn < len(points):
        lines[0] += f"; {drawn:,} of them drawn, clicks find them all"
    extent = " x ".join(f"{side:.4g}" for side in np.ptp(points, axis=0))
    lines += [f"extent {extent}", f"from {_place(points.min(axis=0))} to {_place(points.max(axis=0))}"]
    if page.scan.attributes:
        lines.append(f"carries {', '.join(page.scan.attributes)}")
    if len(page.scan.triangles):
        lines.append(f"{len(page.scan.triangles):,} triangles of the file are not looked at")
    gui = page.server.gui
    gui.add_html(said_html(lines))
    up = gui.add_dropdown("Upwards", (CHOSEN, *AXES), hint="The axis of the file that is upwards on the page.")

    @up.on_update
    def _(_: viser.GuiEvent[Any]) -> None:
        with page.reporting("cloud"), page.drawing.changing:
            page.drawing.stand(None if up.value == CHOSEN else up.value)

    size = gui.add_slider("Point size", 0.2, 3.0, 0.1, 1.0)

    @size.on_update
    def _(_: viser.GuiEvent[Any]) -> None:
        with page.drawing.changing:
            page.drawing.size_points(size.value)

    dark = gui.add_checkbox("Dark page", False)
    dark.on_update(lambda _: page.darken(dark.value))


class NeighbourhoodStep:
    """The neighbourhood of a point in the tab that is open.

    Parameters
    ----------
    page : Page
    """

    def __init__(self, page: Page) -> None:
        self._page, self._centre = page, -1
        self._one, self._asked = Lock(), 0
        gui = page.server.gui
        gui.add_html(said_html([f"With “A click {SHOW}”, click a point; neighbours follow the controls."]))
        self.controls = Controls(page, "param", METHODS)
        self._said = gui.add_html("")
        self._line = gui.add_html("")
        self.controls.on_change(page.loop_changed)
        self.controls.on_change(self._draw)
        page.on_loop.append(self._refresh)

    def pick(self, row: int, _: viser.SceneClickEvent) -> None:
        """Show the neighbours of a point."""
        self._centre = row
        self._draw()

    def _refresh(self) -> None:
        self._line.content = command_html(self._page.line("param", "uv.csv", self.controls.words))

    def _draw(self) -> None:
        if self._centre < 0:
            return
        self._asked += 1
        number = self._asked
        with self._one, self._page.reporting("neighbourhood", self._refuse):
            # Whoever asked last draws what is asked for now; those who waited before have nothing to add.
            if number == self._asked:
                self._draw_now()

    def _draw_now(self) -> None:
        points, (kind, k, radius, weights) = self._page.scan.points, (self.controls.value(flag) for flag, _ in METHODS)
        count = _whole("-k", k) if k else min(NEAREST, len(points) - 1)
        reach = _number("--radius", radius) if radius else 0.0
        connect, scheme = self._page.commands.rules(kind, k, radius, weights)
        around = around_point(points, self._centre, connect, scheme, k=count, radius=reach)
        what = ("an open star of" if around.is_open else "a star of") if around.is_star else "its"
        low, high = around.weights.min(), around.weights.max()
        lines = [
            f"point {around.centre} at {_place(points[around.centre])}",
            f"{what} {len(around.neighbors)} neighbours, weights from {low:.3g} to {high:.3g}",
        ]
        self._said.content = said_html(lines)
        self._page.drawing.draw_around(around, reach or None)

    def _refuse(self, sentence: str) -> None:
        self._said.content = refused_html(sentence)
        self._page.drawing.clear_around()


def _whole(flag: str, word: str) -> int:
    try:
        return int(word)
    except ValueError:
        raise InputError(f"{flag} is '{word}'; a whole number is needed") from None


def _number(flag: str, word: str) -> float:
    try:
        number = float(word)
    except ValueError:
        number = np.nan
    if not np.isfinite(number):
        raise InputError(f"{flag} is '{word}'; a number is needed")
    return number


def _place(point: np.ndarray) -> str:
    return "(" + ", ".join(f"{x:.9g}" for x in point) + ")"
