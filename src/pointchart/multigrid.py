"""The multigrid solver: linear in time and memory."""

from typing import Any, NamedTuple

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
from ._kernels.multigrid import Levels, bicgstab_pair
from ._parallel import over_ranges
from .errors import SolveError
from .typing import Floats, Indices

COARSEST = 200  # unknowns that are solved for directly
LARGEST = 3000  # the same, where coarsening comes to an end before, as on many parts
ROOM = 4  # times the entries of the first level; all levels have about 1.6 times as many
TOLERANCE = 1e-12
SLACK = 10.0  # of the true residual over the tolerance: that of the iteration drifts from it
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
    if d == 0:
        return np.zeros((n, 0)), ()
    levels = _levels(left)
    counts: list[int] = []
    solution = np.zeros((n, d)) if start is None else np.array(start, dtype=np.float64)
    for k in range(0, d, 2):
        # A last column without a partner is solved for twice.
        pair = [k, min(k + 1, d - 1)]
        known, x = np.ascontiguousarray(right[:, pair], dtype=np.float64), np.ascontiguousarray(solution[:, pair])
        found = bicgstab_pair(left.indptr, left.indices, left.data, levels, known, x, tolerance, MOST_ITERATIONS)
        counts += found[: d - k].tolist()
        solution[:, pair] = x
    missed = np.linalg.norm(right - left @ solution, axis=0) > SLACK * tolerance * np.linalg.norm(right, axis=0)
    if min(counts) < 0 or missed.any():
        raise SolveError(
            f"multigrid did not reach a relative residual of {tolerance:g} in {MOST_ITERATIONS} iterations "
            f"({n} unknowns); use the direct solver"
        )
    return solution, tuple(counts)


class _Matrix(NamedTuple):
    """Sorted rows without the diagonal; `middle` is the place of the first column over it."""

    indptr: Indices
    middle: Indices
    indices: Indices
    data: Floats
    diagonal: Floats


class _Prolongation(NamedTuple):
    """Compressed rows: the interpolation of a level from the next, or its transpose."""

    indptr: Indices
    indices: Indices
    data: Floats


def _levels(left: sp.csr_array) -> Levels:
    """Coarsen until few unknowns are left; all levels in the same arrays, in single precision but for the first's.

    The arrays have more room than is needed; what is not written to takes no memory.
    """
    matrix, n = _split(left), left.shape[0]
    room, p_room = ROOM * len(matrix.data), ROOM * (len(matrix.data) + n)
    indices, data, p_indices, p_data = (
        np.empty(size, kind) for size in (room, p_room) for kind in (np.int32, np.float32)
    )
    pieces: list[tuple[_Matrix, Indices]] = []
    begin = p_begin = 0
    while True:
        end = begin + len(matrix.data)
        indices, data = _with_room(indices, begin, end), _with_room(data, begin, end)
        indices[begin:end], data[begin:end] = matrix.indices, matrix.data
        is_last = len(matrix.diagonal) <= COARSEST
        prolongation, n_coarse = (None, 0) if is_last else _interpolation(matrix)
        is_last = is_last or n_coarse in (0, len(matrix.diagonal))
        p_indptr = np.full(len(matrix.indptr), p_begin)
        if prolongation is not None and not is_last:
            p_end = p_begin + len(prolongation.data)
            p_indices, p_data = _with_room(p_indices, p_begin, p_end), _with_room(p_data, p_begin, p_end)
            p_indices[p_begin:p_end], p_data[p_begin:p_end] = prolongation.indices, prolongation.data
            p_indptr, p_begin = prolongation.indptr + p_begin, p_end
        light = _Matrix(matrix.indptr + begin, matrix.middle + begin, indices[:0], data[:0], matrix.diagonal)
        pieces.append((light, p_indptr))
        begin = end
        if prolongation is None or is_last:
            break
        matrix = _product(matrix, prolongation, n_coarse)
    sizes = np.array([len(piece.diagonal) for piece, _ in pieces])
    if sizes[-1] > LARGEST:
        raise SolveError(
            f"multigrid found no coarse system for {n} unknowns, as if they were in many parts; use the direct solver"
        )
    return Levels(
        sizes=sizes,
        places=np.concatenate([[0], np.cumsum(sizes)]),
        rows=np.concatenate([[0], np.cumsum(sizes + 1)])[:-1],
        indptr=np.concatenate([piece.indptr for piece, _ in pieces]),
        middle=np.concatenate([piece.middle for piece, _ in pieces]),
        indices=indices,
        data=data,
        diagonal=np.concatenate([piece.diagonal for piece, _ in pieces]),
        p_indptr=np.concatenate([p_indptr for _, p_indptr in pieces]),
        p_indices=p_indices,
        p_data=p_data,
        coarsest=_inverse(matrix),
    )


