"""Arguments for every kernel of the room `solve`."""

import numpy as np
import scipy.sparse as sp

from kernel_cases.samples import SHAPE, STAR, WITHIN, N, bools, int32s, ints
from pointchart._kernels.solve import coarse_points, cycles, galerkin
from pointchart._kernels.unsigned import unsigned
from pointchart.solve.hierarchy import split

TREE = np.array([0, 1, 2, 3, 4]), np.array([-9999, 0, 0, 1, 1])
GRAPH = np.array([0, 0, 1, 2, 4, 5]), np.array([0, 0, 1, 2, 1])


def light(*arrays):
    """Return arrays as kernels take them: integers unsigned, other numbers as they are."""
    return tuple(unsigned(array) if array.dtype.kind == "i" else array for array in arrays)


def in_rows(matrix):
    """Return compressed rows in the types that the multigrid levels have."""
    return unsigned(matrix.indptr.astype(np.int64)), unsigned(matrix.indices), matrix.data.astype(np.float32)


LINE = sp.diags_array([-1.0, 2.1, -1.2], offsets=[-1, 0, 1], shape=(15, 15))
SYSTEM = sp.csr_array(sp.kron(LINE, sp.eye_array(15)) + sp.kron(sp.eye_array(15), LINE))
FINE = split(SYSTEM)
STRONG = bools(len(FINE.data))
coarse_points.mark_strong.py_func(FINE.indptr, FINE.data, STRONG)
DEPENDENT = ints(226), int32s(len(STRONG))
coarse_points.reverse_strong.py_func(FINE.indptr, FINE.indices, STRONG, *DEPENDENT)
COARSE = int32s(225)
N_COARSE = coarse_points.choose_coarse.py_func(FINE.indptr, FINE.indices, *DEPENDENT, STRONG, COARSE)
TO_FINE = ints(226), int32s(len(STRONG)), np.zeros(len(STRONG))
N_SHARES = galerkin.interpolate.py_func(*FINE[:1], *FINE[2:], STRONG, COARSE, *TO_FINE)
TO_FINE = TO_FINE[0], TO_FINE[1][:N_SHARES].copy(), TO_FINE[2][:N_SHARES].copy()
TO_COARSE = ints(N_COARSE + 1), int32s(N_SHARES), np.zeros(N_SHARES)
galerkin.transpose.py_func(*TO_FINE, *TO_COARSE)
MARK = int32s(N_COARSE) - 1

