import copy
import importlib
import pkgutil

import numpy as np
import pytest

from pointchart import _kernels
from pointchart._kernels import half_edges as half_edge_kernels
from pointchart._kernels import planes, rims, sides
from pointchart.mesh import half_edges, one_rings
from pointchart.neighbors import nearest
from pointchart.shapes import disc, relief
from pointchart.stars import delaunay_star, normals

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


M = len(SHAPE.triangles)
ENDS, EDGE_OF = ints((3 * M, 2)), ints((M, 3))
ENDS = ENDS[: rims.name_edges(SHAPE.triangles, ints(N + 1), ENDS, EDGE_OF)].copy()
SIDES = ints((len(ENDS), 2)) - 1
rims.keep_manifold(np.arange(M - 5), EDGE_OF, SIDES)
RAGGED = ints((len(ENDS), 2)) - 1
rims.keep_manifold(np.arange(7, M), EDGE_OF, RAGGED)

PENTAGRAM = np.array([[np.cos(t), np.sin(t)] for t in np.arange(5) * 0.8 * np.pi])
X_ENDS = np.column_stack([PENTAGRAM[:, 0], np.roll(PENTAGRAM[:, 0], -1)])
SWEEP = (np.argsort(X_ENDS.min(axis=1)), X_ENDS.min(axis=1), X_ENDS.max(axis=1))

