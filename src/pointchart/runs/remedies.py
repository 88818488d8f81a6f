"""Errors of the library in the words of a run: each remedy with the option that asks for it."""

from typing import TYPE_CHECKING

from ..errors import PointchartError, Remedy
from .options import options_of, values_of

if TYPE_CHECKING:
    from .commands import Run

# The option of each remedy, and the word to give it, which only the user knows where it is empty.
OPTIONS = {
    Remedy.bridge_gaps: ("holes", "bridge"),
    Remedy.leave_gaps_open: ("holes", "open"),
    Remedy.name_the_outer_loop: ("outer", "x,y,z"),
    Remedy.give_the_boundary: ("boundary", ""),
    Remedy.take_the_largest_part: ("component", "largest"),
    Remedy.allow_control_points: ("max_control_points", ""),
    Remedy.allow_deviation: ("tolerance", ""),
    Remedy.take_the_best: ("best_effort", ""),
    Remedy.choose_columns: ("columns", ""),
    Remedy.leave_out_invalid: ("drop_invalid", ""),
    Remedy.choose_classes: ("classes", ""),
    Remedy.keep_one_a_place: ("keep", "highest"),
    Remedy.take_heights: ("plane", "xy"),
}
ONCE = (
    Remedy.name_the_outer_loop,
    Remedy.give_the_boundary,
    Remedy.choose_columns,
)  # to give another word is no other remedy


def sentence(error: PointchartError, run: "Run") -> str:
    """Say why a run failed, with the options of its command that may help and are not in force.

    Examples
    --------
    >>> from pathlib import Path
    >>> from pointchart.runs.mesh_run import MeshOptions, MeshRun
    >>> from pointchart.runs.shared_options import Source
    >>> error = PointchartError("a gap is there", remedies=(Remedy.bridge_gaps, Remedy.leave_gaps_open))
    >>> run = MeshRun(source=Source(scan=Path("a.ply")), out=Path("m.ply"), mesh=MeshOptions(holes="open"))
    >>> sentence(error, run)
    'a gap is there; bridge it (--holes bridge)'
    """
    return error.worded(lambda remedy: _worded(remedy, run))


def _worded(remedy: Remedy, run: "Run") -> str | None:
    if remedy not in OPTIONS:
        return str(remedy)
    name, word = OPTIONS[remedy]
    option = next((option for option in options_of(type(run)) if option.name == name), None)
    if option is None:
        return None
    value = values_of(run)[name]
    if value is True or value == word or (remedy in ONCE and value is not None):
        return None
    return f"{remedy} ({' '.join([option.flags[0], *word.split()])})"