def _split(left: sp.csr_array) -> _Matrix:
    n = left.shape[0]
    if not (left.diagonal() > 0.0).all():
        raise SolveError("multigrid needs a matrix with a positive diagonal; use the direct solver")
    matrix = _Matrix(
        np.empty(n + 1, np.int64), np.empty(n, np.int64), np.empty(left.nnz, np.int32), np.empty(left.nnz), np.empty(n)
    )
    size = split_rows(left.indptr, left.indices, left.data, *matrix)
    return matrix._replace(indices=matrix.indices[:size], data=matrix.data[:size])


def _interpolation(matrix: _Matrix) -> tuple[_Prolongation, int]:
    """Choose the points of the next level, and interpolate from them; return how many there are."""
    n, nnz = len(matrix.diagonal), len(matrix.data)
    strong, first, origins = np.empty(nnz, np.bool_), np.empty(n + 1, np.int64), np.empty(nnz, np.int32)
    mark_strong(matrix.indptr, matrix.data, strong)
    reverse_strong(matrix.indptr, matrix.indices, strong, first, origins)
    coarse = np.empty(n, np.int32)
    count = choose_coarse(matrix.indptr, matrix.indices, strong, first, origins, coarse)
    indptr, indices, data = np.empty(n + 1, np.int64), np.empty(nnz + n, np.int32), np.empty(nnz + n)
    size = interpolate(
        matrix.indptr, matrix.indices, matrix.data, matrix.diagonal, strong, coarse, indptr, indices, data
    )
    return _Prolongation(indptr, indices[:size], data[:size]), int(count)


def _product(matrix: _Matrix, prolongation: _Prolongation, n_coarse: int) -> _Matrix:
    """Return the matrix of the next level, the product of transposed interpolation, matrix and interpolation."""
    size = len(prolongation.data)
    restriction = _Prolongation(np.empty(n_coarse + 1, np.int64), np.empty(size, np.int32), np.empty(size))
    transpose(*prolongation, *restriction)
    fine = matrix.indptr, matrix.indices, matrix.data, matrix.diagonal
    sizes, middle, diagonal = np.empty(n_coarse, np.int64), np.empty(n_coarse, np.int64), np.empty(n_coarse)
    parts: dict[int, tuple[Indices, Floats]] = {}

    def multiply(first: int, last: int) -> None:
        room = most_entries(fine[0], prolongation.indptr, fine[1], restriction.indptr, restriction.indices, first, last)
        columns, values, mark = np.empty(room, np.int32), np.empty(room), np.full(n_coarse, -1, np.int32)
        count = galerkin_rows(
            fine, prolongation, restriction, first, last, mark, sizes, middle, diagonal, columns, values
        )
        parts[first] = columns[:count].copy(), values[:count].copy()

    over_ranges(multiply, n_coarse)
    indices, data = (np.concatenate([parts[first][k] for first in sorted(parts)]) for k in range(2))
    indptr = np.concatenate([[0], np.cumsum(sizes)])
    return _Matrix(indptr, indptr[:-1] + middle, indices, data, diagonal)


def _with_room(array: NDArray[Any], used: int, needed: int) -> NDArray[Any]:
    """Return an array with room for `needed` entries, the first `used` kept."""
    if needed <= len(array):
        return array
    larger = np.empty(2 * needed, array.dtype)
    larger[:used] = array[:used]
    return larger


def _inverse(matrix: _Matrix) -> Floats:
    n = len(matrix.diagonal)
    dense = sp.csr_array((matrix.data, matrix.indices, matrix.indptr), shape=(n, n)).toarray()
    try:
        return np.asarray(np.linalg.inv(dense + np.diag(matrix.diagonal)))
    except np.linalg.LinAlgError as reason:
        raise SolveError(f"the matrix is singular ({reason}); some unknowns hang on no fixed one") from reason