CASES = {
    "crossings.find_crossing": lambda: (PENTAGRAM, *SWEEP, ints((320, 2))),
    "crossings.turn": lambda: (0.0, 0.0, 1.0, 0.0, 0.5, 1e-300),
    "graphs.dominators": lambda: (TREE[0], *GRAPH, 0, np.arange(5), np.array([0, -1, -1, -1, -1])),
    "graphs.symmetrizer": lambda: (
        *TREE,
        np.array([0, 2, 5, 6, 7, 8]),
        np.array([1, 2, 0, 3, 4, 0, 1, 1]),
        -np.array([0.5, 0.5, 0.2, 0.4, 0.4, 1.0, 1.0, 1.0]),
        np.zeros(5),
    ),
    "half_edges.following": lambda: (5,),
    "half_edges.preceding": lambda: (3,),
    "half_edges.pair_half_edges": lambda: (
        EDGES.origins,
        N,
        ints(3 * M),
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
    "links.are_adjacent": lambda: (
        STAR.indptr,
        STAR.indices,
        STAR.is_open,
        0,
        int(STAR.indices[0]),
        int(STAR.indices[1]),
    ),
    "links.agreement": lambda: (STAR.indptr, STAR.indices, STAR.is_open, 0, N, bools(len(STAR.indices))),
    "links.within_two_edges": lambda: (
        AROUND.indptr,
        AROUND.indices,
        RINGS.indptr,
        RINGS.indices,
        0,
        N,
        bools(len(AROUND.indices)),
    ),
    "peel.peel": lambda: (EDGES.origins, EDGES.twins, SUCCESSOR, ints(len(EDGES.origins)), bools(len(SHAPE.triangles))),
    "planes.smallest_eigenvector": lambda: (3.0, 0.2, 0.1, 2.0, -0.3, 1.0),
    "planes.tangent_frame": lambda: (0.48, 0.6, -0.64),
    "planes.fit_planes": lambda: (
        SHAPE.points,
        AROUND.indptr,
        AROUND.indices,
        0.8,
        0,
        N,
        np.zeros((N, 3)),
        np.zeros(N),
    ),
    "rims.count_votes": lambda: (STAR.indptr, STAR.indices, STAR.is_open, 0, N, ints(len(STAR.indices))),
    "rims.name_edges": lambda: (SHAPE.triangles, ints(N + 1), ints((3 * M, 2)), ints((M, 3))),
    "rims.keep_manifold": lambda: (np.arange(M)[::-1].copy(), EDGE_OF, ints((len(ENDS), 2)) - 1),
    "rims.draw_tight": lambda: (
        SHAPE.points,
        SHAPE.triangles,
        ENDS,
        EDGE_OF,
        RAGGED.copy(),
        ~bools(N),
        bools(N),
        ints(len(ENDS) + 2 * M),
        bools(M),
    ),
    "rims.walk_rims": lambda: (ENDS, EDGE_OF, SIDES, bools(len(ENDS)), ints(len(ENDS) + 1), ints(len(ENDS) + 1)),
    "shape_preserving.shape_preserving": lambda: (
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
        AROUND.indptr,
        AROUND.indices,
        0.8,
        0,
        N,
        np.zeros(N),
        np.zeros(N),
    ),
    "sides.star_widths": lambda: (STAR.indptr, STAR.local, STAR.is_open, 0, N, np.zeros(N)),
    "stars.pseudo_angle": lambda: (-0.3, -2.0),
    "stars.turns_left": lambda: (0.0, 0.0, 1.0, 0.0, 2.0, 0.5),
    "stars.is_one_direction": lambda: (1.0, 2.0, 3.0, 6.0),
    "stars.project": lambda: (
        SHAPE.points,
        NORMALS[4],
        4,
        AROUND.indices[36:45],
        0.8,
        ints(9),
        np.zeros(9),
        np.zeros(9),
        np.zeros(9),
    ),
    "stars.gap_end": lambda: (RING_X[:3], RING_Y[:3], 3),
    "stars.hull_of_inverses": lambda: (RING_X, RING_Y, 6, 0, False, ints(8)),
    "stars.circumdiameter": lambda: (1.0, 0.2, -0.3, 1.0),
    "stars.delaunay_stars": lambda: (
        SHAPE.points,
        NORMALS,
        AROUND.indptr,
        AROUND.indices,
        0.8,
        0,
        N,
        ints(9 * N),
        np.zeros((9 * N, 2)),
        ints(N),
        bools(N),
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
        ints(len(MIXED.origins)),
        bools(len(MIXED.origins)),
        ints(len(MIXED.origins) // 3),
    ),
}


def kernels():
    found = {}
    for module in pkgutil.iter_modules(_kernels.__path__):
        loaded = importlib.import_module(f"pointchart._kernels.{module.name}")
        for name, value in vars(loaded).items():
            if hasattr(value, "py_func") and value.py_func.__module__ == loaded.__name__:
                found[f"{module.name}.{name}"] = value
    return found


def test_every_kernel_has_a_case():
    assert set(kernels()) == set(CASES)


@pytest.mark.parametrize("name", CASES)
def test_a_compiled_kernel_equals_its_python_function(name):
    kernel, arguments = kernels()[name], CASES[name]()
    compiled, plain = copy.deepcopy(arguments), copy.deepcopy(arguments)
    answers = kernel(*compiled), kernel.py_func(*plain)
    assert np.allclose(*[np.array(answer, dtype=float) for answer in answers], rtol=1e-12, atol=1e-14, equal_nan=True)
    for one, other in zip(compiled, plain, strict=True):
        if isinstance(one, np.ndarray):
            assert np.allclose(one, other, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("h", range(9))
def test_following_and_preceding_half_edges_are_inverse(h):
    assert half_edge_kernels.following(half_edge_kernels.preceding(h)) == h
    assert half_edge_kernels.following(h) // 3 == h // 3


@pytest.mark.parametrize("fading", [0.0, 0.5, 0.8])
def test_fitted_planes_are_those_of_the_last_singular_vectors_of_the_weighted_neighbours(fading):
    normals, offsets = np.empty((N, 3)), np.empty(N)
    planes.fit_planes(SHAPE.points, AROUND.indptr, AROUND.indices, fading, 0, N, normals, offsets)
    for i in range(N):
        near = SHAPE.points[np.r_[i, AROUND.indices[AROUND.indptr[i] : AROUND.indptr[i + 1]]]]
        square = ((near - near[0]) ** 2).sum(axis=1)
        weight = (1 - fading * square / square.max()) ** 2
        middle = weight @ near / weight.sum()
        expected = np.linalg.svd(np.sqrt(weight)[:, None] * (near - middle))[2][2]
        assert abs(normals[i] @ expected) == pytest.approx(1, abs=1e-12)
        assert offsets[i] == pytest.approx((middle - near[0]) @ normals[i], abs=1e-12)


def test_drawing_tight_takes_each_triangle_with_an_obtuse_corner_off_the_rim():
    arguments = CASES["rims.draw_tight"]()
    on_rim, removed = arguments[6], arguments[8]
    was_on_rim = np.zeros(N, bool)
    was_on_rim[ENDS[(RAGGED[:, 0] >= 0) & (RAGGED[:, 1] < 0)]] = True
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


def test_a_point_that_has_no_flat_neighbour_is_free_all_round():
    points = np.array([[0.0, 0, 0], [0, 0, 1], [0.1, 0, -1]])
    angle, offset = np.empty(1), np.empty(1)
    up = np.array([[0.0, 0, 1]])
    sides.survey_sides(points, up, np.array([0, 2]), np.array([1, 2]), 0.8, 0, 1, angle, offset)
    assert (angle[0], offset[0]) == (2 * np.pi, 1.0)