# A system of more rows than two blocks, and a way to it from half as many.
N_LONG = 2 * cycles.BLOCK + 50
BAND = sp.csr_array(sp.diags_array([-0.3, -0.2, 1.1, -0.2, -0.3], offsets=[-40, -1, 0, 2, 2100], shape=(N_LONG,) * 2))
HALVED = in_rows(sp.csr_array(sp.diags_array([0.6, 0.4], offsets=[-50, 0], shape=(N_LONG, N_LONG // 2))))
PAIR = np.random.default_rng(6).normal(size=(N_LONG, 2))
SINGLES = PAIR.astype(np.float32)
ROWS = 5, N_LONG - 3
SUMS = len(range(0, N_LONG, cycles.BLOCK)), 4


def swept():
    """Return the rows of the long system without their diagonal, and its inverse, as sweeps take them."""
    rows = split(BAND)
    return *light(*rows[:3]), rows.data.astype(np.float32), (1.0 / rows.diagonal).astype(np.float32)


CASES = {
    "coarse_points.choose_coarse": lambda: (*light(FINE.indptr, FINE.indices, *DEPENDENT), STRONG, int32s(225)),
    "galerkin.add_row": lambda: (
        light(*TO_FINE),
        int(np.flatnonzero(COARSE < 0)[5]),
        0.7,
        int(TO_FINE[1][TO_FINE[0][np.flatnonzero(COARSE < 0)[5]]]),
        2,
        3,
        0.1,
        MARK.copy(),
        int32s(9),
        np.zeros(9),
    ),
    "galerkin.galerkin_rows": lambda: (
        light(FINE.indptr, FINE.indices, FINE.data, FINE.diagonal),
        light(*TO_FINE),
        light(*TO_COARSE),
        3,
        N_COARSE,
        MARK.copy(),
        ints(N_COARSE),
        ints(N_COARSE),
        np.zeros(N_COARSE),
        int32s(9999),
        np.zeros(9999),
    ),
    "coarse_points.has_strong": lambda: (FINE.indptr, STRONG, 7),
    "galerkin.insert_sorted": lambda: (np.array([7, 1, 4, 6, 0], np.int32), np.arange(5.0), 1, 4, 2, 9.0),
    "galerkin.interpolate": lambda: (
        FINE.indptr,
        FINE.indices,
        np.where(np.arange(len(FINE.data)) % 7 > 0, FINE.data, 0.1),
        FINE.diagonal,
        STRONG & (np.arange(len(FINE.data)) % 7 > 0),
        COARSE,
        ints(226),
        int32s(len(STRONG) + 225),
        np.zeros(len(STRONG) + 225),
    ),
    "coarse_points.mark_strong": lambda: (FINE.indptr, np.sin(np.arange(len(FINE.data))), bools(len(FINE.data))),
    "galerkin.middle_of": lambda: (np.array([7, 1, 4, 6, 0], np.int32), 1, 4, 5),
    "galerkin.most_entries": lambda: (*light(FINE.indptr, TO_FINE[0], FINE.indices, *TO_COARSE[:2]), 3, N_COARSE),
    "coarse_points.number_chosen": lambda: (np.array([-1, 0, 0, -1, 0], np.int32),),
    "coarse_points.pull": lambda: (np.array([-1, 2], np.int32), np.array([1, -1, 0]), np.array([2, 0, -1]), 2, 1),
    "coarse_points.pull from the middle": lambda: (
        np.array([-1, 2], np.int32),
        np.array([1, -1, 0]),
        np.array([2, 0, -1]),
        0,
        1,
    ),
    "coarse_points.push": lambda: (np.array([-1, 2], np.int32), ints(4) - 1, ints(4) - 1, 3, 1),
    "coarse_points.rank_points": lambda: (light(np.array([0, 2, 2, 9]))[0], int32s(3)),
    "coarse_points.reverse_strong": lambda: (FINE.indptr, FINE.indices, STRONG, ints(226), int32s(len(STRONG))),
    "galerkin.split_rows": lambda: (
        SYSTEM.indptr,
        SYSTEM.indices[::-1].copy(),
        SYSTEM.data,
        ints(226),
        ints(225),
        int32s(SYSTEM.nnz),
        np.zeros(SYSTEM.nnz),
        np.zeros(225),
    ),
    "galerkin.transpose": lambda: (*TO_FINE, ints(N_COARSE + 1), int32s(N_SHARES), np.zeros(N_SHARES)),
    "graphs.dominators": lambda: (TREE[0], *GRAPH, 0, np.arange(5), np.array([0, -1, -1, -1, -1])),
    "graphs.reduce_rows": lambda: (
        STAR.indptr,
        STAR.indices,
        np.cos(np.arange(len(STAR.indices))),
        WITHIN,
        np.where(np.isin(np.arange(N), WITHIN), np.searchsorted(WITHIN, np.arange(N)), -1).astype(np.int32),
        SHAPE.uv,
        int32s(len(WITHIN) + 1),
        int32s(len(STAR.indices) + N),
        np.zeros(len(STAR.indices) + N),
        np.zeros((len(WITHIN), 2)),
    ),
    "graphs.symmetrizer": lambda: (
        *TREE,
        np.array([0, 2, 5, 6, 7, 8]),
        np.array([1, 2, 0, 3, 4, 0, 1, 1]),
        -np.array([0.5, 0.5, 0.2, 0.4, 0.4, 1.0, 1.0, 1.0]),
        np.zeros(5),
    ),
    "cycles.add_products": lambda: (np.ones(SUMS), 1, PAIR, PAIR[::-1].copy(), 7),
    "cycles.advance": lambda: (
        PAIR.copy(),
        PAIR[::-1].copy(),
        np.array([0.3, -2.0]),
        SINGLES + 1,
        PAIR - 1,
        2 * PAIR,
        np.zeros(SUMS),
        0,
        N_LONG,
    ),
    "cycles.find_rest": lambda: (*swept()[:4], SINGLES, np.zeros_like(SINGLES), *ROWS),
    "cycles.multiply": lambda: (
        *light(BAND.indptr, BAND.indices, BAND.data),
        SINGLES,
        np.zeros_like(PAIR),
        PAIR + 1,
        np.zeros(SUMS),
        0,
        N_LONG,
    ),
    "cycles.prolong": lambda: (*HALVED, SINGLES[::2].copy(), SINGLES.copy(), *ROWS),
    "cycles.redirect": lambda: (
        PAIR.copy(),
        PAIR[::-1].copy(),
        PAIR - 1,
        np.array([0.3, -2.0]),
        np.array([0.5, 0.0]),
        *ROWS,
    ),
    "cycles.restrict": lambda: (*in_rows(BAND), SINGLES, np.zeros_like(SINGLES), *ROWS),
    "cycles.sweep_backward": lambda: (*swept(), SINGLES, SINGLES[::-1].copy(), np.zeros_like(SINGLES), *ROWS),
    "cycles.sweep_forward": lambda: (*swept(), SINGLES, np.zeros_like(SINGLES), *ROWS),
}
