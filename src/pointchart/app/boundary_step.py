"""The step of the boundary: found, picked by hand, saved."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import viser

from .._check import check_loop
from ..boundary import perimeter, reversed_loop
from ..errors import InputError, PointchartError
from ..io import read_loop, read_scan, write_loop
from ..plane.polygons import is_inside
from ..points.places import coordinates_of
from ..runs.boundary_run import BoundaryRun
from ..typing import UV, Floats, Indices
from .html import said_html
from .loop_by_hand import LoopByHand, dropped, inserted, nearest_of
from .picking import Camera, project, unproject, visible
from .session import Session
from .step import Step
from .step_files import StepFiles
from .views import CLOUDS

FOUND, LOOPS, LOADED = "loop-found.txt", "loops.ply", "loaded.txt"  # files in the folder of the page
BOUNDARY_SCORE = 0.5  # from which on more speaks for the boundary than against it
NEAR = 0.05  # depth from which on points count for where the polygon is drawn
CLOSER = 0.9  # share of the way to the nearest point at which the polygon is drawn
# What a click does, to be read behind “A click”; then the labels of options and of buttons.
INSERT, DROP, OUTER = "inserts it in the loop", "drops the nearest loop point", "names the outer loop"
LABELS = (("outer", "Outer loop at"), ("component", "Component"))
UNDO, REVERSE, RESTART, EMPTY = "Undo", "Reverse", "Found loop", "Empty"
ADD, LEAVE_OUT, CLEAR = "Add", "Drop", "Clear"
# Said, as no control of the page shows that points can be selected so.
HOW = (
    "“A click” above says what a click on the cloud does, as to insert or drop a point. Shift + drag draws a polygon: "
    "it selects points seen inside that are in the loop or score as boundary points, to be added or dropped."
)
NO_POINTS: Indices = np.empty(0, np.int64)  # what is selected, and other loops, before there are any


class BoundaryStep:
    """The boundary in the tab that is open.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        gui = session.server.gui
        self._session = session
        self._found: Indices | None = None
        self._others = self._selected = NO_POINTS
        self._n_hidden = 0  # boundary points inside the polygon that are not selected
        self._scores: Floats | None = None
        files = StepFiles(FOUND, "loop.txt", (("ply", LOOPS),))
        self.step = Step(session, BoundaryRun, "Find the boundary", LABELS, files=files, take=self._take)
        session.where = lambda: self.step.controls.values
        self.step.controls.on_change(session.loop_changed)
        gui.add_divider()
        self._state = gui.add_html("")
        gui.add_html(said_html([HOW]))
        edits = gui.add_button_group("By hand", (UNDO, REVERSE, RESTART, EMPTY))
        edits.on_click(lambda event: self._edit(event.target.value))
        chosen = gui.add_button_group(
            "Selected", (ADD, LEAVE_OUT, CLEAR), hint="Points that a polygon was drawn round."
        )
        chosen.on_click(lambda event: self._edit_selected(event.target.value))
        self._add_files()
        session.on_loop.append(self._show)
        session.drawing.on_line(self._draw_polygon, self._select)

    @property
    def clicks(self) -> dict[str, Callable[[int, viser.SceneClickEvent], object]]:
        """What clicks on the cloud can do for the boundary, given the point that is meant."""
        return {INSERT: self._insert, DROP: self._drop, OUTER: self._name_outer}

    def _take(self) -> None:
        found, columns = read_loop(self._session.folder / FOUND), read_scan(self._session.folder / LOOPS).attributes
        with self._session.edits:
            self._found, self._scores = found, columns["score_total"]
            self._others = np.flatnonzero(columns["loop"] > 1)
            self._session.hand.begin(found)
        self._session.views.add(CLOUDS[0], self._show_plain, is_next=False)
        self._session.views.add(CLOUDS[1], self._show_scores, is_next=False)
        self._session.views.look_at(CLOUDS[0])
        self._session.loop_changed()

    def _show_plain(self) -> None:
        self._session.drawing.color_cloud(None)
        self._session.drawing.show("cloud")

    def _show_scores(self) -> None:
        if self._scores is not None:
            share = np.clip(self._scores, 0.0, 1.0)[:, None]
            self._session.drawing.color_cloud((1.0 - share) * [0.8, 0.84, 0.85] + share * [0.78, 0.33, 0.24])
        self._session.drawing.show("cloud")

    def _edit(self, what: str) -> None:
        with self._changing() as hand:
            if what == UNDO:
                hand.undo()
            elif what == REVERSE:
                hand.change(reversed_loop(hand.loop))
            elif what == EMPTY:
                hand.change(NO_POINTS)
            elif self._found is None:
                raise InputError("no boundary has been found yet; find it first")
            else:
                hand.begin(self._found)

    def _edit_selected(self, what: str) -> None:
        if what == CLEAR:
            self._take_selected(NO_POINTS)
            return
        with self._changing() as hand:
            if not len(self._selected):
                raise InputError("no points are selected; drag with the shift key round some boundary points")
            in_loop = np.isin(self._selected, hand.loop)
            if what == ADD and in_loop.all():
                raise InputError(f"nothing to add: of {len(in_loop)} selected all are in the loop already")
            if what == LEAVE_OUT and not in_loop.any():
                raise InputError(f"nothing to drop: of {len(in_loop)} selected none is in the loop")
            if what == ADD:
                hand.change(inserted(self._session.scan.points, hand.loop, self._selected))
            else:
                hand.change(dropped(hand.loop, self._selected))
            self._selected = NO_POINTS

    @contextmanager
    def _changing(self) -> Iterator[LoopByHand]:
        """Let changes of the loop come one after the other, show their errors, or else the cloud with the new loop."""
        session = self._session
        with session.edits, session.reporting("boundary"):
            yield session.hand
            if not session.views.has_cloud:
                session.views.look_at(CLOUDS[0])
            session.loop_changed()

    def _insert(self, row: int, _: viser.SceneClickEvent) -> None:
        with self._changing() as hand:
            hand.change(inserted(self._session.scan.points, hand.loop, row))

    def _drop(self, row: int, _: viser.SceneClickEvent) -> None:
        with self._changing() as hand:
            hand.change(dropped(hand.loop, nearest_of(self._session.scan.points, hand.loop, row)))

    def _name_outer(self, row: int, _: viser.SceneClickEvent) -> None:
        self.step.controls.set("outer", coordinates_of(self._session.scan.points, row))
        self._session.loop_changed()

    def _draw_polygon(self, camera: Camera, polygon: UV) -> None:
        drawing = self._session.drawing
        depth = camera.depths(drawing.places[drawing.drawn])
        ahead = depth[depth > NEAR].min(initial=np.inf)
        if self._session.views.has_cloud and np.isfinite(ahead):
            drawing.draw_polygon(unproject(polygon, camera, CLOSER * ahead))

    def _select(self, camera: Camera, polygon: UV) -> None:
        session, drawing = self._session, self._session.drawing
        with session.edits, session.reporting("boundary"):
            if not session.views.has_cloud:
                raise InputError("the cloud is not shown, so that no points of it are selected; set Show to cloud")
            scored = NO_POINTS if self._scores is None else np.flatnonzero(self._scores >= BOUNDARY_SCORE)
            rows = np.union1d(session.hand.loop, scored)
            if not len(rows):
                raise InputError("there are no boundary points to select yet; find the boundary first")
            inside = rows[is_inside([polygon], project(drawing.places[rows], camera))]
            if not len(inside):
                raise InputError(
                    f"none of {len(rows)} boundary points is inside the polygon; draw it round some of them"
                )
            cloud, places = drawing.places[drawing.drawn], drawing.places[inside]
            seen = inside[visible(cloud, places, camera.position, spacing=drawing.spacing)]
            if not len(seen):
                raise InputError(f"the cloud hides all {len(inside)} boundary points inside the polygon; turn it")
            self._take_selected(seen, n_hidden=len(inside) - len(seen))

    def _take_selected(self, rows: Indices, *, n_hidden: int = 0) -> None:
        with self._session.edits:
            self._selected, self._n_hidden = rows, n_hidden
            self._show()

    def _show(self) -> None:
        loop, points = self._session.hand.loop, self._session.scan.points
        kind = "by hand" if self._session.hand.is_own else "found"
        lines = [f"{kind}: {len(loop)} points, {perimeter(points, loop):.4g} long" if len(loop) else "no loop yet"]
        if len(self._selected):
            lines.append(f"{len(self._selected)} selected, {np.isin(self._selected, loop).sum()} of them in the loop")
            if self._n_hidden:
                lines.append(f"{self._n_hidden} more inside the polygon are hidden by the cloud")
        self._state.content = said_html(lines)
        self._session.drawing.draw_loop(loop, self._others)
        self._session.drawing.draw_selected(self._selected)

    def _add_files(self) -> None:
        gui, session = self._session.server.gui, self._session
        save = gui.add_button("Save the loop file", icon=viser.Icon.DOWNLOAD)
        load = gui.add_upload_button("Load a loop file", icon=viser.Icon.UPLOAD)

        @save.on_click
        def _(event: viser.GuiEvent[Any]) -> None:
            with session.reporting("boundary"):
                if len(session.hand.loop) < 3:
                    raise InputError(
                        f"the loop has {len(session.hand.loop)} points; it needs at least 3 to be a boundary"
                    )
                session.send(event, "loop.txt", lambda path: write_loop(path, session.hand.loop))

        @load.on_upload
        def _(_: viser.GuiEvent[Any]) -> None:
            with self._changing() as hand:
                path = session.folder / LOADED
                path.write_bytes(load.value.content)
                try:
                    hand.change(check_loop(read_loop(path), len(session.scan.points)))
                except PointchartError as failure:
                    raise PointchartError(str(failure).replace(str(path), load.value.name)) from None
