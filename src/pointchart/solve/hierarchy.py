"""A matrix made ever smaller: the levels of algebraic multigrid, by Ruge and Stueben."""

from collections import defaultdict
from threading import get_ident
from typing import NamedTuple, TypeAlias

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from .._kernels.solve.coarsen import (
    choose_coarse,
    galerkin_rows,
    interpolate,
    mark_strong,
    most_entries,
    reverse_strong,
    split_rows,
    transpose,
)
from .._kernels.unsigned import unsigned
from .._parallel import over_ranges
from ..errors import SolveError
from ..typing import Floats, Indices

COARSEST = 200  # unknowns that are solved for directly: their inverse, dense, has no more entries than a small level
LARGEST = 3000  # the same, where coarsening comes to an end before, as on many parts: an inverse of 72 MB

Singles: TypeAlias = NDArray[np.float32]


class Matrix(NamedTuple):
    """Sorted rows without the diagonal; `middle` is the place of the first column over it."""

    indptr: Indices
    middle: Indices
    indices: Indices
    data: Floats
    diagonal: Floats


class Transfer(NamedTuple):
    """Compressed rows: the interpolation of a level from the next, or its transpose."""

    indptr: Indices
    indices: Indices
    data: Floats


class Vectors(NamedTuple):
    """Of a level: right side, what a sweep finds, what the next one makes of it, what is left of the right side."""

    known: Singles
    found: Singles
    better: Singles
    rest: Singles


class Level(NamedTuple):
    """A matrix as the sweeps take it, and the ways from and to the next level."""

    rows: tuple[Indices, Indices, Indices, Singles, Singles]
    prolongation: Transfer
    restriction: Transfer


class Hierarchy(NamedTuple):
    """What preconditions a matrix: levels and vectors in single precision, the inverse of the coarsest matrix."""

    levels: list[Level]
    coarsest: Floats
    vectors: list[Vectors]


def coarsened(left: sp.csr_array) -> Hierarchy:
    """Coarsen a matrix until few unknowns are left.

    Raises
    ------
    SolveError
        If the diagonal is not positive, the coarsest matrix is singular, or coarsening comes to an end too soon.

    Examples
    --------
    >>> line = sp.diags_array([-1.0, 2.0, -1.0], offsets=[-1, 0, 1], shape=(1000, 1000)).tocsr()
    >>> [len(vectors.known) for vectors in coarsened(line).vectors]
    [1000, 500, 250, 125]
    """
    matrix, levels, vectors = split(left), [], []
    while True:
        n = len(matrix.diagonal)
        vectors.append(Vectors(*(np.empty((n, 2), np.float32) for _ in range(4))))
        if n <= COARSEST:
            break
        prolongation, n_coarse = _interpolation(matrix)
        if n_coarse in (0, n):
            break
        restriction = _transposed(prolongation, n_coarse)
        levels.append(Level(_in_singles(matrix), *map(_light, (prolongation, restriction))))
        matrix = _product(matrix, prolongation, restriction)
    if n > LARGEST:
        raise SolveError(
            f"multigrid found no coarse system for {left.shape[0]} unknowns, as if they were in many parts; "
            "use the direct solver"
        )
    return Hierarchy(levels, _inverse(matrix), vectors)


def _in_singles(matrix: Matrix) -> tuple[Indices, Indices, Indices, Singles, Singles]:
    indptr, middle, indices = map(unsigned, matrix[:3])
    return indptr, middle, indices, matrix.data.astype(np.float32), (1.0 / matrix.diagonal).astype(np.float32)


def _light(transfer: Transfer) -> Transfer:
    """Give a way between levels in single precision, and no more room than it takes."""
    return Transfer(unsigned(transfer.indptr), unsigned(transfer.indices.copy()), transfer.data.astype(np.float32))


def split(left: sp.csr_array) -> Matrix:
    """Take the diagonal out of a matrix, and sort its rows.

    Raises
    ------
    SolveError
        If a diagonal entry is not positive.

    Examples
    --------
    >>> split(sp.csr_array([[2.0, -1.0], [0.0, 3.0]])).diagonal
    array([2., 3.])
    """
    n = left.shape[0]
    if not (left.diagonal() > 0.0).all():
        raise SolveError("multigrid needs a matrix with a positive diagonal; use the direct solver")
    indptr, middle, diagonal = np.empty(n + 1, np.int64), np.empty(n, np.int64), np.empty(n)
    matrix = Matrix(indptr, middle, np.empty(left.nnz, np.int32), np.empty(left.nnz), diagonal)
    size = split_rows(left.indptr, left.indices, left.data, *matrix)
    return matrix._replace(indices=matrix.indices[:size], data=matrix.data[:size])


def _interpolation(matrix: Matrix) -> tuple[Transfer, int]:
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
    return Transfer(indptr, indices[:size], data[:size]), int(count)


def _transposed(prolongation: Transfer, n_coarse: int) -> Transfer:
    size = len(prolongation.data)
    restriction = Transfer(np.empty(n_coarse + 1, np.int64), np.empty(size, np.int32), np.empty(size))
    transpose(*prolongation, *restriction)
    return restriction


def _product(matrix: Matrix, prolongation: Transfer, restriction: Transfer) -> Matrix:
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
    return Matrix(indptr, indptr[:-1] + middle, indices, data, diagonal)


def _inverse(matrix: Matrix) -> Floats:
    n = len(matrix.diagonal)
    dense = sp.csr_array((matrix.data, matrix.indices, matrix.indptr), shape=(n, n)).toarray()
    try:
        return np.asarray(np.linalg.inv(dense + np.diag(matrix.diagonal)))
    except np.linalg.LinAlgError as reason:
        raise SolveError(f"the matrix is singular ({reason}); some unknowns hang on no fixed one") from reason
