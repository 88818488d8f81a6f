"""The page put together: six steps, and what a click on the cloud does."""

from collections.abc import Callable
from pathlib import Path

import viser

from ..io import Scan
from ..typing import Loop
from .boundary_step import BoundaryStep
from .cloud_steps import SHOW, NeighborhoodStep, add_cloud
from .result_steps import MeshStep, SurfaceStep, UVStep
from .session import Session, Told

Click = Callable[[int, viser.SceneClickEvent], object]


def open_page(path: Path, scan: Scan, *, loop: Loop | None = None, tell_close: Told | None = None) -> Session:
    """Open the page of a scan; see `Session` for the parameters.

    Returns
    -------
    Session
        Its `address` opens it in a browser of this machine; `close` ends it.

    Raises
    ------
    InputError
        If the loop is none of the scan's, or the page cannot be guarded.
    """
    session = Session(path, scan, loop, tell_close)
    try:
        _build(session)
    except BaseException:
        session.close()
        raise
    return session


def _build(session: Session) -> None:
    gui = session.server.gui
    click = gui.add_dropdown("A click", (SHOW,), hint="What a click on the cloud does; dragging turns it all the same.")
    tabs = gui.add_tab_group()
    with tabs.add_tab("Cloud"):
        add_cloud(session)
    with tabs.add_tab("Neighbourhoods"):
        around = NeighborhoodStep(session)
    with tabs.add_tab("Boundary"):
        boundary = BoundaryStep(session)
    with tabs.add_tab("UV"):
        UVStep(session, around.controls)
    with tabs.add_tab("Mesh"):
        MeshStep(session)
    with tabs.add_tab("Surface"):
        SurfaceStep(session)
    clicks: dict[str, Click] = {SHOW: around.pick, **boundary.clicks}
    click.options = tuple(clicks)
    _listen(session, lambda: click.value, clicks)
    session.loop_changed()


def _listen(session: Session, chosen: Callable[[], str], clicks: dict[str, Click]) -> None:
    @session.server.scene.on_click()
    def _(event: viser.SceneClickEvent) -> None:
        if not session.views.has_cloud:
            return
        with session.reporting("click"):
            row = session.drawing.pointed_at(event)
            if row is not None:
                clicks[chosen()](row, event)
