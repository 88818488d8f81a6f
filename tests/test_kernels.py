import copy
import importlib
import pkgutil

import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import integer_sets, seeds

from pointchart import _kernels
from pointchart._kernels.agreement import agreed_triangles as rims
from pointchart._kernels.boundary import sides
from pointchart._kernels.mesh import drafts
from pointchart._kernels.mesh import half_edges as half_edge_kernels
from pointchart._kernels.mesh import pockets as assemble
from pointchart._kernels.mesh import put_back as relocate
from pointchart._kernels.mesh import recover_edges as recover
from pointchart._kernels.plane import exact_turns
from pointchart._kernels.points import box_tree as trees
from pointchart._kernels.points import inversion as stars
from pointchart._kernels.points import tangent_planes as planes
from pointchart._kernels.solve import coarsen
from pointchart._kernels.solve import cycles as steps
from pointchart._kernels.surface import constrain
from pointchart._kernels.unsigned import unsigned
from pointchart.agreement.agreed_surface import patchwork
from pointchart.mesh.connectivity import half_edges, one_rings, start_draft
from pointchart.mesh.planar_delaunay import triangulate
from pointchart.plane.exact_signs import orientation_signs
from pointchart.points.neighbors import BoxTree, Neighborhoods, nearest, spacing
from pointchart.points.stars import delaunay_star, normals
from pointchart.proof.intersections import box_tree
from pointchart.shapes import disc, moebius, relief
from pointchart.solve.hierarchy import split
from pointchart.surface import fit_radial, interpolate_clough_tocher

SHAPE = relief(60, seed=3)
N = len(SHAPE.points)
AROUND = nearest(SHAPE.points, 9)
NORMALS = normals(SHAPE.points, AROUND)
STAR = delaunay_star(SHAPE.points, AROUND)
EDGES = half_edges(SHAPE.triangles, N)
RINGS = one_rings(SHAPE.triangles, N)
MIXED = half_edges(disc(60, seed=1).triangles, N)
FIRST = np.zeros(N, np.int64)
FIRST[EDGES.origins] = np.arange(len(EDGES.origins))
INNER = int(np.flatnonzero(EDGES.twins >= 0)[0])
ROUND = np.arange(6) + 0.3
TURNS = np.array([stars.pseudo_angle.py_func(np.cos(t), np.sin(t)) for t in ROUND])
RING_X, RING_Y = np.cos(ROUND) * [1, 2, 1, 1.5, 1, 1], np.sin(ROUND) * [1, 2, 1, 1.5, 1, 1]
TREE = np.array([0, 1, 2, 3, 4]), np.array([-9999, 0, 0, 1, 1])
GRAPH = np.array([0, 0, 1, 2, 4, 5]), np.array([0, 0, 1, 2, 1])
SUCCESSOR = np.full(N, -1, np.int64)
SUCCESSOR[SHAPE.boundary] = np.roll(SHAPE.boundary, -1)
SUCCESSOR[SHAPE.boundary[3]] = SHAPE.boundary[5]


def ints(n):
    return np.zeros(n, np.int64)


def bools(n):
    return np.zeros(n, np.bool_)


def int32s(n):
    return np.zeros(n, np.int32)


def light(*arrays):
    """Return arrays as kernels take them: integers unsigned, other numbers as they are."""
    return tuple(unsigned(array) if array.dtype.kind == "i" else array for array in arrays)


def in_rows(matrix):
    """Return compressed rows in the types that the multigrid levels have."""
    return unsigned(matrix.indptr.astype(np.int64)), unsigned(matrix.indices), matrix.data.astype(np.float32)


M = len(SHAPE.triangles)
STEP = spacing(SHAPE.points)
RAGGED = patchwork(SHAPE.triangles[7:], N)
N_EDGES = len(RAGGED.ends)

# A surface with gaps that touch, and two with a gap around one point or more.
WITHIN = np.setdiff1d(np.arange(N), SHAPE.boundary)
ASTRAY = int(WITHIN[7])
TORN = half_edges(SHAPE.triangles[np.random.default_rng(4).random(M) < 0.6], N)
GAPPED = half_edges(SHAPE.triangles[~np.isin(SHAPE.triangles, WITHIN[:3]).any(axis=1)], N)
HOLED = half_edges(SHAPE.triangles[(SHAPE.triangles != ASTRAY).all(axis=1)], N)
AHEAD, BEHIND = np.full((2, N), -1, np.int32)
AHEAD[SHAPE.boundary], BEHIND[SHAPE.boundary] = np.roll(SHAPE.boundary, -1), np.roll(SHAPE.boundary, 1)


def rims_of(edges):
    numbers = int32s(len(edges.twins))
    assemble.mark_rims.py_func(edges.twins, numbers)
    return numbers


def pocket_of(edges):
    """Return corners and twins with room for more, the loop that is not the boundary, and the first free place."""
    room, numbers, boundary = np.full(90, -1, np.int32), rims_of(edges), SHAPE.boundary.tolist()
    h = k = next(h for h in np.flatnonzero(edges.twins < 0) if edges.origins[h] not in boundary)
    loop = []
    while not loop or k != h:
        loop.append(k)
        k = assemble.along_rim.py_func(edges.twins, k)
    assert set(numbers[loop]) == {numbers[h]}
    return np.r_[edges.origins, room], np.r_[edges.twins, room], np.array(loop, np.int64), len(edges.twins) // 3


