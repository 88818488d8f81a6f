"""Plain Krylov methods, as the paper uses them: each right side on its own, on one thread."""

from collections.abc import Callable
from threading import Lock
from typing import Any

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla
from threadpoolctl import threadpool_limits

from ..errors import SolveError
from ..typing import Floats
from .algebraic_multigrid import TOLERANCE
from .factors import Solved
from .symmetric_form import symmetrize

MOST_ITERATIONS = 20_000  # of plain Krylov methods: they end somewhere, and say so
ONE_THREAD = Lock()  # the limit on threads holds for the whole process, so solves take turns


def bicgstab(left: sp.csr_array, right: Floats, *, tolerance: float = TOLERANCE, start: Floats | None = None) -> Solved:
    """Solve by plain Bi-CGSTAB, each right side on its own, as the paper does."""
    return _krylov(sla.bicgstab, left, right, tolerance, None, start)


def conjugate_gradient(left: sp.csr_array, right: Floats, *, tolerance: float = TOLERANCE) -> Solved:
    """Solve the symmetric case (4.5) by conjugate gradients on the row-scaled matrix."""
    symmetric, scale = symmetrize(left)
    diagonal = symmetric.diagonal()
    jacobi = sla.LinearOperator(symmetric.shape, matvec=lambda x: x / diagonal, dtype=np.float64)
    return _krylov(sla.cg, symmetric, scale[:, None] * right, tolerance, jacobi, None)


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
