"""Arguments for every kernel of the room `mesh`."""

import numpy as np

from kernel_cases.samples import (
    AROUND,
    ASTRAY,
    RAGGED,
    SHAPE,
    STEP,
    WITHIN,
    M,
    N,
    bools,
    draft,
    int32s,
    ints,
    mixed_draft,
)
from pointchart._kernels.mesh import editable, pinches, put_back, recover_edges
from pointchart._kernels.unsigned import unsigned
from pointchart.mesh.connectivity import half_edges, one_rings
from pointchart.shapes import disc

EDGES = half_edges(SHAPE.triangles, N)
RINGS = one_rings(SHAPE.triangles, N)
MIXED = half_edges(disc(60, seed=1).triangles, N)
FIRST = np.zeros(N, np.int64)
FIRST[EDGES.origins] = np.arange(len(EDGES.origins))
INNER = int(np.flatnonzero(EDGES.twins >= 0)[0])
SUCCESSOR = np.full(N, -1, np.int64)
SUCCESSOR[SHAPE.boundary] = np.roll(SHAPE.boundary, -1)
SUCCESSOR[SHAPE.boundary[3]] = SHAPE.boundary[5]

# A surface with gaps that touch, and two with a gap around one point or more.
TORN = half_edges(SHAPE.triangles[np.random.default_rng(4).random(M) < 0.6], N)
GAPPED = half_edges(SHAPE.triangles[~np.isin(SHAPE.triangles, WITHIN[:3]).any(axis=1)], N)
HOLED = half_edges(SHAPE.triangles[(SHAPE.triangles != ASTRAY).all(axis=1)], N)
AHEAD, BEHIND = np.full((2, N), -1, np.int32)
AHEAD[SHAPE.boundary], BEHIND[SHAPE.boundary] = np.roll(SHAPE.boundary, -1), np.roll(SHAPE.boundary, 1)


def rims_of(edges):
    numbers = int32s(len(edges.twins))
    pinches.mark_rims.py_func(edges.twins, numbers)
    return numbers


def pocket_of(edges):
    """Return corners and twins with room for more, the loop that is not the boundary, and the first free place."""
    room, numbers, boundary = np.full(90, -1, np.int32), rims_of(edges), SHAPE.boundary.tolist()
    h = k = next(h for h in np.flatnonzero(edges.twins < 0) if edges.origins[h] not in boundary)
    loop = []
    while not loop or k != h:
        loop.append(k)
        k = pinches.along_rim.py_func(edges.twins, k)
    assert set(numbers[loop]) == {numbers[h]}
    return np.r_[edges.origins, room], np.r_[edges.twins, room], np.array(loop, np.int64), len(edges.twins) // 3


