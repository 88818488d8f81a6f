"""Meshless parameterization: points, boundary, neighbourhoods and weights to planar parameters."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike

from .._check import check_convex, check_loop, check_neighbors, check_points
from .._kernels.solve.graphs import dominators
from ..errors import InputError, SolveError
from ..points.neighbors import Neighborhoods
from ..solve.systems import Solution, Solver, solve_fixed
from ..typing import UV, Indices, Loop, Points
from .weights import WeightScheme, mean_value


@dataclass(frozen=True, slots=True, eq=False)
class Parameterization:
    """Planar parameters of a point set.

    Attributes
    ----------
    uv : (n, 2) float64
        Parameters, dimensionless; boundary points as they were laid out.
    loop : (b,) int64
        The boundary.
    solution : Solution
        The evidence: residual, iterations and size of the system.
    """

    uv: UV
    loop: Loop
    solution: Solution


def parameterize(
    points: ArrayLike,
    loop: ArrayLike,
    boundary_uv: ArrayLike,
    neighborhoods: Neighborhoods,
    *,
    weights: WeightScheme = mean_value,
    solver: Solver | None = None,
) -> Parameterization:
    r"""Map points to the plane: each interior point to a convex combination of its neighbours.

    .. math:: u_i = \sum_{j \in N_i} \lambda_{ij} u_j

    The system has one solution when a path leads from every interior point to the boundary (Proposition 3.3), and it
    keeps every point in the hull of the boundary points that it reaches (Proposition 3.1).

    Parameters
    ----------
    points : (n, 3) array
        Distinct points.
    loop : (b,) int array
        Boundary points in order.
    boundary_uv : (b, 2) array
        Where the boundary points go: in order around a convex domain.
    neighborhoods : Neighborhoods
        Those of boundary points are not used.
    weights : callable
        ``weights(points, neighborhoods) -> (nnz,)``: positive, summing to one over each neighbourhood.
    solver : callable, optional
        See `solve_fixed`.

    Returns
    -------
    Parameterization

    Raises
    ------
    InputError
        If interior points have no path to the boundary, or hang on a single point, into which they would collapse; or
        if the weights are no convex combination.
    SolveError
        If the solver fails.

    References
    ----------
    Floater and Reimers 2001, sections 2 and 3.

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> square = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 5]]
    >>> corners = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> from pointchart.map.weights import uniform
    >>> parameterize(square, [0, 1, 2, 3], corners, nearest(square, 4), weights=uniform).uv[4]
    array([0.5, 0.5])
    """
    cloud = check_points(points)
    rim = check_loop(loop, len(cloud))
    layout = check_convex(boundary_uv)
    if layout.shape != (len(rim), 2):
        raise InputError(f"boundary_uv has shape {layout.shape}; the loop of {len(rim)} points needs ({len(rim)}, 2)")
    check_neighbors(neighborhoods.indices, neighborhoods.n_points, len(cloud))
    check_connected(neighborhoods, rim)
    return solve_map(cloud, rim, layout, neighborhoods, weights=weights, solver=solver)


def solve_map(
    cloud: Points, rim: Loop, layout: UV, neighborhoods: Neighborhoods, *, weights: WeightScheme, solver: Solver | None
) -> Parameterization:
    """Parameterize points whose neighbourhoods are known to be connected to the boundary; see `parameterize`."""
    matrix = _convex_matrix(weights(cloud, neighborhoods), neighborhoods, rim)
    solution = solve_fixed(matrix, rim, layout, solver=solver)
    return Parameterization(_inside(solution.values, layout), rim, solution)


def check_connected(neighborhoods: Neighborhoods, loop: Loop) -> None:
    """Check that every interior point reaches the boundary, by paths that do not all pass one and the same point.

    Raises
    ------
    InputError
        Naming the points that have no path (Proposition 3.3), or hang on one point (they collapse into it, by
        Proposition 3.1).
    """
    hanging_on = cut_points(neighborhoods, loop)
    median = int(np.median(neighborhoods.sizes))
    lost = np.flatnonzero(hanging_on == -2)
    if len(lost):
        raise InputError(
            "interior points {lost} have no path to the boundary, so their position is undetermined; use a "
            f"larger neighbourhood (its median size is {median}), or remove them",
            lost=lost,
        )
    hanging = np.flatnonzero(hanging_on >= 0)
    if len(hanging):
        raise InputError(
            "interior points {hanging} reach the boundary only through point {through}, into which they would "
            f"collapse; use a larger neighbourhood (its median size is {median}), or remove them",
            hanging=hanging,
            through=hanging_on[hanging[0]],
        )


def cut_points(neighborhoods: Neighborhoods, loop: Loop) -> Indices:
    """Find the single point, if there is one, that all paths from each interior point to the boundary pass.

    Returns
    -------
    (n,) int64 array: that point (the one nearest along the paths); -1 where there is none; -2 where there is no path.

    Examples
    --------
    >>> import numpy as np
    >>> chain = Neighborhoods(np.array([0, 0, 1, 2]), np.array([0, 1]))
    >>> cut_points(chain, np.array([0]))
    array([-1,  0,  1])
    """
    n, root = neighborhoods.n_points, neighborhoods.n_points
    is_inner = np.ones(n, bool)
    is_inner[loop] = False
    kept = np.repeat(is_inner, neighborhoods.sizes)
    rows, columns = neighborhoods.rows[kept], neighborhoods.indices[kept]
    # All boundary points lead to one root: who hangs on that alone hangs on no single point.
    rows = np.concatenate([rows, loop])
    columns = np.concatenate([columns, np.full(len(loop), root)])
    graph = sp.csr_array((np.ones(len(rows), np.int8), (rows, columns)), shape=(n + 1, n + 1))
    order = sp.csgraph.breadth_first_order(graph.T.tocsr(), root, return_predecessors=False).astype(np.int64)
    rank = np.full(n + 1, -1, np.int64)
    rank[order] = np.arange(len(order))
    dominator = np.full(n + 1, -1, np.int64)
    dominator[root] = root
    dominators(order, graph.indptr.astype(np.int64), graph.indices.astype(np.int64), root, rank, dominator)
    found = dominator[:n]
    return np.where(rank[:n] < 0, -2, np.where(found == root, -1, found))


def _convex_matrix(weights: ArrayLike, neighborhoods: Neighborhoods, loop: Loop) -> sp.csr_array:
    values, n = np.asarray(weights, dtype=np.float64), neighborhoods.n_points
    if values.shape != neighborhoods.indices.shape:
        raise InputError(
            f"the weights have shape {values.shape}; the neighbourhoods have {len(neighborhoods.indices)} entries"
        )
    sums = np.bincount(neighborhoods.rows, values, n)
    sums[loop] = 1.0  # rows of boundary points are not used, so they may hold anything
    is_inner = np.ones(n, bool)
    is_inner[loop] = False
    negative = np.flatnonzero(~(values > 0.0) & is_inner[neighborhoods.rows])
    if len(negative) or not np.all(np.abs(sums - 1.0) < 1e-9):
        culprit = neighborhoods.rows[negative[0]] if len(negative) else int(np.argmax(np.abs(sums - 1.0)))
        raise InputError(
            f"the weights at point {{culprit}} are no convex combination (smallest {values.min():.3g}, sum "
            f"{sums[culprit]:.6g}); they have to be positive and to sum to one",
            culprit=culprit,
        )
    return sp.csr_array((values, neighborhoods.indices, neighborhoods.indptr), shape=(n, n))


def _inside(uv: UV, layout: UV) -> UV:
    """Check Proposition 3.1: no point lies outside the convex hull of the boundary, but for rounding."""
    center = layout.mean(axis=0)
    direction = np.arctan2(*(layout - center).T[::-1])
    corners = layout[np.argsort(direction, kind="stable")]
    # Each point lies in the sector of one side, seen from the middle: it has to be on the inner hand of that side.
    sector = np.searchsorted(np.sort(direction), np.arctan2(*(uv - center).T[::-1]), side="right") - 1
    start, end = corners[sector], corners[(sector + 1) % len(corners)]
    cross = (end[:, 0] - start[:, 0]) * (uv[:, 1] - start[:, 1]) - (end[:, 1] - start[:, 1]) * (uv[:, 0] - start[:, 0])
    outside = np.flatnonzero(cross < -1e-9 * np.ptp(layout, axis=0).max() * np.linalg.norm(end - start, axis=1))
    if len(outside):
        raise SolveError(
            "points {outside} were mapped outside the domain, so the system was not solved well enough; use the direct "
            "solver or a smaller tolerance",
            outside=outside,
        )
    return uv
