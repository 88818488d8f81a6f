"""The page itself: what it holds, and how it is put together."""

import html
import json
import platform
import re
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...io import replacing
from ...mesh.connectivity import boundary_loops, half_edges
from ...pipeline import Reconstruction
from ...report.as_json import as_json
from ...report.record import RunReport
from ...typing import Floats, Indices, Points, Triangles
from ..camera import camera, upright_axes, upward
from ..color_scales import BELOW_AND_ABOVE, PALE_TO_DARK, counted
from ..paint import ACCENT, FAINT, INK, PAPER, STEEL, STONE
from .colorings import Shade, mesh_shades
from .histograms import quality_histograms
from .pack import packed, quantized, steps
from .thinned import Thinned, thin

MOST_POINTS = 200_000  # drawn: what a phone turns smoothly, and some 10 MB
PAGE_SUFFIXES = (".html", ".htm")  # that browsers open as a page
# What page.html has places for, by name: a page is one file, so that it opens offline.
PARTS = ("page.css", "unpack.js", "geometry.js", "gl.js", "scene.js", "tell.js", "page.js")
# What page.css calls the colours of the pictures, in the light.
PALETTE = f"--paper: {PAPER}; --faint: {FAINT}; --ink: {INK}; --accent: {ACCENT}; --bar: {STEEL};"
BARS = 60  # of the histogram over a scale of colours: a choice, some pixels each on a phone


@dataclass(frozen=True, slots=True, eq=False)
class HtmlPage:
    """A page that is ready to be written.

    Attributes
    ----------
    text : str
        HTML.
    n_points, n_drawn : int
        Points of the mesh, and those that are drawn.
    """

    text: str
    n_points: int
    n_drawn: int

    @property
    def size_line(self) -> str:
        """How large the file is, and how many points it draws.

        >>> HtmlPage("x" * 2_500_000, 900_000, 200_000).size_line
        '2.5 MB, opens offline; 200,000 of 900,000 points drawn'
        """
        thinned = f"; {self.n_drawn:,} of {self.n_points:,} points drawn" if self.n_drawn < self.n_points else ""
        return f"{len(self.text.encode()) / 1e6:.1f} MB, opens offline{thinned}"


def compose(
    points: Points,
    result: Reconstruction,
    report: RunReport,
    *,
    title: str,
    command: str,
    figure: str | None = None,
    deviation: Floats | None = None,
    most: int = MOST_POINTS,
) -> HtmlPage:
    """Compose the page of a run.

    Parameters
    ----------
    points : (n, 3) array
        The vertices of the mesh.
    result : Reconstruction
    report : RunReport
        With the facts that `mesh_facts` gives.
    title : str
        Name of the scan.
    command : str
        The command line that repeats the run.
    figure : str, optional
        The command line that draws a figure of what was written; the page adds from where.
    deviation : (n,) array, optional
        Signed, from a surface that was fitted, of which the report tells.
    most : int
        Points to draw; of larger meshes fewer are shown.

    Returns
    -------
    HtmlPage
    """
    title = title.encode("utf-8", "replace").decode()  # names of files may hold other bytes
    shown = thin(points, result.triangles, most)
    shades = mesh_shades(points, result.triangles, result.uv, result.loop, deviation=deviation)
    low, extent = points.min(axis=0), float(np.ptp(points, axis=0).max())
    arrays = {"position": quantized(points[shown.kept], low, extent), **_arrays(result, shown)}
    spacing = next(shade.values for shade in shades if shade.name == "spacing")
    described = []
    for shade in shades:
        row, arrays[shade.name] = _described(shade, shown.kept)
        described.append(row)
    table, data = packed(arrays)
    content = {
        "title": title,
        "command": command,
        "figure": figure,
        **_standing(points, result.triangles),
        "made_with": f"pointchart {version('pointchart')}, Python {platform.python_version()}, numpy {np.__version__}",
        "box": {"low": low.tolist(), "extent": extent},
        "drawn": len(shown.kept),
        "arrays": table,
        "shades": described,
        "stone": STONE.tolist(),
        "checks": [
            {"passed": bool(check.passed), "measured": check.passed is None, "text": check.text}
            for check in report.checks
        ],
        "places": _places(points, report.facts),
        "histograms": quality_histograms(points, result.triangles, result.uv, spacing),
        "run": as_json(report),
    }
    return HtmlPage(_filled(title, content, data), len(points), len(shown.kept))


