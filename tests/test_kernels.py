import copy
import importlib
import pkgutil

import numpy as np
import pytest

from pointchart import _kernels
from pointchart._exact import orientation_signs
from pointchart._kernels import constrain, drafts, planes, recover, relocate, rims, sides
from pointchart._kernels import half_edges as half_edge_kernels
from pointchart.fit import fit_radial, interpolate_clough_tocher
from pointchart.intersections import box_tree
from pointchart.mesh import half_edges, one_rings, start_draft
from pointchart.neighbors import nearest
from pointchart.shapes import disc, relief
from pointchart.stars import delaunay_star, normals
from pointchart.triangulate import triangulate

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
SPANS = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [9, 9, 0], [5, 5, 0], [6, 5, 0], [5, 6, 0]])
SPAN_BOXES = box_tree(SPANS[::3], SPANS[1::3], SPANS[2::3])
SWEEP = (np.argsort(X_ENDS.min(axis=1)), X_ENDS.min(axis=1), X_ENDS.max(axis=1))

CUBICS = interpolate_clough_tocher(SHAPE.points, SHAPE.uv, SHAPE.triangles)
SPLINES = fit_radial(SHAPE.points, SHAPE.uv, nearby=20)

KNOTS_U = np.array([-1.0, -1, -1, -1, -0.2, 0.3, 0.3, 1, 1, 1, 1])
KNOTS_V = np.array([-1.0, -1, -1, -1, 0.1, 1, 1, 1, 1])
CONTROL = np.random.default_rng(5).normal(size=(7, 5, 3))
WEIGHTS = np.linspace(0.5, 2.0, N)

WITHIN = np.setdiff1d(np.arange(N), SHAPE.boundary)
FAR = int(WITHIN[0]), int(WITHIN[np.argmax(((SHAPE.uv - SHAPE.uv[WITHIN[0]]) ** 2).sum(axis=1)[WITHIN])])
ASTRAY = int(np.setdiff1d(np.arange(N), SHAPE.boundary)[7])


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