def walks_of(edges):
    size = len(edges.twins)
    scratch = int32s(N) - 1, ints(size), ints(size), ints(size + 1)
    return edges.origins, edges.twins, AHEAD, BEHIND, *scratch, ~bools(size // 3)


def changed_draft():
    changed = draft()
    editable.swap_noted.py_func(changed, 0, INNER)
    return changed


def thinned_out():
    thin = draft()
    n, _ = put_back.thin_out.py_func(thin, ASTRAY, editable.inner_degree.py_func(thin, ASTRAY))
    h = int(thin.leaving[ASTRAY])
    one = editable.next_around.py_func(thin, h)
    return thin, n, ASTRAY, h, one, editable.next_around.py_func(thin, one)


CASES = {
    "pockets.add_ear": lambda: (*pocket_of(HOLED)[:2], *pocket_of(HOLED)[2][:2].tolist(), M),
    "pinches.along_rim": lambda: (TORN.twins, int(np.flatnonzero(TORN.twins < 0)[3])),
    "pockets.cap": lambda: (SHAPE.points, *pocket_of(GAPPED)),
    "pockets.cap around one point": lambda: (SHAPE.points, *pocket_of(HOLED)),
    "pinches.close_loop": lambda: (
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
    "pinches.cut_walks": lambda: walks_of(TORN),
    "pinches.drop_closed_fan": lambda: (EDGES.twins, int(FIRST[ASTRAY]), ~bools(M)),
    "pinches.drop_fan": lambda: (TORN.twins, int(np.flatnonzero(TORN.twins < 0)[3]), ~bools(M)),
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
    "pinches.fan_size": lambda: (
        TORN.origins,
        TORN.twins,
        int(np.flatnonzero(TORN.twins < 0)[3]),
        int(SHAPE.boundary[0]),
        int(SHAPE.boundary[2]),
    ),
    "pinches.keep_largest": lambda: (TORN.twins, np.arange(len(TORN.twins) // 3) % 9 > 0),
    "pinches.mark_pinching": lambda: (
        TORN.origins,
        TORN.twins,
        rims_of(TORN),
        AHEAD,
        BEHIND,
        int32s(N) - 1,
        ~bools(len(TORN.twins) // 3),
    ),
    "pinches.mark_rims": lambda: (TORN.twins, int32s(len(TORN.twins))),
    "pinches.to_half_edges": lambda: (
        RAGGED.triangles,
        RAGGED.edge_of,
        RAGGED.sides,
        np.where(np.arange(M - 7) % 5 > 0, np.cumsum(np.arange(M - 7) % 5 > 0, dtype=np.int32) - 1, -1),
        int32s(3 * M),
        int32s(3 * M),
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
    "editable.anchor": lambda: (draft(), 5),
    "editable.first_around": lambda: (draft(), int(SHAPE.boundary[0])),
    "editable.inner_degree": lambda: (draft(), ASTRAY),
    "editable.next_around": lambda: (draft(), INNER),
    "editable.record": lambda: (draft(), 2, 5),
    "editable.swap_noted": lambda: (draft(), 0, INNER),
    "editable.undo": lambda: (changed_draft(), 2),
    "energy.alone_energy": lambda: (draft(), *EDGES.origins[6:9].tolist(), 6, 7, 8),
    "energy.bend_across": lambda: (draft(), INNER, (0.3, 0.2, 0.6, 0.7)),
    "energy.bend_energy": lambda: (SHAPE.points, 0, 1, (0.3, 0.2, 0.6, 0.7), (0.6, 0.2, 0.3, 0.7)),
    "energy.pair_energy": lambda: (draft(), 0, 1, 2, 3, 6, 7, 8, 9),
    "energy.swap_gain": lambda: (draft(), INNER),
    "energy.tent_energy": lambda: (draft(), 20, *EDGES.origins[6:9].tolist(), 6, 7, 8),
    "energy.total_energy": lambda: (draft(),),
    "energy.triangle_energy": lambda: (SHAPE.points, 0, 1, 2),
    "far_links.is_around": lambda: (draft(), int(SHAPE.boundary[0]), int(SHAPE.boundary[1])),
    "far_links.is_around an inner point": lambda: (draft(), ASTRAY, int(SHAPE.boundary[1])),
    "far_links.is_beyond": lambda: (draft(), int(SHAPE.boundary[0]), int(SHAPE.boundary[2])),
    "far_links.is_beyond an inner point": lambda: (draft(), ASTRAY, int(SHAPE.boundary[1])),
    "far_links.mark_far": lambda: (
        mixed_draft(),
        *AROUND.table,
        2,
        20,
        np.arange(N, dtype=np.int32)[::-2].copy(),
        bools(N),
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
    "peel.peel": lambda: (EDGES.origins, EDGES.twins, SUCCESSOR, ints(len(EDGES.origins)), bools(len(SHAPE.triangles))),
    "recover_edges.edge_towards": lambda: (draft(), SHAPE.uv, 0, 40),
    "recover_edges.recover": lambda: (mixed_draft(), SHAPE.uv, RINGS.rows, RINGS.indices),
    "recover_edges.recover_one": lambda: (draft(), SHAPE.uv, 0, 40),
    "recover_edges.side": lambda: (SHAPE.uv, 0, 1, 2),
    "recover_edges.swappable": lambda: (
        draft(),
        SHAPE.uv,
        0,
        40,
        recover_edges.edge_towards.py_func(draft(), SHAPE.uv, 0, 40),
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
    "put_back.descend": lambda: (mixed_draft(), 0, np.resize(np.arange(3 * M), put_back.STACK), 3 * M, 1e-9),
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
        ints(put_back.STACK),
        1e-9,
    ),
    "put_back.take_out": lambda: thinned_out(),
    "put_back.thin_out": lambda: (draft(), ASTRAY, editable.inner_degree.py_func(draft(), ASTRAY)),
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
