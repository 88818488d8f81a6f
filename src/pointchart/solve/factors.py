"""Direct solvers: factors without pivoting, in an order of elimination by nested dissection."""

from typing import Any, TypeAlias

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

from ..errors import SolveError
from ..typing import Floats, Indices
from .symmetric_form import symmetrize

SMALL = 100  # unknowns that need no order of elimination: their factors are small in any
ROUNDING = 1e-14  # relative residual over which a direct solution is refined

Solved: TypeAlias = tuple[Floats, tuple[int, ...]]


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
