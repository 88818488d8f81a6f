"""The step of the boundary: found, picked by hand, saved."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import viser

from .._check import check_loop
from ..boundary import perimeter, reversed_loop
from ..errors import InputError, PointchartError
from ..gaps.rules import place_of
from ..io import read_loop, read_scan, write_loop
from ..plane.polygons import is_inside
from ..typing import UV, Floats, Indices
from .html import said_html
from .loop_by_hand import LoopByHand, dropped, inserted, nearest_of
from .picking import Camera, project, unproject, visible
from .session import CLOUDS, Page
from .step import Step

FOUND, LOOPS, LOADED = "loop-found.txt", "loops.ply", "loaded.txt"
BOUNDARY_SCORE = 0.5
NEAR = 0.05  # depth from which on points count for where the polygon is drawn
CLOSER = 0.9  # share of the way to the nearest point at which the polygon is drawn
INSERT, DROP, OUTER = "inserts it in the loop", "drops the nearest loop point", "names the outer loop"
LABELS = (("--outer", "Outer loop at"), ("--component", "Component"))
UNDO, REVERSE, RESTART, EMPTY = "Undo", "Reverse", "Found loop", "Empty"
ADD, LEAVE_OUT, CLEAR = "Add", "Drop", "Clear"
HOW = (
    "“A click” above says what a click on the cloud does, as to insert or drop a point. Shift + drag draws a polygon: "
    "it selects points seen inside that are in the loop or score as boundary points, to be added or dropped."
)
NO_POINTS: Indices = np.empty(0, np.int64)


class BoundaryStep:
    """The boundary in the tab that is open.

    Parameters
    ----------
    page : Page
    """

    def __init__(self, page: Page) -> None:
        gui = page.server.gui
        self._page = page
        self._found: Indices | None = None
        self._others = self._selected = NO_POINTS
        self._n_hidden = 0  # boundary points inside the polygon that are not selected
        self._scores: Floats | None = None
        self.step = Step(
            page,
            "boundary",
            "Find the boundary",
            LABELS,
            works_on=FOUND,
            out="loop.txt",
            take=self._take,
            beside=(("--ply", LOOPS),),
        )
        page.where = lambda: self.step.controls.words
        self.step.controls.on_change(page.loop_changed)
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
        page.on_loop.append(self._show)
        page.drawing.on_line(self._draw_polygon, self._select)

    @property
    def clicks(self) -> dict[str, Callable[[int, viser.SceneClickEvent], object]]:
        """What clicks on the cloud can do for the boundary, given the point that is meant."""
        return {INSERT: self._insert, DROP: self._drop, OUTER: self._name_outer}

    def _take(self) -> None:
        found, columns = read_loop(self._page.folder / FOUND), read_scan(self._page.folder / LOOPS).attributes
        with self._page.edits:
            self._found, self._scores = found, columns["score_total"]
            self._others = np.flatnonzero(columns["loop"] > 1)
            self._page.hand.begin(found)
        self._page.add_view(CLOUDS[0], self._show_plain, is_next=False)
        self._page.add_view(CLOUDS[1], self._show_scores, is_next=False)
        self._page.look_at(CLOUDS[0])
        self._page.loop_changed()

    def _show_plain(self) -> None:
        self._page.drawing.color_cloud(None)
        self._page.drawing.show("cloud")

    def _show_scores(self) -> None:
        if self._scores is not None:
            share = np.clip(self._scores, 0.0, 1.0)[:, None]
            self._page.drawing.color_cloud((1.0 - share) * [0.8, 0.84, 0.85] + share * [0.78, 0.33, 0.24])
        self._page.drawing.show("cloud")

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
                hand.change(inserted(self._page.scan.points, hand.loop, self._selected))
            else:
                hand.change(dropped(hand.loop, self._selected))
            self._selected = NO_POINTS

    @contextmanager
    def _changing(self) -> Iterator[LoopByHand]:
        """Let changes of the loop come one after the other, show their errors, or else the cloud with the new loop."""
        page = self._page
        with page.edits, page.reporting("boundary"):
            yield page.hand
            if not page.shows_cloud:
                page.look_at(CLOUDS[0])
            page.loop_changed()

    def _insert(self, row: int, _: viser.SceneClickEvent) -> None:
        with self._changing() as hand:
            hand.change(inserted(self._page.scan.points, hand.loop, row))

    def _drop(self, row: int, _: viser.SceneClickEvent) -> None:
        with self._changing() as hand:
            hand.change(dropped(hand.loop, nearest_of(self._page.scan.points, hand.loop, row)))

    def _name_outer(self, row: int, _: viser.SceneClickEvent) -> None:
        self.step.controls.set("--outer", place_of(self._page.scan.points, row).strip("()").replace(" ", ""))
        self._page.loop_changed()

    def _draw_polygon(self, camera: Camera, polygon: UV) -> None:
        drawing = self._page.drawing
        depth = camera.depths(drawing.places[drawing.drawn])
        ahead = depth[depth > NEAR].min(initial=np.inf)
        if self._page.shows_cloud and np.isfinite(ahead):
            drawing.draw_polygon(unproject(polygon, camera, CLOSER * ahead))

    def _select(self, camera: Camera, polygon: UV) -> None:
        page, drawing = self._page, self._page.drawing
        with page.edits, page.reporting("boundary"):
            if not page.shows_cloud:
                raise InputError("the cloud is not shown, so that no points of it are selected; set Show to cloud")
            scored = NO_POINTS if self._scores is None else np.flatnonzero(self._scores >= BOUNDARY_SCORE)
            rows = np.union1d(page.hand.loop, scored)
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
        with self._page.edits:
            self._selected, self._n_hidden = rows, n_hidden
            self._show()

    def _show(self) -> None:
        loop, points = self._page.hand.loop, self._page.scan.points
        kind = "by hand" if self._page.hand.is_own else "found"
        lines = [f"{kind}: {len(loop)} points, {perimeter(points, loop):.4g} long" if len(loop) else "no loop yet"]
        if len(self._selected):
            lines.append(f"{len(self._selected)} selected, {np.isin(self._selected, loop).sum()} of them in the loop")
            if self._n_hidden:
                lines.append(f"{self._n_hidden} more inside the polygon are hidden by the cloud")
        self._state.content = said_html(lines)
        self._page.drawing.draw_loop(loop, self._others)
        self._page.drawing.draw_selected(self._selected)

    def _add_files(self) -> None:
        gui, page = self._page.server.gui, self._page
        save = gui.add_button("Save the loop file", icon=viser.Icon.DOWNLOAD)
        load = gui.add_upload_button("Load a loop file", icon=viser.Icon.UPLOAD)

        @save.on_click
        def _(event: viser.GuiEvent[Any]) -> None:
            with page.reporting("boundary"):
                if len(page.hand.loop) < 3:
                    raise InputError(f"the loop has {len(page.hand.loop)} points; it needs at least 3 to be a boundary")
                page.send(event, "loop.txt", lambda path: write_loop(path, page.hand.loop))

        @load.on_upload
        def _(_: viser.GuiEvent[Any]) -> None:
            with self._changing() as hand:
                path = page.folder / LOADED
                path.write_bytes(load.value.content)
                try:
                    hand.change(check_loop(read_loop(path), len(page.scan.points)))
                except PointchartError as failure:
                    raise PointchartError(str(failure).replace(str(path), load.value.name)) from None
