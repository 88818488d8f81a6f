"""The runs that there are, by the names of their commands."""

from .boundary_run import BoundaryRun
from .check_run import CheckRun
from .demo_run import DemoRun
from .figure_run import FigureRun
from .fit_run import FitRun
from .mesh_run import MeshRun
from .param_run import ParamRun
from .view_run import ViewRun

Run = MeshRun | ParamRun | BoundaryRun | FitRun | FigureRun | CheckRun | DemoRun
# In the order in which --help lists the commands.
RECORDS: dict[str, type[Run | ViewRun]] = {
    record.command: record for record in (MeshRun, ParamRun, BoundaryRun, FitRun, FigureRun, CheckRun, ViewRun, DemoRun)
}
