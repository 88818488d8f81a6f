"""The multigrid solver: linear in time and memory."""

import numpy as np
import scipy.sparse as sp

from .._kernels.solve.cycles import (
    BLOCK,
    advance,
    find_rest,
    multiply,
    prolong,
    redirect,
    restrict,
    sweep_backward,
    sweep_forward,
)
from .._kernels.unsigned import unsigned
from .._parallel import Team
from ..errors import SolveError
from ..typing import Floats, Indices, Mask
from .hierarchy import Hierarchy, Singles, coarsened

TOLERANCE = 1e-12  # relative residual, some digits over rounding
SLACK = 10.0  # of the true residual over the tolerance: that of the iteration drifts from it
ROUNDS = 2  # of iterations, each from the true residual of the one before
MOST_ITERATIONS = 200  # of a round, a cap: five real scans take 4 to 10 to 1e-6 and 8 to 21 to 1e-12


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
        If ten times the tolerance is not reached, or the matrix is none that can be coarsened.

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
    if d == 0:
        return np.zeros((n, 0)), ()
    hierarchy = coarsened(left)
    with np.errstate(over="ignore"):
        counts, sizes = np.zeros(d, np.int64), np.linalg.norm(right, axis=0)
    if not np.isfinite(sizes).all():
        raise SolveError(f"the right sides have norms {sizes.tolist()}; give finite ones, scaled down if they are huge")
    solution = np.zeros((n, d)) if start is None else np.where(sizes > 0.0, start, 0.0)
    rest = np.asarray(right, np.float64) if start is None else right - left @ solution
    for _ in range(ROUNDS):
        with Team() as team:
            for k in range(0, d, 2):
                # A last column without a partner is solved for twice.
                pair = slice(k, k + 2) if k + 1 < d else [k, k]
                gain, found = _bicgstab(left, hierarchy, rest[:, pair], tolerance * sizes[pair], team)
                solution[:, pair] += gain
                counts[k : k + 2] += found[: d - k]
        rest = right - left @ solution
        if not np.isfinite(rest).all():
            break
        if (np.linalg.norm(rest, axis=0) <= SLACK * tolerance * sizes).all():
            return solution, tuple(counts.tolist())
    raise SolveError(
        f"multigrid did not reach a relative residual of {tolerance:g} in {counts.max()} iterations "
        f"({n} unknowns); use the direct solver"
    )


def _bicgstab(
    left: sp.csr_array, hierarchy: Hierarchy, right: Floats, tolerances: Floats, team: Team
) -> tuple[Floats, Indices]:
    """Solve for two right sides to absolute tolerances, as far as it goes; return the iterations of each.

    van der Vorst 1992, preconditioned from the right; a column that has converged is left alone.
    """
    n, rows, counts = (
        len(right),
        (unsigned(left.indptr), unsigned(left.indices), left.data),
        np.full(2, MOST_ITERATIONS),
    )
    # Powers of two, so that single precision will do for right sides of any size.
    unit = np.ldexp(1.0, np.frexp(np.linalg.norm(right, axis=0))[1])
    small, rest, x = (tolerances / unit) ** 2, np.ascontiguousarray(right / unit), np.zeros((n, 2))
    shadow, direction, across, along = rest.copy(), rest.copy(), np.empty((n, 2)), np.empty((n, 2))
    sums = np.zeros((-(-n // BLOCK), 4))
    rho = size = (rest * rest).sum(axis=0)
    for step in range(MOST_ITERATIONS):
        counts = np.where(size <= small, np.minimum(counts, step), counts)
        is_open = counts > step
        if not is_open.any() or not np.isfinite(size).all():
            break
        guess = _cycle(hierarchy, direction, team)
        team(n, BLOCK, multiply, *rows, guess, across, shadow, sums)
        alpha = _quotients(rho, sums.sum(axis=0)[:2], is_open)
        team(n, BLOCK, advance, x, rest, alpha, guess, across, shadow, sums)
        guess = _cycle(hierarchy, rest, team)
        team(n, BLOCK, multiply, *rows, guess, along, rest, sums)
        product, size = np.split(sums.sum(axis=0), 2)
        omega = _quotients(product, size, is_open)
        team(n, BLOCK, advance, x, rest, omega, guess, along, shadow, sums)
        before = rho
        rho, size = np.split(sums.sum(axis=0), 2)
        beta = _quotients(rho * alpha, before * omega, is_open)
        team(n, BLOCK, redirect, direction, rest, across, beta, omega)
    return x * unit, counts


def _quotients(a: Floats, b: Floats, is_open: Mask) -> Floats:
    """Divide; 0 for columns that are solved, or by 0."""
    return np.divide(a, b, out=np.zeros(2), where=is_open & (b != 0.0))


def _cycle(hierarchy: Hierarchy, known: Floats, team: Team) -> Singles:
    """Solve roughly by one V-cycle: a sweep forwards on the way down, from zero, one backwards on the way up."""
    levels, vectors = hierarchy.levels, hierarchy.vectors
    vectors[0].known[:] = known
    for level, here, below in zip(levels, vectors, vectors[1:], strict=False):
        n, n_coarse = len(here.known), len(below.known)
        team(n, BLOCK, sweep_forward, *level.rows, here.known, here.found)
        team(n, BLOCK, find_rest, *level.rows[:4], here.found, here.rest)
        team(n_coarse, BLOCK, restrict, *level.restriction, here.rest, below.known)
    vectors[-1].better[:] = hierarchy.coarsest @ vectors[-1].known
    for level, here, below in zip(levels[::-1], vectors[-2::-1], vectors[:0:-1], strict=True):
        n = len(here.known)
        team(n, BLOCK, prolong, *level.prolongation, below.better, here.found)
        team(n, BLOCK, sweep_backward, *level.rows, here.known, here.found, here.better)
    return vectors[0].better
