"""Arguments for every kernel of the room `agreement`."""

import numpy as np

from kernel_cases.samples import (
    RAGGED,
    SHAPE,
    STAR,
    STEP,
    M,
    N,
    bools,
    int32s,
    ints,
)
from pointchart._kernels.agreement import agreed_triangles, manifold_patches
from pointchart._kernels.unsigned import unsigned
from pointchart.shapes import moebius

N_EDGES = len(RAGGED.ends)

# A strip with one side, whose last triangle wants edges that have two already.
STRIP = moebius(8, 3)
FACES = np.r_[STRIP.triangles, STRIP.triangles[:2]].astype(np.int32)
FACE_EDGES, FACE_ENDS = int32s((len(FACES), 3)), int32s((3 * len(FACES), 2))
N_NAMED = agreed_triangles.name_edges.py_func(FACES, ints(len(STRIP.points) + 1), FACE_ENDS, FACE_EDGES)
FACE_ENDS = FACE_ENDS[:N_NAMED].copy()


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
    manifold_patches.keep_manifold.py_func(arguments[0], np.arange(first or len(FACES)), *arguments[2:])
    return arguments


def joining(t):
    triangles, _, _, edge_of, sides, parent, is_odd, _ = taken(t)
    return triangles, edge_of, sides, parent, is_odd, t


CASES = {
    "link_trust.are_adjacent": lambda: (
        STAR.indptr,
        STAR.indices,
        STAR.is_open,
        0,
        int(STAR.indices[0]),
        int(STAR.indices[1]),
    ),
    "link_trust.agreement": lambda: (STAR.indptr, STAR.indices, STAR.is_open, 0, N, bools(len(STAR.indices))),
    "agreed_triangles.add_corner_angles": lambda: (SHAPE.points, unsigned(RAGGED.triangles), np.zeros(N)),
    "agreed_triangles.circumradius": lambda: (SHAPE.points, 0, 1, 2),
    "manifold_patches.close_up": lambda: (
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
    "rim_walks.draw_tight": lambda: (
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
    "manifold_patches.join_alike": lambda: joining(9),
    "manifold_patches.join_alike full": lambda: joining(len(FACES) - 1),
    "manifold_patches.join_alike twisted": lambda: joining(len(FACES) - 3),
    "manifold_patches.keep_manifold": lambda: untaken(),
    "agreed_triangles.name_edges": lambda: (
        FACES,
        ints(len(STRIP.points) + 1),
        int32s((3 * len(FACES), 2)),
        int32s(FACES.shape),
    ),
    "manifold_patches.put_beside": lambda: (RAGGED.sides.copy(), int(np.flatnonzero(RAGGED.sides[:, 1] < 0)[0]), 5),
    "manifold_patches.root_of": lambda: (
        np.array([0, 0, 1, 2, 3], np.int32),
        np.array([False, True, True, False, True]),
        4,
    ),
    "manifold_patches.turn_alike": lambda: (taken()[0], taken()[3], *taken()[5:]),
    "rim_walks.walk_rims": lambda: (
        RAGGED.ends,
        RAGGED.edge_of,
        RAGGED.sides,
        bools(N_EDGES),
        ints(N_EDGES + 1),
        ints(N_EDGES + 1),
    ),
}
