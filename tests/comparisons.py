"""What tests of several stages make meshes into, and compare them by."""

import numpy as np
from scipy.spatial import cKDTree

from pointchart.mesh.connectivity import half_edges
from pointchart.plane.exact_signs import orientation_signs


def edges_of(triangles):
    return set(map(tuple, np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1).tolist()))


def f1(found, true):
    return 2 * len(found & true) / (len(found) + len(true))


def flip_at_random(triangles, is_allowed, rng, n_flips):
    """Flip random inner edges ab of triangles abc and bad to cd, where that is allowed and cd is no edge yet."""
    triangles = triangles.copy()
    for _ in range(n_flips):
        edges = half_edges(triangles, triangles.max() + 1)
        h = rng.choice(np.flatnonzero(edges.twins >= 0))
        t = edges.twins[h]
        a, b = edges.origins[h], edges.targets[h]
        c, d = (int(np.setdiff1d(triangles[k // 3], [a, b])[0]) for k in (h, t))
        flipped = np.array([[c, a, d], [d, b, c]])
        if is_allowed(flipped) and (min(c, d), max(c, d)) not in edges_of(triangles):
            triangles[[h // 3, t // 3]] = flipped
    return triangles


def mixed_in_plane(shape, seed):
    """Return another triangulation of a planar disc, without a fold."""

    def is_plane(flipped):
        return (orientation_signs(shape.uv, flipped) == 1).all()

    return flip_at_random(shape.triangles, is_plane, np.random.default_rng(seed), 150)


def same_loop(loop, other):
    start = np.flatnonzero(loop == other[0])[0]
    return np.array_equal(np.roll(loop, -start), other)


def as_set(triangles):
    return set(map(frozenset, triangles.tolist()))


def mixed(triangles, rng):
    """Return triangles in another order, each of either orientation and beginning at any corner."""
    mixed = rng.permutation(triangles)
    turn = (np.arange(3) + rng.integers(0, 3, (len(mixed), 1))) % 3
    mixed = np.take_along_axis(mixed, turn, axis=1)
    is_turned = rng.random(len(mixed)) < 0.5
    mixed[is_turned] = mixed[is_turned, ::-1]
    return mixed


def as_cycle(loop):
    loop = np.asarray(loop)
    return np.roll(loop, -int(np.argmin(loop))).tolist()


def either_way(loop):
    return sorted([as_cycle(loop), as_cycle(loop[::-1])])


def farthest(points, others):
    """Return the largest distance of a point from the nearest of some others."""
    return cKDTree(others).query(points)[0].max()


def oriented(triangles):
    turn = np.argmin(triangles, axis=1)[:, None]
    return set(map(tuple, np.take_along_axis(triangles, (turn + np.arange(3)) % 3, axis=1).tolist()))


def in_rows(result):
    return oriented(result.rows[result.triangles])
