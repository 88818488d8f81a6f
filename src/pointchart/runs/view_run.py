"""``pointchart view``: what the app begins with."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from .options import Group, option
from .shared_options import boundary_option, scan_argument


@dataclass(frozen=True, slots=True, kw_only=True)
class ViewRun:
    """Open a page of this machine only, with the pipeline as steps and the boundary by hand; Ctrl-C ends it."""

    command: ClassVar[str] = "view"

    scan: Path = scan_argument()
    boundary: Path | None = boundary_option()
    browser: bool = option(
        "--browser/--no-browser",
        default=True,
        help="Open the page in the browser, or print its address only.",
        group=Group.running,
    )
