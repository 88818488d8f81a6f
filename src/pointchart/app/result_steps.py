"""The last steps: parameters, mesh and surface, each run, shown and exported."""

import shutil
from pathlib import Path
from typing import cast

import numpy as np

from ..cad import SURFACE_SUFFIXES, read_surface_json, write_surface
from ..io import MESH_SUFFIXES, UV_SUFFIXES, Scan, read_scan, write_mesh, write_uv
from ..runs.fit_run import FitRun
from ..runs.mesh_run import MeshRun
from ..runs.param_run import ParamRun
from ..surface import tessellate
from ..typing import UV
from .controls import Controls
from .html import said_html
from .session import Session
from .step import Step, add_export
from .step_files import StepFiles

# In the folder of the page, in formats that keep every digit: what is exported is made of them.
UV_FILE, MESH_FILE, SURFACE_FILE = "uv-found.ply", "mesh-made.ply", "surface-fitted.json"
DRAWN = 40_000  # points of the mesh of a surface, on the page
# The options that have controls, with their labels, in the order of the page.
DOMAIN = (("domain", "Domain"), ("corners", "Corners"), ("spacing", "Spacing"))
MESH = (("holes", "Gaps"), *DOMAIN, ("uv", "Parameters"), ("swap", "Edge swaps"))
SURFACE = (
    ("tolerance", "Tolerance"),
    ("outliers", "Outliers"),
    ("unit", "Unit"),
    ("degree", "Degree"),
    ("max_control_points", "Control points"),
    ("fairness", "Fairness"),
    ("robust", "Robust"),
    ("domain", "Domain"),
    ("corners", "Corners"),
    ("holes", "Gaps"),
    ("best_effort", "Best effort"),
)

# Said in advance, as the command has no option that chooses a part.
ONE_PART = "UV takes a scan in one part; where there are several, use Mesh with the component largest, or cut the scan."


class UVStep:
    """The paper's parameters in the tab that is open: of the neighbourhoods chosen in the step before.

    Parameters
    ----------
    session : Session
    neighbourhoods : Controls
        Of that step.
    """

    def __init__(self, session: Session, neighborhoods: Controls) -> None:
        self._session = session
        session.server.gui.add_html(said_html([ONE_PART]))
        files = StepFiles(UV_FILE, "uv.csv")
        self._step = Step(
            session, ParamRun, "Map to the plane", DOMAIN, files=files, take=self._take, also=neighborhoods
        )
        self._step.exported_as(add_export(session, "Export the parameters", "uv", UV_SUFFIXES, self._write))

    def _take(self) -> None:
        uv = _uv(read_scan(self._session.folder / UV_FILE))
        session = self._session
        session.drawing.draw_plane(uv, session.hand.loop)
        session.views.add("parameters (uv)", lambda: session.drawing.show("plane"))

    def _write(self, path: Path) -> None:
        read = read_scan(self._step.made("parameters", "map to the plane"))
        write_uv(path, _uv(read), points=read.points, attributes=_without(read, "u", "v"))


class MeshStep:
    """The certified mesh in the tab that is open.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        files = StepFiles(MESH_FILE, "mesh.ply")
        self._step = Step(session, MeshRun, "Make the mesh", MESH, files=files, take=self._take)
        self._step.exported_as(add_export(session, "Export the mesh", "mesh", MESH_SUFFIXES, self._write))

    def _take(self) -> None:
        session, read = self._session, read_scan(self._session.folder / MESH_FILE)
        session.drawing.draw_mesh(read.points, read.triangles, _uv(read))
        session.views.add("mesh in the plane", lambda: session.drawing.show("flat"), is_next=False)
        session.views.add("mesh", lambda: session.drawing.show("mesh"))

    def _write(self, path: Path) -> None:
        made = self._step.made("mesh", "make it")
        if path.suffix == made.suffix:
            shutil.copyfile(made, path)
            return
        read = read_scan(made)
        left_out = ("u", "v") if path.suffix == ".npz" else ("u", "v", "stretch")
        notes = write_mesh(path, read.points, read.triangles, uv=_uv(read), attributes=_without(read, *left_out))
        for note in notes:
            self._session.notify("mesh", note, color="gray")


class SurfaceStep:
    """The fitted surface in the tab that is open.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        files = StepFiles(SURFACE_FILE, "surface.step")
        self._step = Step(session, FitRun, "Fit the surface", SURFACE, files=files, take=self._take)
        self._step.exported_as(add_export(session, "Export the surface", "surface", SURFACE_SUFFIXES, self._write))

    def _take(self) -> None:
        session = self._session
        surface, loops, _ = read_surface_json(session.folder / SURFACE_FILE)
        points, triangles, _ = tessellate(surface, loops, DRAWN)
        session.drawing.draw_surface(points, triangles)
        session.views.add("surface", lambda: session.drawing.show("surface"))

    def _write(self, path: Path) -> None:
        made = self._step.made("surface", "fit it")
        surface, loops, unit = read_surface_json(made)
        write_surface(path, surface, loops, unit=unit)


def _uv(read: Scan) -> UV:
    return cast(UV, read.uv)  # files of these steps carry parameters


def _without(read: Scan, *names: str) -> dict[str, np.ndarray]:
    return {name: column for name, column in read.attributes.items() if name not in names}
