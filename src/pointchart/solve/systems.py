"""Sparse linear systems with fixed unknowns: u_i = sum_j lambda_ij u_j. Knows no geometry."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import scipy.sparse as sp

from .._kernels.solve.graphs import reduce_rows
from ..errors import SolveError, points_called
from ..typing import Floats, Indices
from .algebraic_multigrid import multigrid
from .factors import Direct, Solved

# Unknowns: a choice, as factors take time of the power 1.5 (Lipton, Rose and Tarjan 1979) and multigrid of the power 1.
DIRECT_LIMIT = 1_000_000
# Relative: more than any tolerance that is asked for, less than that of no solution at all.
WORST_RESIDUAL = 0.1

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


def default_solver(n_unknowns: int) -> Solver:
    """Choose by size: direct up to a million unknowns, multigrid above.

    >>> default_solver(10).__name__, default_solver(10**7).__name__
    ('direct', 'multigrid')
    """
    return Direct() if n_unknowns <= DIRECT_LIMIT else multigrid
