"""Rules for the parameters of a finished mesh, and what they promise."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, SupportsIndex

from ..map.convex_combination import Parameterization
from ..mesh.decorated import name_in_module, present_as, rule_within
from ..mesh.make import Meshed
from ..solve.solver import Solver
from ..typing import UV, Loop, Points

ChartMap = Callable[[Points, Loop, UV, Meshed, Solver | None], Parameterization]


@dataclass(frozen=True)
class Chart:
    """A rule for the parameters of a finished mesh; it is called as its map is.

    A plain function in its place promises what the defaults say: to be one-to-one, and to need no map of all points.

    Attributes
    ----------
    map : callable
        ``map(points, loop, boundary_uv, meshed, solver) -> Parameterization``; see `uv_on_mesh`.
    needs_map : bool
        Whether the mesh has to come from a map of all points, whose neighbourhoods and weights the rule uses.
    is_one_to_one : bool
        Whether parameters that the certificate does not prove to be one-to-one are refused.
    name : str
        What the parameters are like, as a phrase.

    Examples
    --------
    >>> mine = Chart(lambda *mesh: mesh, name="of mine")
    >>> mine.needs_map, mine.is_one_to_one
    (False, True)
    """

    map: ChartMap
    needs_map: bool = False
    is_one_to_one: bool = True
    name: str = "of a rule of your own"

    def __post_init__(self) -> None:
        # A rule that decorates a function is called and documented as the function.
        present_as(self, self.map)

    def __reduce_ex__(self, protocol: SupportsIndex) -> Any:
        """Pickle a rule that decorates a function of a module by its name, as functions are."""
        return name_in_module(self) or super().__reduce_ex__(protocol)

    def __call__(
        self, points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver | None
    ) -> Parameterization:
        """Map a mesh."""
        return self.map(points, loop, boundary_uv, meshed, solver)


ChartRule = Chart | ChartMap


def as_chart(rule: ChartRule) -> Chart:
    """Return a rule with its promises; what wraps a rule makes the same, a plain function those that are checked.

    >>> as_chart(lambda *mesh: mesh).is_one_to_one
    True
    """
    inner = rule_within(rule, Chart)
    if inner is None:
        return Chart(rule)
    return inner if inner is rule else replace(inner, map=rule)
