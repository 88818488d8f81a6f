"""Rules for edge swaps: what they begin from, and what they leave."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, SupportsIndex

from numpy.typing import ArrayLike

from ..typing import Triangles
from .decorated import name_in_module, present_as, rule_within


@dataclass(frozen=True, slots=True, eq=False)
class Swapped:
    """A mesh after edge swaps.

    Attributes
    ----------
    triangles : (m, 3) int64
        On the same points, with the same boundary.
    n_swaps : int
        Swaps that were made.
    is_settled : bool
        Whether no edge asks for another swap; False if some triangle reached the limit of swaps.
    """

    triangles: Triangles
    n_swaps: int
    is_settled: bool


SwapFunction = Callable[[ArrayLike, Triangles], Swapped]


@dataclass(frozen=True)
class Swaps:
    """A rule for edge swaps in space; it is called as its function is.

    A plain function in its place is taken for a rule that goes on from the Delaunay mesh.

    Attributes
    ----------
    swap : callable
        ``swap(points, triangles) -> Swapped``; see `swap_to_delaunay`.
    from_delaunay : bool
        Whether it begins from the Delaunay mesh of the surface; otherwise from the triangulation of the parameters, for
        which a map of all points is needed.
    is_delaunay : bool
        Whether it leaves a Delaunay mesh as it is.

    Examples
    --------
    >>> Swaps(lambda points, triangles: Swapped(triangles, 0, True)).from_delaunay
    True
    """

    swap: SwapFunction
    from_delaunay: bool = True
    is_delaunay: bool = False

    def __post_init__(self) -> None:
        # A rule that decorates a function is called and documented as the function.
        present_as(self, self.swap)

    def __reduce_ex__(self, protocol: SupportsIndex) -> Any:
        """Pickle a rule that decorates a function of a module by its name, as functions are."""
        return name_in_module(self) or super().__reduce_ex__(protocol)

    def __call__(self, points: ArrayLike, triangles: Triangles) -> Swapped:
        """Swap edges of a mesh."""
        return self.swap(points, triangles)


SwapRule = Swaps | SwapFunction


def as_swaps(rule: SwapRule) -> Swaps:
    """Return a rule with what it promises; what wraps a rule promises the same, a plain function what defaults say.

    >>> as_swaps(lambda points, triangles: Swapped(triangles, 0, True)).is_delaunay
    False
    """
    inner = rule_within(rule, Swaps)
    if inner is None:
        return Swaps(rule)
    return inner if inner is rule else replace(inner, swap=rule)