def _standing(points: Points, triangles: Triangles) -> dict[str, Any]:
    """Return how the mesh stands on the page, and from where it is looked at first."""
    up = upward(points, triangles)
    return {
        "up": up,
        "upright": upright_axes(up).ravel().tolist(),
        "turn": camera(points, triangles, up=up).ravel().tolist(),
    }


def _arrays(result: Reconstruction, shown: Thinned) -> dict[str, NDArray[Any]]:
    """Return what the page draws of a mesh, but for the places of its points."""
    loops = [shown.along(loop) for loop in boundary_loops(half_edges(result.triangles, len(result.rows)))]
    return {
        "uv": result.uv[shown.kept].astype(np.float32),
        "triangles": steps(shown.triangles.ravel()),
        "loop": steps(np.concatenate(loops)),
        "loop_sizes": np.array([len(loop) for loop in loops], np.uint32),
        "row": steps(result.rows[shown.kept]),
    }


def _places(points: Points, facts: dict[str, Any]) -> list[dict[str, Any]]:
    """List what is worth a look: where the mesh is in doubt or passes through itself, then gaps of the scan."""
    doubts = [("long edges where the scan has no gap", bridge) for bridge in facts["boundary"]["doubts"]]
    gaps = [("a gap of the scan", bridge) for bridge in facts["boundary"]["gaps"]]
    crossings = facts["quality"]["self_intersections"]["places"]
    return [
        *({"what": what, "is_doubt": True, "at": points[bridge["at_vertex"]].tolist()} for what, bridge in doubts),
        *({"what": "the mesh passes through itself", "is_doubt": True, "at": place} for place in crossings),
        *({"what": what, "is_doubt": False, "at": points[bridge["at_vertex"]].tolist()} for what, bridge in gaps),
    ]


def _described(shade: Shade, kept: Indices) -> tuple[dict[str, Any], NDArray[np.uint16]]:
    placed = shade.placed
    low, high = float(placed.min()), float(placed.max())
    first, last = shade.reach
    counts, _ = counted(placed, first, last, BARS)
    row = {
        "name": shade.name,
        "meaning": shade.meaning,
        "is_signed": shade.is_signed,
        "is_log": shade.is_log,
        "colors": BELOW_AND_ABOVE if shade.is_signed else PALE_TO_DARK,
        "range": [low, high],
        "reach": [first, last],
        "counts": counts.tolist(),
    }
    return row, quantized(placed[kept], low, high - low)


def _filled(title: str, content: dict[str, Any], data: str) -> str:
    """Put everything into the one file; text from outside can end no element."""
    folder = files(__package__) / "assets"
    values = {name: (folder / name).read_text("utf-8") for name in PARTS}
    values["page.css"] = values["page.css"].replace("{{palette}}", PALETTE)
    values |= {"title": html.escape(title), "data": data}
    values["content"] = json.dumps(content, allow_nan=False).replace("<", "\\u003c")
    return re.sub(r"{{([\w.]+)}}", lambda place: values[place[1]], (folder / "page.html").read_text("utf-8"))


@contextmanager
def writing_page(path: Path | None, page: HtmlPage | None) -> Iterator[None]:
    """Write a page, if there is one; it is in its place when the block has ended well."""
    with nullcontext() if path is None else replacing(path) as temporary:
        if temporary is not None and page is not None:
            temporary.write_text(page.text, encoding="utf-8")
        yield
