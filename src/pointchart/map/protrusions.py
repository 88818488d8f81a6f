"""Maps of long protrusions, opened where they shrink below what double precision holds."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

from ..errors import PointchartError
from ..points.neighbors import Neighborhoods
from ..solve.systems import Solver, default_solver
from ..typing import UV, Floats, Loop, Points
from .convex_combination import Parameterization, parameterize, solve_map
from .weights import WeightScheme, fixed, normalize

COLLAPSED = 1e-11  # length of links in a domain of radius 1 below which rounding decides what lies where
POWERS = (2, 4, 8)  # of the stretch, one after the other: a tube of 60 radii opens with 2, one of 300 with 8


@dataclass(frozen=True, slots=True, eq=False)
class Opening:
    """A map of a series, each more open than the one before.

    Attributes
    ----------
    mapped : Parameterization
    weights : WeightScheme
        What it was made with.
    n_collapsed : int
        Points at which its links are shorter than what double precision holds.
    """

    mapped: Parameterization
    weights: WeightScheme
    n_collapsed: int


def parameterize_open(
    points: Points,
    loop: Loop,
    layout: UV,
    neighborhoods: Neighborhoods,
    *,
    weights: WeightScheme,
    solver: Solver | None = None,
) -> tuple[Parameterization, WeightScheme]:
    r"""Parameterize points, and again with other weights while a part of them collapses.

    A tube of length L and radius r shrinks like exp(-L / r), so its far end is lost in rounding. Each weight is divided
    by a power of the stretch at the neighbour,

    .. math:: w_{ij} \leftarrow w_{ij} / \sigma_j^4, \qquad
              \sigma_j^2 = \sum_k |x_k - x_j|^2 / \sum_k |u_k - u_j|^2

    which pulls every point back towards where there is room, and the system is solved again: the weights stay positive
    and convex. What has collapsed has no stretch to measure: there it goes on at the rate at which it has grown from
    the boundary up to the nearest point that has not. Of all maps that with the fewest collapsed points is kept; where
    none collapses, the first.

    Parameters
    ----------
    points, loop, layout, neighborhoods, weights, solver
        As for `parameterize`.

    Returns
    -------
    Parameterization
    WeightScheme
        What it was made with.

    References
    ----------
    Yoshizawa, Belyaev and Seidel 2004, A fast and simple stretch-minimizing mesh parameterization (there on meshes).

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.map.weights import uniform
    >>> square = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 5]])
    >>> corners = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    >>> parameterize_open(square, np.arange(4), corners, nearest(square, 4), weights=uniform)[0].uv[4]
    array([0.5, 0.5])
    """
    series = openings(points, loop, layout, neighborhoods, weights=weights, solver=solver)
    best = next(series)
    while best.n_collapsed > 0:
        more = next(series, None)
        if more is None:
            break
        best = min(best, more, key=lambda opening: opening.n_collapsed)
    return best.mapped, best.weights


def openings(
    points: Points,
    loop: Loop,
    layout: UV,
    neighborhoods: Neighborhoods,
    *,
    weights: WeightScheme,
    solver: Solver | None = None,
) -> Iterator[Opening]:
    """Map again and again, each time with twice the power of the stretch, as long as the systems can be solved.

    The parameters are those of `parameterize_open`.
    """
    first, solver = weights(points, neighborhoods), solver or default_solver(len(points))
    mapped = parameterize(points, loop, layout, neighborhoods, weights=weights, solver=solver)
    stretch = _log_stretch(points, mapped, neighborhoods)
    yield Opening(mapped, weights, _n_collapsed(stretch))
    if np.isnan(stretch).all():
        return
    stretch = _carried_on(stretch, points, loop, neighborhoods)
    # Relative to that of the row's own point, so that no exponential runs over; the sum of the row takes it away.
    growth = stretch[neighborhoods.indices] - stretch[neighborhoods.rows]
    for power in POWERS:
        opened = fixed(normalize(first * np.exp(-power * growth), neighborhoods))
        try:
            mapped = solve_map(points, loop, layout, neighborhoods, weights=opened, solver=solver)
        except PointchartError:  # the weights got out of hand: the maps before stand
            return
        yield Opening(mapped, opened, _n_collapsed(_log_stretch(points, mapped, neighborhoods)))


def _n_collapsed(stretch: Floats) -> int:
    return int(np.count_nonzero(np.isnan(stretch)))


def _log_stretch(points: Points, mapped: Parameterization, neighborhoods: Neighborhoods) -> Floats:
    """Return the logarithm of the stretch at each point, 0 without neighbours and nan where it collapses, (n,)."""
    lengths, shrunk = _link_lengths(points, neighborhoods), _link_lengths(mapped.uv, neighborhoods)
    stretch = np.where(neighborhoods.sizes > 0, np.nan, 0.0)
    holds = shrunk >= COLLAPSED
    stretch[holds] = np.log(lengths[holds] / shrunk[holds])
    return stretch


def _carried_on(stretch: Floats, points: Points, loop: Loop, neighborhoods: Neighborhoods) -> Floats:
    """Fill in stretches where the map collapses: they grow on as they have from the boundary to there, (n,)."""
    lengths = np.linalg.norm(points[neighborhoods.indices] - points[neighborhoods.rows], axis=1)
    graph = csr_matrix((lengths, neighborhoods.indices, neighborhoods.indptr), (len(points), len(points)))
    is_lost = np.isnan(stretch)
    from_loop = dijkstra(graph, directed=False, indices=loop, min_only=True)
    held = np.flatnonzero(~is_lost)
    beyond, _, last = dijkstra(graph, directed=False, indices=held, min_only=True, return_predecessors=True)
    growth = np.divide(
        stretch - np.nanmedian(stretch[loop]), from_loop, out=np.zeros(len(points)), where=from_loop > 0.0
    )
    return np.where(is_lost, stretch[last] + growth[last] * beyond, stretch)


def _link_lengths(places: Floats, neighborhoods: Neighborhoods) -> Floats:
    """Return the root of the mean square of the lengths of each point's links, (n,)."""
    squares = ((places[neighborhoods.indices] - places[neighborhoods.rows]) ** 2).sum(axis=1)
    total = np.bincount(neighborhoods.rows, squares, neighborhoods.n_points)
    return np.asarray(np.sqrt(total / np.maximum(neighborhoods.sizes, 1)))
