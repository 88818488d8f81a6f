"""The multigrid solver: linear in time and memory."""

from collections import defaultdict
from threading import get_ident
from typing import NamedTuple, TypeAlias

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from ._kernels.coarsen import (
    choose_coarse,
    galerkin_rows,
    interpolate,
    mark_strong,
    most_entries,
    reverse_strong,
    split_rows,
    transpose,
)
from ._kernels.multigrid import (
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
from ._kernels.unsigned import unsigned
from ._parallel import Team, over_ranges
from .errors import SolveError
from .typing import Floats, Indices, Mask

COARSEST = 200  # unknowns that are solved for directly
LARGEST = 3000  # the same, where coarsening comes to an end before, as on many parts
TOLERANCE = 1e-12
SLACK = 10.0  # of the true residual over the tolerance: that of the iteration drifts from it
ROUNDS = 2  # of iterations, each from the true residual of the one before
MOST_ITERATIONS = 200  # of a round

Singles: TypeAlias = NDArray[np.float32]


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
    hierarchy = _coarsened(left)
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


class _Matrix(NamedTuple):
    """Sorted rows without the diagonal; `middle` is the place of the first column over it."""

    indptr: Indices
    middle: Indices
    indices: Indices
    data: Floats
    diagonal: Floats


class _Transfer(NamedTuple):
    """Compressed rows: the interpolation of a level from the next, or its transpose."""

    indptr: Indices
    indices: Indices
    data: Floats


class _Vectors(NamedTuple):
    """Of a level: right side, what a sweep finds, what the next one makes of it, what is left of the right side."""

    known: Singles
    found: Singles
    better: Singles
    rest: Singles


class _Level(NamedTuple):
    """A matrix as the sweeps take it, and the ways from and to the next level."""

    rows: tuple[Indices, Indices, Indices, Singles, Singles]
    prolongation: _Transfer
    restriction: _Transfer


class _Hierarchy(NamedTuple):
    """What preconditions a matrix: levels and vectors in single precision, the inverse of the coarsest matrix."""

    levels: list[_Level]
    coarsest: Floats
    vectors: list[_Vectors]


def _bicgstab(
    left: sp.csr_array, hierarchy: _Hierarchy, right: Floats, tolerances: Floats, team: Team
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


def _cycle(hierarchy: _Hierarchy, known: Floats, team: Team) -> Singles:
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


def _coarsened(left: sp.csr_array) -> _Hierarchy:
    """Coarsen until few unknowns are left."""
    matrix, levels, vectors = _split(left), [], []
    while True:
        n = len(matrix.diagonal)
        vectors.append(_Vectors(*(np.empty((n, 2), np.float32) for _ in range(4))))
        if n <= COARSEST:
            break
        prolongation, n_coarse = _interpolation(matrix)
        if n_coarse in (0, n):
            break
        restriction = _transposed(prolongation, n_coarse)
        levels.append(_Level(_in_singles(matrix), *map(_light, (prolongation, restriction))))
        matrix = _product(matrix, prolongation, restriction)
    if n > LARGEST:
        raise SolveError(
            f"multigrid found no coarse system for {left.shape[0]} unknowns, as if they were in many parts; "
            "use the direct solver"
        )
    return _Hierarchy(levels, _inverse(matrix), vectors)


def _in_singles(matrix: _Matrix) -> tuple[Indices, Indices, Indices, Singles, Singles]:
    indptr, middle, indices = map(unsigned, matrix[:3])
    return indptr, middle, indices, matrix.data.astype(np.float32), (1.0 / matrix.diagonal).astype(np.float32)


def _light(transfer: _Transfer) -> _Transfer:
    """Give a way between levels in single precision, and no more room than it takes."""
    return _Transfer(unsigned(transfer.indptr), unsigned(transfer.indices.copy()), transfer.data.astype(np.float32))


def _split(left: sp.csr_array) -> _Matrix:
    n = left.shape[0]
    if not (left.diagonal() > 0.0).all():
        raise SolveError("multigrid needs a matrix with a positive diagonal; use the direct solver")
    indptr, middle, diagonal = np.empty(n + 1, np.int64), np.empty(n, np.int64), np.empty(n)
    matrix = _Matrix(indptr, middle, np.empty(left.nnz, np.int32), np.empty(left.nnz), diagonal)
    size = split_rows(left.indptr, left.indices, left.data, *matrix)
    return matrix._replace(indices=matrix.indices[:size], data=matrix.data[:size])


def _interpolation(matrix: _Matrix) -> tuple[_Transfer, int]:
    """Choose the points of the next level, and interpolate from them; return how many there are."""
    n, nnz = len(matrix.diagonal), len(matrix.data)
    strong, first, origins = np.empty(nnz, np.bool_), np.empty(n + 1, np.int64), np.empty(nnz, np.int32)
    mark_strong(matrix.indptr, matrix.data, strong)
    reverse_strong(matrix.indptr, matrix.indices, strong, first, origins)
    coarse = np.empty(n, np.int32)
    rows = unsigned(matrix.indptr), unsigned(matrix.indices)
    count = choose_coarse(*rows, unsigned(first), unsigned(origins), strong, coarse)
    indptr, indices, data = np.empty(n + 1, np.int64), np.empty(nnz + n, np.int32), np.empty(nnz + n)
    size = interpolate(
        matrix.indptr, matrix.indices, matrix.data, matrix.diagonal, strong, coarse, indptr, indices, data
    )
    return _Transfer(indptr, indices[:size], data[:size]), int(count)


def _transposed(prolongation: _Transfer, n_coarse: int) -> _Transfer:
    size = len(prolongation.data)
    restriction = _Transfer(np.empty(n_coarse + 1, np.int64), np.empty(size, np.int32), np.empty(size))
    transpose(*prolongation, *restriction)
    return restriction


def _product(matrix: _Matrix, prolongation: _Transfer, restriction: _Transfer) -> _Matrix:
    """Return the matrix of the next level, the product of restriction, matrix and interpolation."""
    n_coarse = len(restriction.indptr) - 1
    # Plain tuples: code compiled for named ones would hang on a class of this module.
    along, back = ((unsigned(way.indptr), unsigned(way.indices), way.data) for way in (prolongation, restriction))
    fine = unsigned(matrix.indptr), unsigned(matrix.indices), matrix.data, matrix.diagonal
    sizes, middle, diagonal = np.empty(n_coarse, np.int64), np.empty(n_coarse, np.int64), np.empty(n_coarse)
    marks: defaultdict[int, Indices] = defaultdict(lambda: np.full(n_coarse, -1, np.int32))  # one a thread
    parts: dict[int, tuple[Indices, Floats]] = {}

    def multiply(first: int, last: int) -> None:
        room = most_entries(fine[0], along[0], fine[1], *back[:2], first, last)
        columns, values, mark = np.empty(room, np.int32), np.empty(room), marks[get_ident()]
        count = galerkin_rows(fine, along, back, first, last, mark, sizes, middle, diagonal, columns, values)
        parts[first] = columns[:count].copy(), values[:count].copy()

    over_ranges(multiply, n_coarse)
    indices, data = (np.concatenate([parts[first][k] for first in sorted(parts)]) for k in range(2))
    indptr = np.concatenate([[0], np.cumsum(sizes)])
    return _Matrix(indptr, indptr[:-1] + middle, indices, data, diagonal)


def _inverse(matrix: _Matrix) -> Floats:
    n = len(matrix.diagonal)
    dense = sp.csr_array((matrix.data, matrix.indices, matrix.indptr), shape=(n, n)).toarray()
    try:
        return np.asarray(np.linalg.inv(dense + np.diag(matrix.diagonal)))
    except np.linalg.LinAlgError as reason:
        raise SolveError(f"the matrix is singular ({reason}); some unknowns hang on no fixed one") from reason
