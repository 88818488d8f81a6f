"""``pointchart view``: a local page with the pipeline as steps."""

import sys
from typing import TYPE_CHECKING

from ..runs.view_run import ViewRun

if TYPE_CHECKING:
    from ..typing import Loop


def open_view(run: ViewRun) -> None:
    """Open the app on a scan, until Ctrl-C ends it."""
    from importlib.util import find_spec
    from threading import Event

    from .._check import check_loop, check_points
    from ..errors import InputError
    from ..io import read_loop, read_scan
    from ..runs.interruptible import at_interrupt

    if find_spec("viser") is None:
        raise InputError("view needs viser; install it by: pip install 'pointchart[view]'")
    read = read_scan(run.scan)
    check_points(read.points)
    loop: Loop | None = None if run.boundary is None else check_loop(read_loop(run.boundary), len(read.points))

    from ..app.browser_app import open_page

    page = open_page(run.scan, read, loop=loop, tell_close=at_interrupt.append)
    print(f"{page.address}\nthe page of {run.scan}; Ctrl-C ends it", file=sys.stderr, flush=True)
    if run.browser:
        import webbrowser

        webbrowser.open(page.entrance)
    Event().wait()
