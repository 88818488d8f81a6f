"""Maps of long protrusions, opened where they shrink below what double precision holds."""

import numpy as np

from .errors import PointchartError
from .neighbors import Neighborhoods
from .parameterize import Parameterization, parameterize, solve_map
from .solve import Solver
from .typing import UV, Floats, Loop, Points
from .weights import WeightScheme, fixed, normalize

COLLAPSED = 1e-11  # length of links in a domain of radius 1 below which rounding decides what lies where
POWER = 2  # of the stretch: 1 opens a tube too slowly, 4 closes it again elsewhere
SOLVES = 6


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
    by the stretch at the neighbour,

    .. math:: w_{ij} \leftarrow w_{ij} / \sigma_j^2, \qquad
              \sigma_j^2 = \sum_k |x_k - x_j|^2 / \sum_k |u_k - u_j|^2

    which pulls every point back towards where there is room, and the system is solved again: the weights stay positive
    and convex. Of all maps that with the fewest collapsed points is kept; where none collapses, the first.

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
    >>> from pointchart.neighbors import nearest
    >>> from pointchart.weights import uniform
    >>> square = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 5]])
    >>> corners = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    >>> parameterize_open(square, np.arange(4), corners, nearest(square, 4), weights=uniform)[0].uv[4]
    array([0.5, 0.5])
    """
    mapped = parameterize(points, loop, layout, neighborhoods, weights=weights, solver=solver)
    lengths, shrunk = _link_lengths(points, neighborhoods), _link_lengths(mapped.uv, neighborhoods)
    fewest = np.count_nonzero(shrunk < COLLAPSED)
    best, current = (mapped, weights), weights(points, neighborhoods)
    for _ in range(SOLVES):
        if fewest == 0:
            break
        stretch = lengths / np.maximum(shrunk, COLLAPSED)
        stretch /= np.median(stretch)
        current = normalize(current / stretch[neighborhoods.indices] ** POWER, neighborhoods)
        try:
            mapped = solve_map(points, loop, layout, neighborhoods, weights=fixed(current), solver=solver)
        except PointchartError:  # the weights got out of hand: the maps before stand
            break
        shrunk = _link_lengths(mapped.uv, neighborhoods)
        collapsed = np.count_nonzero(shrunk < COLLAPSED)
        if collapsed < fewest:
            fewest, best = collapsed, (mapped, fixed(current))
    return best


def _link_lengths(places: Floats, neighborhoods: Neighborhoods) -> Floats:
    """Return the root of the mean square of the lengths of each point's links, (n,)."""
    squares = ((places[neighborhoods.indices] - places[neighborhoods.rows]) ** 2).sum(axis=1)
    total = np.bincount(neighborhoods.rows, squares, neighborhoods.n_points)
    return np.asarray(np.sqrt(total / np.maximum(neighborhoods.sizes, 1)))