CASES = {
    "bsplines.basis": lambda: (KNOTS_U, 3, 4, 0.1, 2, np.zeros((3, 4)), np.zeros((4, 4)), np.zeros((2, 4))),
    "bsplines.basis_rows": lambda: (KNOTS_U, 3, SHAPE.uv[:, 0].copy(), 1, np.zeros((N, 4)), ints((N, 4))),
    "bsplines.evaluate": lambda: (KNOTS_U, KNOTS_V, 3, CONTROL, SHAPE.uv, 1, 2, 0, N, np.zeros((N, 3))),
    "bsplines.find_span": lambda: (KNOTS_U, 3, 0.3),
    "bsplines.gather": lambda: (
        KNOTS_U,
        KNOTS_V,
        3,
        SHAPE.uv,
        SHAPE.points,
        WEIGHTS,
        np.zeros((35, 7, 7)),
        np.zeros((35, 3)),
    ),
    "clough_tocher.contract": lambda: (SHAPE.points[:10].copy(), 3, 0.2, 0.5, 0.3),
    "clough_tocher.coordinates": lambda: (SHAPE.uv, SHAPE.triangles[5], 0.1, 0.2, np.zeros((3, 3))),
    "clough_tocher.evaluate": lambda: (
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
    "clough_tocher.write_net": lambda: (
        CUBICS.points,
        CUBICS.gradients,
        CUBICS.uv,
        CUBICS.triangles[5],
        CUBICS.crossings[5],
        1,
        np.zeros((10, 3)),
    ),
    "constrain.constrain": lambda: (draft_in_plane(), np.where(np.arange(N) == FAR[0], FAR[1], -1)),
    "constrain.edge_before": lambda: (draft_in_plane(), *FAR),
    "constrain.exact_turn": lambda: (np.array([[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]]), 0, 1, 2),
    "constrain.insert_side": lambda: (draft_in_plane(), ints(N) - 1, *FAR),
    "constrain.sign_of_sum": lambda: (np.array([1e16, 1.0, -1e16, -1.0, 1e-30]),),
    "constrain.two_product": lambda: (0.1, 0.3),
    "constrain.two_sum": lambda: (1e16, 1.1),
    "constrain.unfold": lambda: (draft_in_plane(), int(draft_in_plane().leaving[FAR[0]]), 2),
    "crossings.find_crossing": lambda: (PENTAGRAM, *SWEEP, ints((320, 2))),
    "crossings.turn": lambda: (0.0, 0.0, 1.0, 0.0, 0.5, 1e-300),
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
    "intersections.side": lambda: (SHAPE.points, 0, 1, 2, 3),
    "intersections.sides_of": lambda: (SPANS, (0, 1, 2), (3, 4, 5)),
    "intersections.pierces": lambda: (SPANS, (3, 4, 5), (-1, 1, 0), (0, 1, 2)),
    "intersections.is_apart_in_plane": lambda: (SPANS, (0, 1, 2), (6, 7, 8), 0, 1),
    "intersections.meet": lambda: (SPANS, (0, 1, 2), (3, 4, 5)),
    "intersections.overlap": lambda: (SPAN_BOXES, 3, (0.5, 0.5, -0.5, 2.0, 2.0, 0.5)),
    "intersections.find_meetings": lambda: (SPANS, np.arange(9).reshape(3, 3), SPAN_BOXES, ints((2, 3))),
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
    "locate.depth": lambda: (SHAPE.uv, SHAPE.triangles[5], 0.1, 0.2),
    "locate.doubled_area": lambda: (SHAPE.uv, 0, 1, 0.1, 0.2),
    "locate.find_triangle": lambda: (CUBICS.uv, CUBICS.triangles, CUBICS.boxes, 0.1, 0.2, 1e-15),
    "locate.holds": lambda: (CUBICS.boxes, 1, 0.1, 0.2, 0.0),
    "locate.next_box": lambda: (11,),
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
    "radial.add_product": lambda: (np.arange(6.0), np.arange(24.0).reshape(6, 4), np.ones((6, 4))),
    "radial.divide": lambda: (np.arange(1.0, 25.0).reshape(6, 4),),
    "radial.evaluate": lambda: (
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
    "radial.start_jet": lambda: (SHAPE.points[:6], 0.1, 0.2, np.zeros((6, 4))),
    "radial.surface_jet": lambda: (
        SPLINES.centres[0],
        SPLINES.coefficients[0],
        0.1,
        0.2,
        0.3,
        2,
        np.zeros((6, 4)),
    ),
    "radial.weight_jet": lambda: (0.1, 0.2, 0.5, np.zeros(6)),
    "recover.edge_towards": lambda: (draft(), SHAPE.uv, 0, 40),
    "recover.recover": lambda: (mixed_draft(), SHAPE.uv, RINGS.rows, RINGS.indices),
    "recover.recover_one": lambda: (draft(), SHAPE.uv, 0, 40),
    "recover.side": lambda: (SHAPE.uv, 0, 1, 2),
    "recover.swappable": lambda: (
        draft(),
        SHAPE.uv,
        0,
        40,
        recover.edge_towards.py_func(draft(), SHAPE.uv, 0, 40),
        (-1, -1),
    ),
    "relocate.cheapest_place": lambda: (draft(), 3, np.array([20, 21, 22])),
    "relocate.descend": lambda: (mixed_draft(), 0, np.resize(np.arange(3 * M), relocate.STACK), 3 * M, 1e-9),
    "relocate.put_in": lambda: (draft(), 0, ASTRAY, 0, 1, 2),
    "relocate.relocate": lambda: (
        mixed_draft(),
        np.arange(N),
        ~bools(N),
        N,
        AROUND.indptr,
        AROUND.indices,
        1e-9,
        3 * N,
    ),
    "relocate.relocate_one": lambda: (
        mixed_draft(),
        ASTRAY,
        AROUND.indices[9 * ASTRAY :][:9],
        ints(relocate.STACK),
        1e-9,
    ),
    "relocate.take_out": lambda: thinned_out(),
    "relocate.thin_out": lambda: (draft(), ASTRAY, drafts.inner_degree.py_func(draft(), ASTRAY)),
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
    assert np.allclose(*map(numbers, answers), rtol=1e-12, atol=1e-14, equal_nan=True)
    for one, other in zip(arrays(compiled), arrays(plain), strict=True):
        assert np.allclose(one, other, rtol=1e-12, atol=1e-14)


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
