"""The step of the boundary: found, picked by hand, saved."""

from collections.abc import Callable
from threading import Lock
from typing import Any

import numpy as np
import viser

from .._check import check_loop
from ..boundary import perimeter, reversed_loop
from ..errors import InputError, PointchartError
from ..gaps import place_of
from ..io import read_loop, read_scan, write_loop
from ..typing import UV, Floats, Indices, Points
from .loop_by_hand import dropped, inserted, nearest_of
from .page import CLOUDS, Page
from .picking import Camera, inside_polygon, project, unproject, visible
from .step import Step
from .words import said_html

FOUND, LOOPS, LOADED = "loop-found.txt", "loops.ply", "loaded.txt"
BOUNDARY_SCORE = 0.5
NEAR = 0.05  # depth from which on points count for where the polygon is drawn
CLOSER = 0.9  # share of the way to the nearest point at which the polygon is drawn
INSERT, DROP, OUTER = "inserts it in the loop", "drops the nearest loop point", "names the outer loop"
LABELS = (("--outer", "Outer loop at"), ("--component", "Component"))
UNDO, REVERSE, RESTART, EMPTY = "Undo", "Reverse", "Found loop", "Empty"
TAKE, LEAVE, CLEAR = "Add inside", "Drop inside", "Clear polygon"
HOW = (
    "“A click” above says what a click on the cloud does: insert or drop a point. Shift + drag draws a polygon: points "
    "seen inside are added, where they score as boundary points, or dropped."
)


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
        self._others: Indices = np.empty(0, np.int64)
        self._scores: Floats | None = None
        self._polygon: tuple[Camera, UV] | None = None
        self._one = Lock()  # held while the polygon is another than the one that is drawn
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
        area = gui.add_button_group("Polygon", (TAKE, LEAVE, CLEAR), hint="What is behind the cloud is left alone.")
        area.on_click(lambda event: self._edit_inside(event.target.value))
        self._add_files()
        page.on_loop.append(self._show)
        page.drawing.on_line(self._draw_polygon)

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
        hand = self._page.hand
        with self._page.editing():
            if what == UNDO:
                hand.undo()
            elif what == REVERSE:
                hand.change(reversed_loop(hand.loop))
            elif what == EMPTY:
                hand.change(np.empty(0, np.int64))
            elif self._found is None:
                raise InputError("no boundary has been found yet; find it first")
            else:
                hand.begin(self._found)
            self._page.loop_changed()

    def _edit_inside(self, what: str) -> None:
        hand = self._page.hand
        with self._page.editing():
            if what != CLEAR:
                rows = self._rows_inside(hand.loop if what == LEAVE else self._likely())
                points = self._page.scan.points
                hand.change(dropped(hand.loop, rows) if what == LEAVE else inserted(points, hand.loop, rows))
            self._set_polygon(None, np.empty((0, 3)))
            self._page.loop_changed()

    def _likely(self) -> Indices:
        """Return the points that score as boundary points."""
        if self._scores is None:
            raise InputError("points have no scores yet, which tell boundary points; find the boundary first")
        return np.flatnonzero(self._scores >= BOUNDARY_SCORE)

    def _rows_inside(self, rows: Indices) -> Indices:
        """Return those of some points that were seen inside the polygon when it was drawn."""
        if not self._page.shows_cloud:
            raise InputError("the cloud is not shown, nor a polygon on it; set Show to cloud")
        if self._polygon is None or len(self._polygon[1]) < 3:
            raise InputError("no polygon has been drawn; drag with the shift key round some boundary points")
        (camera, polygon), drawing = self._polygon, self._page.drawing
        inside = rows[inside_polygon(project(drawing.places[rows], camera), polygon)]
        cloud, places = drawing.places[drawing.drawn], drawing.places[inside]
        inside = inside[visible(cloud, places, camera.position, spacing=drawing.spacing)]
        if not len(inside):
            raise InputError(
                f"none of {len(rows)} boundary points is seen inside the polygon; draw it round some of them"
            )
        return inside

    def _insert(self, row: int, _: viser.SceneClickEvent) -> None:
        hand = self._page.hand
        with self._page.editing():
            hand.change(inserted(self._page.scan.points, hand.loop, row))
            self._page.loop_changed()

    def _drop(self, row: int, _: viser.SceneClickEvent) -> None:
        hand = self._page.hand
        with self._page.editing():
            hand.change(dropped(hand.loop, nearest_of(self._page.scan.points, hand.loop, row)))
            self._page.loop_changed()

    def _name_outer(self, row: int, _: viser.SceneClickEvent) -> None:
        self.step.controls.set("--outer", place_of(self._page.scan.points, row).strip("()").replace(" ", ""))
        self._page.loop_changed()

    def _draw_polygon(self, camera: Camera, polygon: UV) -> None:
        drawing = self._page.drawing
        depth = camera.depths(drawing.places[drawing.drawn])
        ahead = depth[depth > NEAR].min(initial=np.inf)
        if self._page.shows_cloud and np.isfinite(ahead):
            self._set_polygon((camera, polygon), unproject(polygon, camera, CLOSER * ahead))

    def _set_polygon(self, polygon: tuple[Camera, UV] | None, corners: Points) -> None:
        with self._one:
            self._polygon = polygon
            self._page.drawing.draw_polygon(corners)

    def _show(self) -> None:
        loop, points = self._page.hand.loop, self._page.scan.points
        kind = "by hand" if self._page.hand.is_own else "found"
        text = f"{kind}: {len(loop)} points, {perimeter(points, loop):.4g} long" if len(loop) else "no loop yet"
        self._state.content = said_html([text])
        self._page.drawing.draw_loop(loop, self._others)

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
            with page.editing():
                path = page.folder / LOADED
                path.write_bytes(load.value.content)
                try:
                    page.hand.change(check_loop(read_loop(path), len(page.scan.points)))
                except PointchartError as failure:
                    raise PointchartError(str(failure).replace(str(path), load.value.name)) from None
                page.loop_changed()
