"""Sparse linear systems with fixed unknowns: u_i = sum_j lambda_ij u_j. Knows no geometry."""

from collections.abc import Callable
from dataclasses import dataclass
from threading import Lock
from typing import Any, TypeAlias

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla
from threadpoolctl import threadpool_limits

from .._kernels.solve.graphs import reduce_rows, symmetrizer
from ..errors import SolveError, points_called
from ..typing import Floats, Indices
from .algebraic_multigrid import TOLERANCE, multigrid

MOST_ITERATIONS = 20_000  # of plain Krylov methods: they end somewhere, and say so
# Unknowns: a choice, as factors take time of the power 1.5 (Lipton, Rose and Tarjan 1979) and multigrid of the power 1.
DIRECT_LIMIT = 1_000_000
# Relative: more than any tolerance that is asked for, less than that of no solution at all.
WORST_RESIDUAL = 0.1
ONE_THREAD = Lock()  # the limit on threads holds for the whole process, so solves take turns
SMALL = 100  # unknowns that need no order of elimination: their factors are small in any
ROUNDING = 1e-14  # relative residual over which a direct solution is refined

Solved: TypeAlias = tuple[Floats, tuple[int, ...]]
Solver: TypeAlias = Callable[[sp.csr_array, Floats], Solved]


@dataclass(frozen=True, slots=True, eq=False)
class Solution:
    """What solved a system, and how well.

    Attributes
    ----------
    values : (n, d) float64
        All unknowns, the fixed ones as given.
    residual : float
        Largest of ``|b - A u| / |b|`` over the d right sides, 2-norms.
    iterations : tuple of int
        Of each right side; empty for a direct solver.
    method : str
        Name of the solver.
    unknowns, nonzeros : int
        Size of the system.
    """

    values: Floats
    residual: float
    iterations: tuple[int, ...]
    method: str
    unknowns: int
    nonzeros: int


def solve_fixed(matrix: sp.csr_array, fixed: Indices, values: Floats, *, solver: Solver | None = None) -> Solution:
    r"""Solve :math:`u = \Lambda u` for the unknowns that are not fixed.

    Parameters
    ----------
    matrix : (n, n) sparse array
        Convex combinations: rows non-negative with sum one, zero diagonal. Rows of fixed unknowns are not used.
    fixed : (b,) int array
        Unknowns that are given.
    values : (b, d) array
        Their values, one column a right side.
    solver : callable, optional
        ``solver(A, b) -> (x, iterations)``: `direct`, `multigrid`, `bicgstab`, `conjugate_gradient`, `cholesky` or one
        of your own; chosen by size, if not given.

    Returns
    -------
    Solution

    Raises
    ------
    SolveError
        If the solver breaks down or misses its tolerance.

    References
    ----------
    Floater and Reimers 2001, section 2, equations (2.1) and (2.2).

    Examples
    --------
    >>> import scipy.sparse as sp
    >>> halves = sp.csr_array([[0, 0, 0], [0.5, 0, 0.5], [0, 0, 0]])
    >>> solve_fixed(halves, [0, 2], [[0.0], [4.0]]).values.ravel()
    array([0., 2., 4.])
    """
    fixed, given = np.asarray(fixed), np.asarray(values, dtype=np.float64)
    is_free = np.ones(matrix.shape[0], dtype=bool)
    is_free[fixed] = False
    free = np.flatnonzero(is_free)
    full = np.zeros((matrix.shape[0], given.shape[1]))
    full[fixed] = given
    if len(free) == 0:
        return Solution(full, 0.0, (), "none", 0, 0)
    left, right = _reduced(matrix, free, full)
    del matrix  # large, and of no more use
    chosen = solver or default_solver(len(free))
    # Numbers that run over are found out by the residual.
    with points_called(free), np.errstate(over="ignore", invalid="ignore"):
        solution, iterations = chosen(left, right)
        size = np.linalg.norm(right, axis=0)
        residual = float(np.max(np.linalg.norm(right - left @ solution, axis=0) / np.where(size > 0.0, size, 1.0)))
    if not np.isfinite(residual):
        raise SolveError(f"{_name(chosen)} gave no finite solution of {len(free)} unknowns; try another solver")
    if residual > WORST_RESIDUAL:
        raise SolveError(
            f"{_name(chosen)} left a relative residual of {residual:.2g} in {len(free)} unknowns, so it did not "
            "solve the system; use the direct solver"
        )
    full[free] = solution
    return Solution(full, residual, iterations, _name(chosen), len(free), left.nnz)


