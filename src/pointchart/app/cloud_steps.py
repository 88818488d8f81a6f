"""The first steps: the cloud, and the neighbourhood of a point that is picked."""

from dataclasses import replace
from threading import Lock
from typing import Any

import numpy as np
import viser

from ..errors import InputError
from ..look.camera import AXES
from ..map.scan_parameters import default_stars
from ..map.weights import mean_value
from ..points.places import place_of
from ..points.surroundings import NEAREST
from ..runs.option_values import Neighbors
from ..runs.param_run import ParamRun
from ..runs.shared_options import PaperMethod
from .controls import CHOSEN, Controls
from .html import command_html, refused_html, said_html
from .one_neighborhood import around_point
from .session import Session

SHOW = "shows its neighbourhood"  # what a click does, to be read behind “A click”
# The options that have controls, with their labels: those of the paper's three methods.
METHODS = (("neighbors", "Neighbourhood"), ("k", "k nearest"), ("radius", "Radius"), ("weights", "Weights"))


def add_cloud(session: Session) -> None:
    """Say what was read, in the tab that is open."""
    points, drawn = session.scan.points, len(session.drawing.drawn)
    lines = [f"{len(points):,} points"]
    if drawn < len(points):
        lines[0] += f"; {drawn:,} of them drawn, clicks find them all"
    extent = " x ".join(f"{side:.4g}" for side in np.ptp(points, axis=0))
    ends = np.array([points.min(axis=0), points.max(axis=0)])
    lines += [f"extent {extent}", f"from {place_of(ends, 0)} to {place_of(ends, 1)}"]
    if session.scan.attributes:
        lines.append(f"carries {', '.join(session.scan.attributes)}")
    if len(session.scan.triangles):
        lines.append(f"{len(session.scan.triangles):,} triangles of the file are not looked at")
    gui = session.server.gui
    gui.add_html(said_html(lines))
    up = gui.add_dropdown("Upwards", (CHOSEN, *AXES), hint="The axis of the file that is upwards on the page.")

    @up.on_update
    def _(_: viser.GuiEvent[Any]) -> None:
        with session.reporting("cloud"), session.drawing.changing:
            session.drawing.stand(None if up.value == CHOSEN else up.value)

    size = gui.add_slider("Point size", 0.2, 3.0, 0.1, 1.0)

    @size.on_update
    def _(_: viser.GuiEvent[Any]) -> None:
        with session.drawing.changing:
            session.drawing.size_points(size.value)

    dark = gui.add_checkbox("Dark page", False)
    dark.on_update(lambda _: session.darken(dark.value))


class NeighborhoodStep:
    """The neighbourhood of a point in the tab that is open.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session, self._center = session, -1
        self._one, self._asked = Lock(), 0
        gui = session.server.gui
        gui.add_html(said_html([f"With “A click {SHOW}”, click a point; neighbours follow the controls."]))
        self.controls = Controls(gui, ParamRun, METHODS)
        self._said = gui.add_html("")
        self._line = gui.add_html("")
        self.controls.on_change(session.loop_changed)
        self.controls.on_change(self._draw)
        session.on_loop.append(self._refresh)

    def pick(self, row: int, _: viser.SceneClickEvent) -> None:
        """Show the neighbours of a point."""
        self._center = row
        self._draw()

    def _refresh(self) -> None:
        try:
            self._line.content = command_html(self._session.line(ParamRun, "uv.csv", self.controls.values))
        except InputError as reason:
            self._line.content = refused_html(str(reason))

    def _draw(self) -> None:
        if self._center < 0:
            return
        self._asked += 1
        number = self._asked
        with self._one, self._session.reporting("neighbourhood", self._refuse):
            # Whoever asked last draws what is asked for now; those who waited before have nothing to add.
            if number == self._asked:
                self._draw_now()

    def _draw_now(self) -> None:
        points, method = self._session.scan.points, PaperMethod(**self.controls.values)
        count, reach = method.k or min(NEAREST, len(points) - 1), method.radius or 0.0
        connect = replace(method, neighbors=method.neighbors or Neighbors.delaunay).connect() or default_stars
        scheme = method.scheme() or mean_value
        around = around_point(points, self._center, connect, scheme, k=count, radius=reach)
        what = ("an open star of" if around.is_open else "a star of") if around.is_star else "its"
        low, high = around.weights.min(), around.weights.max()
        lines = [
            f"point {around.center} at {place_of(points, around.center)}",
            f"{what} {len(around.neighbors)} neighbours, weights from {low:.3g} to {high:.3g}",
        ]
        self._said.content = said_html(lines)
        self._session.drawing.draw_around(around, reach or None)

    def _refuse(self, sentence: str) -> None:
        self._said.content = refused_html(sentence)
        self._session.drawing.clear_around()
