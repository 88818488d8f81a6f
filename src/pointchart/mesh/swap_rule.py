"""Rules for edge swaps: what they begin from, and what they leave."""

from collections.abc import Callable
from dataclasses import dataclass

from numpy.typing import ArrayLike

from ..typing import Triangles


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
        name = getattr(self.swap, "__name__", type(self).__name__)
        vars(self).update(__doc__=self.swap.__doc__, __name__=name, __wrapped__=self.swap)

    def __call__(self, points: ArrayLike, triangles: Triangles) -> Swapped:
        """Swap edges of a mesh."""
        return self.swap(points, triangles)


SwapRule = Swaps | SwapFunction


def as_swaps(rule: SwapRule) -> Swaps:
    """Return a rule with what it promises; a plain function goes on from the Delaunay mesh.

    >>> as_swaps(lambda points, triangles: Swapped(triangles, 0, True)).is_delaunay
    False
    """
    return rule if isinstance(rule, Swaps) else Swaps(rule)