def _reduced(matrix: sp.csr_array, free: Indices, full: Floats) -> tuple[sp.csr_array, Floats]:
    """Return the system of the free unknowns, with the fixed ones on the right side."""
    number = np.full(len(full), -1, np.int32)
    number[free] = np.arange(len(free), dtype=np.int32)
    indptr, right = np.empty(len(free) + 1, np.int32), np.zeros((len(free), full.shape[1]))
    indices, data = np.empty(matrix.nnz + len(free), np.int32), np.empty(matrix.nnz + len(free))
    size = reduce_rows(matrix.indptr, matrix.indices, matrix.data, free, number, full, indptr, indices, data, right)
    left = sp.csr_array((data[:size], indices[:size], indptr), shape=(len(free), len(free)))
    return left, right


def _name(solver: Solver) -> str:
    """Return the name of a solver, whose options `functools.partial` may have bound."""
    return str(getattr(getattr(solver, "func", solver), "__name__", type(solver).__name__))


class Direct:
    """Solve by LU without pivoting, ordered by nested dissection, refined once if rounding shows.

    The matrix is a diagonally dominant M-matrix, which needs no pivoting. The order of elimination is kept, and
    serves again for later systems of the same size: systems on the same points have nearly the same graph, and any
    order is right.
    """

    __name__ = "direct"

    def __init__(self) -> None:
        self._order: Indices | None = None

    def __call__(self, left: sp.csr_array, right: Floats) -> Solved:
        """Solve ``left @ x = right``."""
        if self._order is None or len(self._order) != left.shape[0]:
            self._order = nested_dissection(left)
        factors = _factorize(left, self._order)
        solution = np.empty_like(right)
        solution[self._order] = factors.solve(right[self._order])
        defect = right - left @ solution
        if np.linalg.norm(defect) > ROUNDING * np.linalg.norm(right):
            solution[self._order] += factors.solve(defect[self._order])
        return solution, ()


def default_solver(n_unknowns: int) -> Solver:
    """Choose by size: direct up to a million unknowns, multigrid above.

    >>> default_solver(10).__name__, default_solver(10**7).__name__
    ('direct', 'multigrid')
    """
    return Direct() if n_unknowns <= DIRECT_LIMIT else multigrid


def direct(left: sp.csr_array, right: Floats) -> Solved:
    """Solve one system by LU without pivoting; see `Direct`."""
    return Direct()(left, right)


def cholesky(left: sp.csr_array, right: Floats) -> Solved:
    """Solve the symmetric case (4.5) by factors of the row-scaled matrix, all pivots positive.

    SuperLU in symmetric mode without pivoting: U is D L^T, so the factors are Cholesky's but for the scaling.
    """
    symmetric, scale = symmetrize(left)
    order = nested_dissection(symmetric)
    factors = _factorize(symmetric, order)
    if not np.all(factors.U.diagonal() > 0.0):
        raise SolveError("the scaled matrix is not positive definite; use the direct solver")
    solution = np.empty_like(right)
    solution[order] = factors.solve((scale[:, None] * right)[order])
    return solution, ()


def bicgstab(left: sp.csr_array, right: Floats, *, tolerance: float = TOLERANCE, start: Floats | None = None) -> Solved:
    """Solve by plain Bi-CGSTAB, each right side on its own, as the paper does."""
    return _krylov(sla.bicgstab, left, right, tolerance, None, start)


def conjugate_gradient(left: sp.csr_array, right: Floats, *, tolerance: float = TOLERANCE) -> Solved:
    """Solve the symmetric case (4.5) by conjugate gradients on the row-scaled matrix."""
    symmetric, scale = symmetrize(left)
    diagonal = symmetric.diagonal()
    jacobi = sla.LinearOperator(symmetric.shape, matvec=lambda x: x / diagonal, dtype=np.float64)
    return _krylov(sla.cg, symmetric, scale[:, None] * right, tolerance, jacobi, None)