def walks_of(edges):
    size = len(edges.twins)
    scratch = int32s(N) - 1, ints(size), ints(size), ints(size + 1)
    return edges.origins, edges.twins, AHEAD, BEHIND, *scratch, ~bools(size // 3)


# A strip with one side, whose last triangle wants edges that have two already.
STRIP = moebius(8, 3)
FACES = np.r_[STRIP.triangles, STRIP.triangles[:2]].astype(np.int32)
FACE_EDGES, FACE_ENDS = int32s((len(FACES), 3)), int32s((3 * len(FACES), 2))
FACE_ENDS = FACE_ENDS[: rims.name_edges.py_func(FACES, ints(len(STRIP.points) + 1), FACE_ENDS, FACE_EDGES)].copy()


def untaken():
    """Return the triangles of the strip, which are not taken yet, with all that taking them writes."""
    m = len(FACES)
    return (
        FACES.copy(),
        np.arange(m),
        ~bools(m),
        FACE_EDGES.copy(),
        int32s((len(FACE_ENDS), 2)) - 1,
        int32s(m),
        bools(m),
        np.zeros(m, np.int8),
    )


def taken(first=0):
    """Return the triangles of the strip, of which those up to some are taken."""
    arguments = untaken()
    rims.keep_manifold.py_func(arguments[0], np.arange(first or len(FACES)), *arguments[2:])
    return arguments


def joining(t):
    triangles, _, _, edge_of, sides, parent, is_odd, _ = taken(t)
    return triangles, edge_of, sides, parent, is_odd, t


LINE = sp.diags_array([-1.0, 2.1, -1.2], offsets=[-1, 0, 1], shape=(15, 15))
SYSTEM = sp.csr_array(sp.kron(LINE, sp.eye_array(15)) + sp.kron(sp.eye_array(15), LINE))
FINE = split(SYSTEM)
STRONG = bools(len(FINE.data))
coarsen.mark_strong.py_func(FINE.indptr, FINE.data, STRONG)
DEPENDENT = ints(226), int32s(len(STRONG))
coarsen.reverse_strong.py_func(FINE.indptr, FINE.indices, STRONG, *DEPENDENT)
COARSE = int32s(225)
N_COARSE = coarsen.choose_coarse.py_func(FINE.indptr, FINE.indices, *DEPENDENT, STRONG, COARSE)
TO_FINE = ints(226), int32s(len(STRONG)), np.zeros(len(STRONG))
N_SHARES = coarsen.interpolate.py_func(*FINE[:1], *FINE[2:], STRONG, COARSE, *TO_FINE)
TO_FINE = TO_FINE[0], TO_FINE[1][:N_SHARES].copy(), TO_FINE[2][:N_SHARES].copy()
TO_COARSE = ints(N_COARSE + 1), int32s(N_SHARES), np.zeros(N_SHARES)
coarsen.transpose.py_func(*TO_FINE, *TO_COARSE)
MARK = int32s(N_COARSE) - 1

# A system of more rows than two blocks, and a way to it from half as many.
N_LONG = 2 * steps.BLOCK + 50
BAND = sp.csr_array(sp.diags_array([-0.3, -0.2, 1.1, -0.2, -0.3], offsets=[-40, -1, 0, 2, 2100], shape=(N_LONG,) * 2))
HALVED = in_rows(sp.csr_array(sp.diags_array([0.6, 0.4], offsets=[-50, 0], shape=(N_LONG, N_LONG // 2))))
PAIR = np.random.default_rng(6).normal(size=(N_LONG, 2))
SINGLES = PAIR.astype(np.float32)
ROWS = 5, N_LONG - 3
SUMS = len(range(0, N_LONG, steps.BLOCK)), 4

LOW, HIGH = np.zeros((2, 16, 3))
trees.bound_boxes.py_func(SHAPE.points, LOW, HIGH)
CORNER, WIDTH = SHAPE.points.min(axis=0), float(np.ptp(SHAPE.points, axis=0).max())

PENTAGRAM = np.array([[np.cos(t), np.sin(t)] for t in np.arange(5) * 0.8 * np.pi])
X_ENDS = np.column_stack([PENTAGRAM[:, 0], np.roll(PENTAGRAM[:, 0], -1)])
SPANS = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [9, 9, 0], [5, 5, 0], [6, 5, 0], [5, 6, 0]])
SPAN_BOXES = box_tree(SPANS[::3], SPANS[1::3], SPANS[2::3])
DIGITS = np.arange(exact_turns.N_DIGITS) - 9
SWEEP = (np.argsort(X_ENDS.min(axis=1)), X_ENDS.min(axis=1), X_ENDS.max(axis=1))

CUBICS = interpolate_clough_tocher(SHAPE.points, SHAPE.uv, SHAPE.triangles)
SPLINES = fit_radial(SHAPE.points, SHAPE.uv, nearby=20)

KNOTS_U = np.array([-1.0, -1, -1, -1, -0.2, 0.3, 0.3, 1, 1, 1, 1])
KNOTS_V = np.array([-1.0, -1, -1, -1, 0.1, 1, 1, 1, 1])
CONTROL = np.random.default_rng(5).normal(size=(7, 5, 3))
WEIGHTS = np.linspace(0.5, 2.0, N)

FAR = int(WITHIN[0]), int(WITHIN[np.argmax(((SHAPE.uv - SHAPE.uv[WITHIN[0]]) ** 2).sum(axis=1)[WITHIN])])


def draft():
    return start_draft(SHAPE.points, SHAPE.triangles, journal=relocate.JOURNAL)


def draft_in_plane():
    return start_draft(SHAPE.uv, SHAPE.triangles, journal=2)


def mixed_draft():
    return start_draft(SHAPE.points, disc(60, seed=1).triangles, journal=relocate.JOURNAL)


def changed_draft():
    changed = draft()
    drafts.swap_noted.py_func(changed, 0, INNER)
    return changed


def thinned_out():
    thin = draft()
    n, _ = relocate.thin_out.py_func(thin, ASTRAY, drafts.inner_degree.py_func(thin, ASTRAY))
    h = int(thin.leaving[ASTRAY])
    one = drafts.next_around.py_func(thin, h)
    return thin, n, ASTRAY, h, one, drafts.next_around.py_func(thin, one)


def swept():
    """Return the rows of the long system without their diagonal, and its inverse, as sweeps take them."""
    rows = split(BAND)
    return *light(*rows[:3]), rows.data.astype(np.float32), (1.0 / rows.diagonal).astype(np.float32)


CASES = {
    "pockets.add_ear": lambda: (*pocket_of(HOLED)[:2], *pocket_of(HOLED)[2][:2].tolist(), M),
    "pockets.along_rim": lambda: (TORN.twins, int(np.flatnonzero(TORN.twins < 0)[3])),
    "pockets.cap": lambda: (SHAPE.points, *pocket_of(GAPPED)),
    "pockets.cap around one point": lambda: (SHAPE.points, *pocket_of(HOLED)),
    "pockets.close_loop": lambda: (
        EDGES.origins,
        np.arange(N, dtype=np.int32),
        np.arange(9),
        2,
        6,
        ints(9),
        ints(3),
        1,
        3,
    ),
    "pockets.cut_walks": lambda: walks_of(TORN),
    "pockets.drop_closed_fan": lambda: (EDGES.twins, int(FIRST[ASTRAY]), ~bools(M)),
    "pockets.drop_fan": lambda: (TORN.twins, int(np.flatnonzero(TORN.twins < 0)[3]), ~bools(M)),
    "pockets.ear_cost": lambda: (
        SHAPE.points,
        *pocket_of(GAPPED)[:3],
        np.arange(len(pocket_of(GAPPED)[2])),
        0,
        1,
        False,
    ),
    "pockets.goes_before": lambda: (np.array([1.0, 1.0]), bools(2), 0, 1),
    "pockets.goes_before a bad one": lambda: (np.array([2.0, 1.0]), np.array([False, True]), 0, 1),
    "pockets.is_over": lambda: (np.eye(4, 3), 3, 0, 1, 2, 1.0, 1.0, 1.0),
    "pockets.is_over not": lambda: (np.eye(4, 3) - np.eye(4, 3, -3), 3, 0, 1, 2, 1.0, 1.0, 1.0),
    "pockets.fan_size": lambda: (
        TORN.origins,
        TORN.twins,
        int(np.flatnonzero(TORN.twins < 0)[3]),
        int(SHAPE.boundary[0]),
        int(SHAPE.boundary[2]),
    ),
    "pockets.keep_largest": lambda: (TORN.twins, np.arange(len(TORN.twins) // 3) % 9 > 0),
    "pockets.mark_pinching": lambda: (
        TORN.origins,
        TORN.twins,
        rims_of(TORN),
        AHEAD,
        BEHIND,
        int32s(N) - 1,
        ~bools(len(TORN.twins) // 3),
    ),
    "pockets.mark_rims": lambda: (TORN.twins, int32s(len(TORN.twins))),
    "pockets.to_half_edges": lambda: (
        RAGGED.triangles,
        RAGGED.edge_of,
        RAGGED.sides,
        np.where(np.arange(M - 7) % 5 > 0, np.cumsum(np.arange(M - 7) % 5 > 0, dtype=np.int32) - 1, -1),
        int32s(3 * M),
        int32s(3 * M),
    ),
    "bspline_basis.basis": lambda: (KNOTS_U, 3, 4, 0.1, 2, np.zeros((3, 4)), np.zeros((4, 4)), np.zeros((2, 4))),
    "bspline_basis.basis_rows": lambda: (KNOTS_U, 3, SHAPE.uv[:, 0].copy(), 1, np.zeros((N, 4)), ints((N, 4))),
    "bspline_basis.evaluate": lambda: (KNOTS_U, KNOTS_V, 3, CONTROL, SHAPE.uv, 1, 2, 0, N, np.zeros((N, 3))),
    "bspline_basis.find_span": lambda: (KNOTS_U, 3, 0.3),
    "bspline_basis.gather": lambda: (
        KNOTS_U,
        KNOTS_V,
        3,
        SHAPE.uv,
        SHAPE.points,
        WEIGHTS,
        np.zeros((35, 7, 7)),
        np.zeros((35, 3)),
    ),
    "clough_tocher_element.contract": lambda: (SHAPE.points[:10].copy(), 3, 0.2, 0.5, 0.3),
    "clough_tocher_element.coordinates": lambda: (SHAPE.uv, SHAPE.triangles[5], 0.1, 0.2, np.zeros((3, 3))),
    "clough_tocher_element.evaluate": lambda: (
        CUBICS.uv,
        CUBICS.triangles,
        CUBICS.boxes,
        1e-15,
        CUBICS.points,
        CUBICS.gradients,
        CUBICS.crossings,
        SHAPE.uv,
        1,
        1,
        0,
        N,
        np.zeros((N, 3)),
    ),
    "clough_tocher_element.write_net": lambda: (
        CUBICS.points,
        CUBICS.gradients,
        CUBICS.uv,
        CUBICS.triangles[5],
        CUBICS.crossings[5],
        1,
        np.zeros((10, 3)),
    ),
    "coarsen.choose_coarse": lambda: (*light(FINE.indptr, FINE.indices, *DEPENDENT), STRONG, int32s(225)),
    "coarsen.add_row": lambda: (
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
    "coarsen.galerkin_rows": lambda: (
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
    "coarsen.has_strong": lambda: (FINE.indptr, STRONG, 7),
    "coarsen.insert_sorted": lambda: (np.array([7, 1, 4, 6, 0], np.int32), np.arange(5.0), 1, 4, 2, 9.0),
    "coarsen.interpolate": lambda: (
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
    "coarsen.mark_strong": lambda: (FINE.indptr, np.sin(np.arange(len(FINE.data))), bools(len(FINE.data))),
    "coarsen.middle_of": lambda: (np.array([7, 1, 4, 6, 0], np.int32), 1, 4, 5),
    "coarsen.most_entries": lambda: (*light(FINE.indptr, TO_FINE[0], FINE.indices, *TO_COARSE[:2]), 3, N_COARSE),
    "coarsen.pull": lambda: (np.array([-1, 2], np.int32), np.array([1, -1, 0]), np.array([2, 0, -1]), 2, 1),
    "coarsen.pull from the middle": lambda: (
        np.array([-1, 2], np.int32),
        np.array([1, -1, 0]),
        np.array([2, 0, -1]),
        0,
        1,
    ),
    "coarsen.push": lambda: (np.array([-1, 2], np.int32), ints(4) - 1, ints(4) - 1, 3, 1),
    "coarsen.reverse_strong": lambda: (FINE.indptr, FINE.indices, STRONG, ints(226), int32s(len(STRONG))),
    "coarsen.split_rows": lambda: (
        SYSTEM.indptr,
        SYSTEM.indices[::-1].copy(),
        SYSTEM.data,
        ints(226),
        ints(225),
        int32s(SYSTEM.nnz),
        np.zeros(SYSTEM.nnz),
        np.zeros(225),
    ),
    "coarsen.transpose": lambda: (*TO_FINE, ints(N_COARSE + 1), int32s(N_SHARES), np.zeros(N_SHARES)),
    "constrain.constrain": lambda: (draft_in_plane(), np.where(np.arange(N) == FAR[0], FAR[1], -1)),
    "constrain.edge_before": lambda: (draft_in_plane(), *FAR),
    "constrain.insert_side": lambda: (draft_in_plane(), ints(N) - 1, *FAR),
    "constrain.turn_of": lambda: (np.array([[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]]), 0, 1, 2),
    "constrain.unfold": lambda: (draft_in_plane(), int(draft_in_plane().leaving[FAR[0]]), 2),
    "exact_turns.add_part": lambda: (DIGITS.copy(), -1, (1 << 53) - 1, 77),
    "exact_turns.add_product": lambda: (DIGITS.copy(), 0.1, -0.3),
    "exact_turns.long_turn": lambda: (0.1, 0.1, 0.2, 0.2, 0.3, 0.3),
    "exact_turns.measure_signs": lambda: (
        np.array([[0.0, 0], [1, 1], [3, 3], [0.5, 0.5 + 2.0**-53]]),
        np.array([[0, 1, 2], [0, 2, 3], [0, 3, 2]]),
        0,
        3,
        np.zeros(3, np.int8),
    ),
    "exact_turns.sign_of": lambda: (DIGITS.copy(),),
    "exact_turns.sure_turn": lambda: (0.0, 0.0, 1.0, 0.0, 0.5, 1e-300),
    "exact_turns.turn": lambda: (0.0, 0.0, 1.0, 0.0, 0.5, 1e-300),
    "segments.do_meet": lambda: (PENTAGRAM, 0, 1, 2, 3),
    "segments.has_crossing": lambda: (PENTAGRAM, *SWEEP),
    "segments.measure_inside": lambda: (
        PENTAGRAM,
        np.roll(PENTAGRAM, -1, axis=0),
        np.array([[0.8, 0.0], [0.0, 0.0], [0.5, PENTAGRAM[1, 1]]]),
        0,
        3,
        bools(3),
    ),
    "segments.measure_meetings": lambda: (
        PENTAGRAM,
        np.roll(np.arange(5), -1),
        np.array([[0, 2], [0, 1]]),
        0,
        2,
        bools(2),
    ),
    "curvature_swaps.area_vector": lambda: (SHAPE.points, 7, 3, 5),
    "curvature_swaps.cotangents": lambda: (SHAPE.points, 0, 1, 2),
    "curvature_swaps.distance": lambda: (SHAPE.points, 0, 1),
    "curvature_swaps.turn_at_edge": lambda: (SHAPE.points, 0, 1, 2, 3),
    "curvature_swaps.add_bend": lambda: (SHAPE.points, 1, 0, 1, 2, 3, 0, 1, -1.0, np.zeros((2, 3))),
    "curvature_swaps.add_triangle": lambda: (SHAPE.points, 0, 1, 2, 0, 1, 2, 1.0, np.zeros((3, 3))),
    "curvature_swaps.add_pair": lambda: (
        SHAPE.points,
        3,
        (0, 1, 2, 3),
        (4, 5, -1, 6),
        (0, 1, 2, 3),
        1.0,
        np.zeros((4, 3)),
    ),
    "curvature_swaps.sum_curvature": lambda: (SHAPE.points, EDGES.origins, EDGES.twins, 1, np.zeros((N, 3))),
    "curvature_swaps.cost_at_point": lambda: (3, False, -0.2, 0.3, 1.5),
    "curvature_swaps.apex_beyond": lambda: (EDGES.origins, EDGES.twins, INNER),
    "curvature_swaps.gain_of_swap": lambda: (
        SHAPE.points,
        EDGES.origins,
        EDGES.twins,
        3,
        0.2,
        bools(N),
        INNER,
        np.ones((N, 3)),
        np.zeros((4, 3)),
    ),
    "curvature_swaps.curvature_swaps": lambda: (
        SHAPE.points,
        EDGES.origins,
        EDGES.twins,
        0,
        1.0,
        bools(N),
        np.ones((N, 3)),
        ints(N),
    ),
    "drafts.anchor": lambda: (draft(), 5),
    "drafts.first_around": lambda: (draft(), int(SHAPE.boundary[0])),
    "drafts.inner_degree": lambda: (draft(), ASTRAY),
    "drafts.next_around": lambda: (draft(), INNER),
    "drafts.record": lambda: (draft(), 2, 5),
    "drafts.swap_noted": lambda: (draft(), 0, INNER),
    "drafts.undo": lambda: (changed_draft(), 2),
    "energy.alone_energy": lambda: (draft(), *EDGES.origins[6:9].tolist(), 6, 7, 8),
    "energy.bend_across": lambda: (draft(), INNER, (0.3, 0.2, 0.6, 0.7)),
    "energy.bend_energy": lambda: (SHAPE.points, 0, 1, (0.3, 0.2, 0.6, 0.7), (0.6, 0.2, 0.3, 0.7)),
    "energy.pair_energy": lambda: (draft(), 0, 1, 2, 3, 6, 7, 8, 9),
    "energy.swap_gain": lambda: (draft(), INNER),
    "energy.tent_energy": lambda: (draft(), 20, *EDGES.origins[6:9].tolist(), 6, 7, 8),
    "energy.total_energy": lambda: (draft(),),
    "energy.triangle_energy": lambda: (SHAPE.points, 0, 1, 2),
    "graphs.dominators": lambda: (TREE[0], *GRAPH, 0, np.arange(5), np.array([0, -1, -1, -1, -1])),
    "graphs.join": lambda: (np.array([0, 0, 1, 3, 3], dtype=np.int32), 4, 2),
    "graphs.join_parts": lambda: (SHAPE.points, AROUND.indptr, AROUND.indices, STEP, 0.8, int32s(N)),
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
    "half_edges.count_parts": lambda: (TORN.origins, N),
    "half_edges.cross_at": lambda: (SHAPE.points, 0, 1, 2),
    "half_edges.following": lambda: (5,),
    "half_edges.measure_edges": lambda: (
        SHAPE.points,
        EDGES.origins,
        EDGES.twins,
        STEP,
        0.99,
        5,
        3 * M,
        np.zeros(3 * M),
    ),
    "half_edges.preceding": lambda: (3,),
    "half_edges.pair_half_edges": lambda: (
        unsigned(np.r_[EDGES.origins, EDGES.origins[:6]]),
        N,
        int32s(3 * M + 6),
    ),
    "half_edges.count_fans": lambda: (EDGES.origins, EDGES.twins, ints(N), bools(len(EDGES.origins))),
    "half_edges.order_rings": lambda: (
        EDGES.origins,
        EDGES.twins,
        FIRST,
        RINGS.indptr,
        ints(RINGS.indptr[-1]),
        bools(N),
    ),
    "triangle_meetings.side": lambda: (SHAPE.points, 0, 1, 2, 3),
    "triangle_meetings.sides_of": lambda: (SPANS, (0, 1, 2), (3, 4, 5)),
    "triangle_meetings.pierces": lambda: (SPANS, (3, 4, 5), (-1, 1, 0), (0, 1, 2)),
    "triangle_meetings.is_apart_in_plane": lambda: (SPANS, (0, 1, 2), (6, 7, 8), 0, 1),
    "triangle_meetings.meet": lambda: (SPANS, (0, 1, 2), (3, 4, 5)),
    "triangle_meetings.overlap": lambda: (SPAN_BOXES, 3, (0.5, 0.5, -0.5, 2.0, 2.0, 0.5)),
    "triangle_meetings.find_meetings": lambda: (SPANS, np.arange(9).reshape(3, 3), SPAN_BOXES, 0, 3, ints((2, 3))),
    "link_trust.are_adjacent": lambda: (
        STAR.indptr,
        STAR.indices,
        STAR.is_open,
        0,
        int(STAR.indices[0]),
        int(STAR.indices[1]),
    ),
    "link_trust.agreement": lambda: (STAR.indptr, STAR.indices, STAR.is_open, 0, N, bools(len(STAR.indices))),
    "link_trust.is_around": lambda: (draft(), int(SHAPE.boundary[0]), int(SHAPE.boundary[1])),
    "link_trust.is_around an inner point": lambda: (draft(), ASTRAY, int(SHAPE.boundary[1])),
    "link_trust.is_beyond": lambda: (draft(), int(SHAPE.boundary[0]), int(SHAPE.boundary[2])),
    "link_trust.is_beyond an inner point": lambda: (draft(), ASTRAY, int(SHAPE.boundary[1])),
    "link_trust.mark_far": lambda: (
        mixed_draft(),
        *AROUND.table,
        2,
        20,
        np.arange(N, dtype=np.int32)[::-2].copy(),
        bools(N),
    ),
    "areas.cross": lambda: (1.0, 2.0, 3.0, 4.0),
    "areas.doubled_area": lambda: (SHAPE.uv, 0, 1, 0.1, 0.2),
    "locate.depth": lambda: (SHAPE.uv, SHAPE.triangles[5], 0.1, 0.2),
    "locate.find_triangle": lambda: (CUBICS.uv, CUBICS.triangles, CUBICS.boxes, 0.1, 0.2, 1e-15),
    "locate.holds": lambda: (CUBICS.boxes, 1, 0.1, 0.2, 0.0),
    "locate.next_box": lambda: (11,),
    "mean_value_weights.half_angle_tangent": lambda: (SHAPE.points, 0, 1, 2),
    "mean_value_weights.mean_value": lambda: (
        SHAPE.points,
        STAR.indptr,
        STAR.indices,
        STAR.is_open,
        0.3,
        0,
        N,
        np.zeros(len(STAR.indices)),
    ),
    "morton_curve.morton_keys": lambda: (SHAPE.points, CORNER, (2**21 - 1) / WIDTH, 21, 3, N, ints(N)),
    "morton_curve.morton_keys in a plane": lambda: (
        SHAPE.uv,
        SHAPE.uv.min(axis=0),
        (2**31 - 1) / 2.0,
        31,
        0,
        N,
        ints(N),
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
    "box_tree.bound_boxes": lambda: (SHAPE.points, np.zeros((16, 3)), np.zeros((16, 3))),
    "box_tree.find_nearest": lambda: (
        SHAPE.points,
        LOW,
        HIGH,
        np.arange(N, dtype=np.uint32)[::-1].copy(),
        np.zeros((N, 9), np.uint32),
        np.zeros((N, 9)),
    ),
    "box_tree.middle_distances": lambda: (SHAPE.points, *AROUND.table, 3, 4, 0, N, np.zeros(N)),
    "box_tree.square_to_box": lambda: (LOW, HIGH, 9, 0.1, -0.2, 2.0),
    "peel.peel": lambda: (EDGES.origins, EDGES.twins, SUCCESSOR, ints(len(EDGES.origins)), bools(len(SHAPE.triangles))),
    "tangent_planes.smallest_eigenvector": lambda: (3.0, 0.2, 0.1, 2.0, -0.3, 1.0),
    "tangent_planes.tangent_frame": lambda: (0.48, 0.6, -0.64),
    "tangent_planes.fit_planes": lambda: (SHAPE.points, *AROUND.table, 0.8, 0, N, np.zeros((N, 3)), np.zeros(N)),
    "radial_blend.add_product": lambda: (np.arange(6.0), np.arange(24.0).reshape(6, 4), np.ones((6, 4))),
    "radial_blend.divide": lambda: (np.arange(1.0, 25.0).reshape(6, 4),),
    "radial_blend.evaluate": lambda: (
        SPLINES.domain,
        SPLINES.discs,
        SPLINES.boxes,
        SPLINES.centres,
        SPLINES.coefficients,
        SHAPE.uv,
        4,
        0,
        N,
        np.zeros((N, 3)),
    ),
    "radial_blend.start_jet": lambda: (SHAPE.points[:6], 0.1, 0.2, np.zeros((6, 4))),
    "radial_blend.surface_jet": lambda: (
        SPLINES.centres[0],
        SPLINES.coefficients[0],
        0.1,
        0.2,
        0.3,
        2,
        np.zeros((6, 4)),
    ),
    "radial_blend.weight_jet": lambda: (0.1, 0.2, 0.5, np.zeros(6)),
    "recover_edges.edge_towards": lambda: (draft(), SHAPE.uv, 0, 40),
    "recover_edges.recover": lambda: (mixed_draft(), SHAPE.uv, RINGS.rows, RINGS.indices),
    "recover_edges.recover_one": lambda: (draft(), SHAPE.uv, 0, 40),
    "recover_edges.side": lambda: (SHAPE.uv, 0, 1, 2),
    "recover_edges.swappable": lambda: (
        draft(),
        SHAPE.uv,
        0,
        40,
        recover.edge_towards.py_func(draft(), SHAPE.uv, 0, 40),
        (-1, -1),
    ),
    "triangle_shapes.distance": lambda: (SHAPE.points, 3, 5),
    "triangle_shapes.measure_areas": lambda: (SHAPE.points, SHAPE.triangles, 2, 9, np.zeros(12)),
    "triangle_shapes.measure_plane_areas": lambda: (SHAPE.points[:, :2].copy(), SHAPE.triangles, 2, 9, np.zeros(12)),
    "triangle_shapes.measure_shapes": lambda: (SHAPE.points, SHAPE.triangles, 2, 9, np.zeros(12)),
    "triangle_shapes.measure_stretches": lambda: (
        SHAPE.points,
        SHAPE.triangles,
        SHAPE.points[:, :2].copy(),
        1.5,
        2,
        9,
        np.zeros(12),
        np.zeros(12),
    ),
    "put_back.cheapest_place": lambda: (draft(), 3, np.array([20, 21, 22])),
    "put_back.descend": lambda: (mixed_draft(), 0, np.resize(np.arange(3 * M), relocate.STACK), 3 * M, 1e-9),
    "put_back.put_in": lambda: (draft(), 0, ASTRAY, 0, 1, 2),
    "put_back.relocate": lambda: (
        mixed_draft(),
        np.arange(N, dtype=np.int32),
        ~bools(N),
        N,
        AROUND.indptr,
        AROUND.indices,
        1e-9,
        3 * N,
        bools(N),
    ),
    "put_back.relocate_one": lambda: (
        mixed_draft(),
        ASTRAY,
        AROUND.indices[9 * ASTRAY :][:9],
        ints(relocate.STACK),
        1e-9,
    ),
    "put_back.take_out": lambda: thinned_out(),
    "put_back.thin_out": lambda: (draft(), ASTRAY, drafts.inner_degree.py_func(draft(), ASTRAY)),
    "agreed_triangles.add_corner_angles": lambda: (SHAPE.points, unsigned(RAGGED.triangles), np.zeros(N)),
    "agreed_triangles.circumradius": lambda: (SHAPE.points, 0, 1, 2),
    "agreed_triangles.close_up": lambda: (
        RAGGED.sides.copy(),
        np.arange(M - 7) % 3 == 0,
        np.cumsum(np.arange(M - 7) % 3 > 0, dtype=np.int32) - 1,
    ),
    "agreed_triangles.collect_triangles": lambda: (
        SHAPE.points,
        STAR.indptr,
        STAR.indices,
        np.resize(np.arange(4, dtype=np.int8), len(STAR.indices)),
        STEP,
        0.6,
        int32s((len(STAR.indices), 3)),
        np.zeros(len(STAR.indices)),
        np.zeros(len(STAR.indices), np.int8),
    ),
    "agreed_triangles.count_at_edges": lambda: (FACE_EDGES, np.zeros(len(FACE_ENDS), np.int8), bools(len(FACES))),
    "agreed_triangles.count_votes": lambda: (
        STAR.indptr,
        STAR.indices,
        STAR.is_open,
        0,
        N,
        np.zeros(len(STAR.indices), np.int8),
    ),
    "agreed_triangles.draw_tight": lambda: (
        SHAPE.points,
        RAGGED.triangles,
        RAGGED.ends,
        RAGGED.edge_of,
        RAGGED.sides,
        ~bools(N),
        bools(N),
        int32s(N_EDGES + 2 * M),
        bools(M - 7),
    ),
    "agreed_triangles.join_alike": lambda: joining(9),
    "agreed_triangles.join_alike full": lambda: joining(len(FACES) - 1),
    "agreed_triangles.join_alike twisted": lambda: joining(len(FACES) - 3),
    "agreed_triangles.keep_manifold": lambda: untaken(),
    "agreed_triangles.name_edges": lambda: (
        FACES,
        ints(len(STRIP.points) + 1),
        int32s((3 * len(FACES), 2)),
        int32s(FACES.shape),
    ),
    "agreed_triangles.put_beside": lambda: (RAGGED.sides.copy(), int(np.flatnonzero(RAGGED.sides[:, 1] < 0)[0]), 5),
    "agreed_triangles.root_of": lambda: (
        np.array([0, 0, 1, 2, 3], np.int32),
        np.array([False, True, True, False, True]),
        4,
    ),
    "agreed_triangles.turn_alike": lambda: (taken()[0], taken()[3], *taken()[5:]),
    "agreed_triangles.walk_rims": lambda: (
        RAGGED.ends,
        RAGGED.edge_of,
        RAGGED.sides,
        bools(N_EDGES),
        ints(N_EDGES + 1),
        ints(N_EDGES + 1),
    ),
    "shape_preserving_weights.shape_preserving": lambda: (
        STAR.local,
        STAR.indptr,
        STAR.is_open,
        0,
        N,
        np.zeros(len(STAR.indices)),
    ),
    "sides.survey_sides": lambda: (
        SHAPE.points,
        NORMALS,
        *AROUND.table,
        0.8,
        0,
        N,
        np.zeros(N),
        np.zeros(N),
    ),
    "inversion.measure_sides": lambda: (2.0 * np.cos(ROUND), 2.0 * np.sin(ROUND), TURNS, 6),
    "inversion.measure_sides of more than half a turn": lambda: (np.cos(ROUND), np.sin(ROUND), TURNS, 3),
    "inversion.measure_sides of one neighbour": lambda: (np.cos(ROUND), np.sin(ROUND), TURNS, 1),
    "inversion.measure_sides of none": lambda: (np.cos(ROUND), np.sin(ROUND), TURNS, 0),
    "inversion.pseudo_angle": lambda: (-0.3, -2.0),
    "inversion.turns_left": lambda: (0.0, 0.0, 1.0, 0.0, 2.0, 0.5),
    "inversion.is_one_direction": lambda: (1.0, 2.0, 3.0, 6.0),
    "inversion.project": lambda: (
        SHAPE.points,
        NORMALS[4],
        4,
        AROUND.table[1][36:45],
        0.8,
        ints(9),
        np.zeros(9),
        np.zeros(9),
        np.zeros(9),
    ),
    "inversion.drop_hidden": lambda: (ints(4), np.array([1.0, 2, 0, 3]), np.array([0.0, 0, 1, 0]), 4),
    "inversion.gap_end": lambda: (RING_X[:3], RING_Y[:3], 3),
    "inversion.hull_of_inverses": lambda: (RING_X, RING_Y, 6, 1, False, np.zeros(6), np.zeros(6), ints(8)),
    "inversion.circumdiameter": lambda: (1.0, 0.2, -0.3, 1.0),
    "inversion.delaunay_stars": lambda: (
        SHAPE.points,
        NORMALS,
        *AROUND.table,
        0.8,
        0,
        N,
        np.zeros(9 * N, np.uint32),
        np.zeros((9 * N, 2)),
        ints(N),
        bools(N),
        bools(N),
        np.zeros(N),
        np.zeros(N),
        np.zeros(N),
    ),
    "swaps.angle_parts": lambda: (SHAPE.points, 0, 1, 2),
    "swaps.angle_sum_measure": lambda: (SHAPE.points, 0, 1, 2, 3),
    "swaps.are_joined": lambda: (EDGES.origins, EDGES.twins, INNER, int(EDGES.origins[INNER - 1])),
    "swaps.link": lambda: (ints(6), 2, 4),
    "swaps.swap": lambda: (EDGES.origins, EDGES.twins, INNER),
    "swaps.delaunay_swaps": lambda: (
        SHAPE.points,
        MIXED.origins,
        MIXED.twins,
        np.arange(len(MIXED.origins), dtype=np.int32)[::-1].copy(),
        len(MIXED.origins),
        ~bools(len(MIXED.origins)),
        int32s(len(MIXED.origins) // 3),
        bools(len(MIXED.origins)),
    ),
}


def kernels():
    found = {}
    for module in pkgutil.walk_packages(_kernels.__path__, f"{_kernels.__name__}."):
        loaded = importlib.import_module(module.name)
        for name, value in vars(loaded).items():
            if hasattr(value, "py_func") and value.py_func.__module__ == loaded.__name__:
                found[f"{module.name.rpartition('.')[2]}.{name}"] = value
    return found


def test_every_kernel_has_a_case():
    assert set(kernels()) == {name.split()[0] for name in CASES}


@pytest.mark.parametrize("name", CASES)
def test_a_compiled_kernel_equals_its_python_function(name):
    kernel, arguments = kernels()[name.split()[0]], CASES[name]()
    compiled, plain = copy.deepcopy(arguments), copy.deepcopy(arguments)
    answers = kernel(*compiled), kernel.py_func(*plain)
    assert np.allclose(*map(numbers, answers), rtol=1e-12, atol=1e-14, equal_nan=True)
    for one, other in zip(arrays(compiled), arrays(plain), strict=True):
        # Compiled sums of single numbers are of double ones.
        rtol, atol = (1e-6, 1e-7) if one.dtype == np.float32 else (1e-12, 1e-14)
        assert np.allclose(one, other, rtol=rtol, atol=atol)


def numbers(answer):
    """All numbers of an answer, which may be a tuple of tuples."""
    if isinstance(answer, tuple):
        return np.concatenate([numbers(part) for part in answer])
    return np.array(answer, dtype=float).ravel()


def arrays(arguments):
    """All arrays among arguments and in the drafts among them."""
    for argument in arguments:
        if isinstance(argument, np.ndarray):
            yield argument
        elif isinstance(argument, tuple):
            yield from arrays(argument)


def test_a_far_side_becomes_an_edge_and_no_triangle_turns_over():
    changed = draft_in_plane()
    assert constrain.insert_side(changed, ints(N) - 1, *FAR) == -1
    triangles = changed.corners.reshape(-1, 3)
    assert np.isin(triangles, FAR).sum(axis=1).tolist().count(2) == 2
    assert (orientation_signs(SHAPE.uv, triangles) == 1).all()


def test_a_side_stops_at_a_point_on_it_and_at_a_side_across_it():
    places = np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1], [-0.5, 0], [0.5, 0], [0, 0.0]])
    ahead = ints(7) - 1
    ahead[4] = 5
    for middle, found in ((0.0, [6]), (0.1, [-1])):
        places[6, 1] = middle
        mesh = start_draft(places, triangulate(places, np.arange(4)), journal=2)
        assert constrain.insert_side(mesh, ahead, 4, 5) in found
    ahead[6] = 1
    places[6, 1] = 0.2
    mesh = start_draft(places, triangulate(places, np.arange(4)), journal=2)
    assert constrain.constrain(mesh, ahead) != (-1, -1)


@pytest.mark.parametrize("h", range(9))
def test_following_and_preceding_half_edges_are_inverse(h):
    assert half_edge_kernels.following(half_edge_kernels.preceding(h)) == h
    assert half_edge_kernels.following(h) // 3 == h // 3


@pytest.mark.parametrize("fading", [0.0, 0.5, 0.8])
def test_fitted_planes_are_those_of_the_last_singular_vectors_of_the_weighted_neighbours(fading):
    normals, offsets = np.empty((N, 3)), np.empty(N)
    planes.fit_planes(SHAPE.points, *AROUND.table, fading, 0, N, normals, offsets)
    for i in range(N):
        near = SHAPE.points[np.r_[i, AROUND.indices[AROUND.indptr[i] : AROUND.indptr[i + 1]]]]
        square = ((near - near[0]) ** 2).sum(axis=1)
        weight = (1 - fading * square / square.max()) ** 2
        middle = weight @ near / weight.sum()
        expected = np.linalg.svd(np.sqrt(weight)[:, None] * (near - middle))[2][2]
        assert abs(normals[i] @ expected) == pytest.approx(1, abs=1e-12)
        assert offsets[i] == pytest.approx((middle - near[0]) @ normals[i], abs=1e-12)


def test_drawing_tight_takes_each_triangle_with_an_obtuse_corner_off_the_rim():
    arguments = CASES["agreed_triangles.draw_tight"]()
    on_rim, removed = arguments[6], arguments[8]
    was_on_rim = np.zeros(N, bool)
    was_on_rim[RAGGED.ends[(RAGGED.sides[:, 0] >= 0) & (RAGGED.sides[:, 1] < 0)]] = True
    rims.draw_tight(*arguments)
    assert removed.sum() == (on_rim & ~was_on_rim).sum() > 0


@pytest.mark.parametrize("k", [3, 4, 6, 12])
def test_neighbours_on_a_regular_polygon_leave_equal_angles_and_no_offset(k):
    turn = 2 * np.pi * np.arange(k) / k + 0.1
    points = np.r_[[[0.0, 0, 0]], np.c_[np.cos(turn), np.sin(turn), 0 * turn]]
    angle, offset = np.empty(1), np.empty(1)
    up = np.array([[0.0, 0, 1]])
    sides.survey_sides(points, up, np.array([0, k]), np.arange(1, k + 1), 0.8, 0, 1, angle, offset)
    assert angle[0] == pytest.approx(2 * np.pi / k)
    assert offset[0] == pytest.approx(0, abs=1e-15)


def free_angle(radius, turn):
    """Return the widest gap that neighbours in the plane z = 0 leave at the origin."""
    points = np.r_[[[0.0, 0, 0]], np.c_[radius * np.cos(turn), radius * np.sin(turn), 0 * turn]]
    angle, offset, up = np.empty(1), np.empty(1), np.array([[0.0, 0, 1]])
    sides.survey_sides(points, up, np.array([0, len(turn)]), np.arange(1, len(turn) + 1), 0.8, 0, 1, angle, offset)
    return angle[0]


@pytest.mark.parametrize("k", [3, 5, 8])
def test_neighbours_behind_each_other_leave_no_gap_between_them(k):
    radius, turn = 1 + np.arange(3 * k) // k, 2 * np.pi * np.arange(3 * k) / k
    for first in np.linspace(0, 2 * np.pi, 100):
        assert free_angle(radius, turn + first) == pytest.approx(2 * np.pi / k)


@pytest.mark.parametrize("n", [1, 2, 5])
def test_neighbours_in_one_direction_leave_all_others_free(n):
    for turn in np.linspace(0, 2 * np.pi, 100):
        assert free_angle(1.0 + np.arange(n), np.full(n, turn)) == pytest.approx(2 * np.pi)


def test_a_point_that_has_no_flat_neighbour_is_free_all_round():
    points = np.array([[0.0, 0, 0], [0, 0, 1], [0.1, 0, -1]])
    angle, offset = np.empty(1), np.empty(1)
    up = np.array([[0.0, 0, 1]])
    sides.survey_sides(points, up, np.array([0, 2]), np.array([1, 2]), 0.8, 0, 1, angle, offset)
    assert (angle[0], offset[0]) == (2 * np.pi, 1.0)


# Unsigned indices


@pytest.mark.parametrize(("kind", "wanted"), [(np.int32, np.uint32), (np.int64, np.uint64)])
def test_an_unsigned_view_shares_memory_and_keeps_values(kind, wanted):
    signed = np.array([0, 7, np.iinfo(kind).max], kind)
    for array in (signed, signed[::2], signed[:0]):
        view = unsigned(array)
        assert view.dtype == wanted
        assert view.tolist() == array.tolist()
    unsigned(signed)[1] = 5
    assert signed[1] == 5


@pytest.mark.parametrize("kind", [np.uint32, np.uint64, np.bool_, np.float64])
def test_what_has_no_sign_to_lose_stays_as_it_is(kind):
    array = np.arange(3).astype(kind)
    assert unsigned(array).dtype == array.dtype
    assert np.shares_memory(unsigned(array), array)


@pytest.mark.parametrize("kind", [np.int32, np.int64, np.uint32])
def test_a_table_has_the_rows_of_the_neighbourhoods_in_the_same_types_always(kind):
    around = Neighborhoods(AROUND.indptr.astype(kind), AROUND.indices.astype(kind))
    indptr, indices = around.table
    assert (indptr.dtype, indices.dtype) == (np.uint64, np.uint32)
    assert np.array_equal(indptr, AROUND.indptr)
    assert np.array_equal(indices, AROUND.indices)


# The nearest


def check_nearest(points, k, queries=None):
    """Compare distances with those of all points, as points at the same distance may come in any order."""
    found = BoxTree(points).nearest(k, queries)
    asked = np.arange(len(points)) if queries is None else queries
    square = ((points[:, None] - points[None]) ** 2).sum(axis=2)
    np.fill_diagonal(square, np.inf)
    assert found.shape == (len(asked), min(k, len(points) - 1))
    assert all(len(set(row)) == len(row) for row in found.tolist())
    far = np.take_along_axis(square[asked], found, axis=1)
    assert np.allclose(far, np.sort(square[asked], axis=1)[:, : found.shape[1]], rtol=1e-12, atol=0)


@settings(max_examples=40)
@given(st.integers(2, 70), st.integers(1, 80), seeds)
def test_the_nearest_are_found_where_each_point_is_far_from_the_one_before(n, k, seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(n, 3)) * 10.0 ** rng.uniform(-3, 3, (n, 1))
    check_nearest(points, k)
    check_nearest(points, k, rng.integers(0, n, 2 * n))


@settings(max_examples=40)
@given(integer_sets(), st.integers(1, 30), seeds)
def test_the_nearest_are_found_where_many_are_at_one_distance(cells, k, seed):
    rng = np.random.default_rng(seed)
    check_nearest(np.c_[rng.permutation(cells), np.zeros(len(cells))], k, rng.integers(0, len(cells), 40))


@settings(max_examples=40)
@given(st.integers(1, 20), st.integers(1, 20), st.integers(1, 25), st.floats(2, 9), seeds)
def test_the_nearest_are_found_in_clusters_far_apart(n_here, n_there, k, exponent, seed):
    rng = np.random.default_rng(seed)
    here, there = rng.random((n_here, 3)), rng.random((n_there, 3)) + 10.0**exponent
    points = np.r_[here, there]
    for cloud in (points, rng.permutation(points)):
        check_nearest(cloud, k)
        check_nearest(cloud, k, rng.permutation(len(cloud)))


@pytest.mark.parametrize("k", [1, 2, 5, 40])
def test_points_that_coincide_are_the_nearest_of_each_other_though_asked_for_in_turn(k):
    check_nearest(np.repeat(SHAPE.points[:12], 3, axis=0), k)
    check_nearest(SHAPE.points[:12], k, np.repeat(np.arange(12), 2))


# Stars


@pytest.mark.parametrize("k", [4, 6, 9])
def test_a_star_is_short_exactly_if_it_is_closed_and_a_circle_reaches_beyond_the_last_candidate(k):
    around = nearest(SHAPE.points, k)
    star, local, count = np.zeros(k * N, np.uint32), np.zeros((k * N, 2)), ints(N)
    is_open, is_short, (width, angle, offset) = bools(N), bools(N), np.zeros((3, N))
    where = SHAPE.points, normals(SHAPE.points, around), *around.table, 0.8, 0, N
    stars.delaunay_stars(*where, star, local, count, is_open, is_short, width, angle, offset)
    last = SHAPE.points[around.indices[around.indptr[1:] - 1]]
    reach = np.linalg.norm(last - SHAPE.points, axis=1)
    assert np.array_equal(np.isinf(width), is_open)
    assert np.array_equal(is_short, ~is_open & (2 * width > reach))
    assert is_short.any()
