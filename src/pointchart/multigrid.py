"""The multigrid solver: linear in time and memory."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import scipy.sparse as sp

from ._kernels.multigrid import Levels, bicgstab_pair
from .errors import SolveError
from .typing import Floats, Indices

COARSEST = 200  # unknowns that are solved for directly
TOLERANCE = 1e-12
MOST_ITERATIONS = 200


def multigrid(
    left: sp.csr_array, right: Floats, *, tolerance: float = TOLERANCE, start: Floats | None = None
) -> tuple[Floats, tuple[int, ...]]:
    """Solve by Bi-CGSTAB preconditioned with Ruge-Stueben algebraic multigrid, two right sides in one pass.

    Parameters
    ----------
    left : (n, n) sparse array
        A row-diagonally dominant M-matrix.
    right : (n, d) array
    tolerance : float
        Relative residual, of each right side.
    start : (n, d) array, optional

    Returns
    -------
    (n, d) float64 array
    tuple of int
        Iterations of each right side.

    Raises
    ------
    SolveError
        If the tolerance is not reached.

    References
    ----------
    Ruge and Stueben 1987, Algebraic multigrid.

    Examples
    --------
    >>> left = sp.csr_array([[1.0, -0.5], [0.0, 1.0]])
    >>> multigrid(left, np.array([[1.0], [2.0]]))[0].ravel()
    array([2., 2.])
    """
    n, d = right.shape
    levels = _levels(left)
    solution = np.zeros((n, d)) if start is None else np.array(start, dtype=np.float64)
    counts: list[int] = []
    for k in range(0, d, 2):
        pair, x = np.zeros((n, 2)), np.zeros((n, 2))
        width = min(2, d - k)
        pair[:, :width], x[:, :width] = right[:, k : k + width], solution[:, k : k + width]
        counts += bicgstab_pair(levels, pair, x, tolerance, MOST_ITERATIONS)[:width].tolist()
        solution[:, k : k + width] = x[:, :width]
    if min(counts) < 0:
        raise SolveError(
            f"multigrid did not reach a relative residual of {tolerance:g} in {MOST_ITERATIONS} iterations "
            f"({n} unknowns); use the direct solver"
        )
    return solution, tuple(counts)


def _levels(left: sp.csr_array) -> Levels:
    from pyamg import ruge_stuben_solver

    hierarchy = ruge_stuben_solver(sp.csr_matrix(left), max_coarse=COARSEST).levels
    matrices = [level.A.tocsr() for level in hierarchy]
    sizes = np.array([matrix.shape[0] for matrix in matrices])
    rows, indptr, indices, data = _one_after_the_other(matrices)
    p_rows, p_indptr, p_indices, p_data = _one_after_the_other([level.P.tocsr() for level in hierarchy[:-1]])
    return Levels(
        sizes=sizes,
        places=np.concatenate([[0], np.cumsum(sizes)]),
        rows=rows,
        indptr=indptr,
        indices=indices,
        data=data,
        diagonal=np.concatenate([matrix.diagonal() for matrix in matrices]),
        p_rows=p_rows,
        p_indptr=p_indptr,
        p_indices=p_indices,
        p_data=p_data,
        coarsest=np.linalg.inv(matrices[-1].toarray()),
    )


def _one_after_the_other(matrices: Iterable[Any]) -> tuple[Indices, Indices, Indices, Floats]:
    """Put the compressed rows of matrices behind each other; return the first place of each, and their arrays."""
    rows, indptr, indices, data = [0], [np.zeros(0, np.int64)], [np.zeros(0, np.int32)], [np.zeros(0)]
    for matrix in matrices:
        indptr.append(matrix.indptr.astype(np.int64) + sum(map(len, data)))
        indices.append(matrix.indices.astype(np.int32))
        data.append(matrix.data)
        rows.append(rows[-1] + len(matrix.indptr))
    return np.array(rows), np.concatenate(indptr), np.concatenate(indices), np.concatenate(data)
