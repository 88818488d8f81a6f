"""The page put together: six steps, and what a click on the cloud does."""

from collections.abc import Callable
from pathlib import Path

import viser

from ..io import Scan
from ..typing import Loop
from .boundary_step import BoundaryStep
from .cloud_steps import SHOW, NeighbourhoodStep, add_cloud
from .command import Commands
from .result_steps import MeshStep, SurfaceStep, UVStep
from .session import Page, Told

Click = Callable[[int, viser.SceneClickEvent], object]


def open_page(
    path: Path, scan: Scan, commands: Commands, *, loop: Loop | None = None, tell_close: Told | None = None
) -> Page:
    """Open the page of a scan; see `Page` for the parameters.

    Returns
    -------
    Page
        Its `address` opens it in a browser of this machine; `close` ends it.

    Raises
    ------
    InputError
        If the loop is none of the scan's, or the page cannot be guarded.
    """
    page = Page(path, scan, commands, loop, tell_close)
    try:
        _build(page)
    except BaseException:
        page.close()
        raise
    return page


def _build(page: Page) -> None:
    gui = page.server.gui
    click = gui.add_dropdown("A click", (SHOW,), hint="What a click on the cloud does; dragging turns it all the same.")
    tabs = gui.add_tab_group()
    with tabs.add_tab("Cloud"):
        add_cloud(page)
    with tabs.add_tab("Neighbourhoods"):
        around = NeighbourhoodStep(page)
    with tabs.add_tab("Boundary"):
        boundary = BoundaryStep(page)
    with tabs.add_tab("UV"):
        UVStep(page, around.controls)
    with tabs.add_tab("Mesh"):
        MeshStep(page)
    with tabs.add_tab("Surface"):
        SurfaceStep(page)
    clicks: dict[str, Click] = {SHOW: around.pick, **boundary.clicks}
    click.options = tuple(clicks)
    _listen(page, lambda: click.value, clicks)
    page.loop_changed()


def _listen(page: Page, chosen: Callable[[], str], clicks: dict[str, Click]) -> None:
    @page.server.scene.on_click()
    def _(event: viser.SceneClickEvent) -> None:
        if not page.shows_cloud:
            return
        with page.reporting("click"):
            row = page.drawing.pointed_at(event)
            if row is not None:
                clicks[chosen()](row, event)