def symmetrize(left: sp.csr_array) -> tuple[sp.csr_array, Floats]:
    """Scale the rows of a matrix so that it becomes symmetric, as condition (4.5) allows.

    Raises
    ------
    SolveError
        If no scaling does: some neighbour is not one in return, or the weights of a pair do not come from one number.

    Examples
    --------
    >>> import scipy.sparse as sp
    >>> symmetrize(sp.csr_array([[1, -0.5], [-0.25, 1]]))[0].toarray()
    array([[ 1. , -0.5],
           [-0.5,  2. ]])
    """
    n = left.shape[0]
    scale = np.zeros(n)
    for seed in _component_seeds(left):
        order, parent = sp.csgraph.breadth_first_order(left, seed, directed=False)
        odd = symmetrizer(order, parent, left.indptr, left.indices, left.data, scale)
        if odd >= 0:
            raise SolveError(
                "points {one} and {other} are not neighbours of each other, so the matrix has no symmetric form "
                "(4.5); use balls of constant radius or another solver",
                one=odd,
                other=parent[odd],
            )
    symmetric = sp.csr_array(sp.diags_array(scale) @ left)
    skew = (abs(symmetric - symmetric.T) - 1e-9 * (abs(symmetric) + abs(symmetric.T))).tocoo()
    worst = int(np.argmax(skew.data)) if skew.nnz else -1
    if worst >= 0 and skew.data[worst] > 0.0:
        raise SolveError(
            "the weights have no symmetric form (4.5): those of points {pair} for each other "
            f"differ by {skew.data[worst]:.2g} after scaling; use another solver",
            pair=[skew.row[worst], skew.col[worst]],
        )
    return symmetric, scale


def _component_seeds(left: sp.csr_array) -> Indices:
    labels = sp.csgraph.connected_components(left, directed=False)[1]
    return np.asarray(np.unique(labels, return_index=True)[1])


def nested_dissection(left: sp.csr_array) -> Indices:
    """Order unknowns for elimination by METIS, from the graph of the matrix and its transpose."""
    import pymetis

    n = left.shape[0]
    if n <= SMALL:
        return np.arange(n)
    pattern = sp.csr_array((np.ones(left.nnz, np.int8), left.indices, left.indptr), shape=left.shape)
    pattern = (pattern + pattern.T).tocoo()
    off = pattern.row != pattern.col
    graph = sp.csr_array((pattern.data[off], (pattern.row[off], pattern.col[off])), shape=left.shape)
    return np.asarray(pymetis.nested_dissection(pymetis.CSRAdjacency(graph.indptr, graph.indices))[0], dtype=np.int64)


def _factorize(left: sp.csr_array, order: Indices) -> Any:
    ordered = sp.csc_matrix(left[order][:, order])
    try:
        # Supernodes of these graphs are small: narrow panels take a fifth less time than SuperLU's own width.
        return sla.splu(
            ordered,
            permc_spec="NATURAL",
            diag_pivot_thresh=0.0,
            relax=4,
            panel_size=1,
            options={"SymmetricMode": True},
        )
    except RuntimeError as failure:
        raise SolveError(
            f"the factorization of {left.shape[0]} unknowns failed ({failure}); use a larger neighbourhood"
        ) from failure


def _krylov(
    method: Callable[..., tuple[Floats, int]],
    left: sp.csr_array,
    right: Floats,
    tolerance: float,
    preconditioner: Any,
    start: Floats | None,
) -> Solved:
    columns, counts = [], []
    for k in range(right.shape[1]):
        steps: list[None] = []
        # Vectors are too short for threads to pay, and waiting for a busy core costs twenty times the work.
        with ONE_THREAD, threadpool_limits(1):
            column, flag = method(
                left,
                right[:, k],
                x0=None if start is None else start[:, k],
                rtol=tolerance,
                atol=0.0,
                maxiter=MOST_ITERATIONS,
                M=preconditioner,
                callback=lambda _, steps=steps: steps.append(None),
            )
        if flag != 0:
            raise SolveError(
                f"{method.__name__} did not reach a relative residual of {tolerance:g} in "
                f"{len(steps)} iterations ({len(right)} unknowns); use the direct solver"
            )
        columns.append(column)
        counts.append(len(steps))
    return np.column_stack(columns), tuple(counts)
