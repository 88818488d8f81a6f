"""Strategies for point sets, graphs and motions; everything random grows from a drawn seed, so examples come back."""

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from hypothesis import strategies as st

from pointchart import shapes
from pointchart.points.neighborhoods import Neighborhoods

seeds = st.integers(0, 2**32 - 1)


def flat(uv):
    """Put planar points into the plane z = 0."""
    return np.c_[uv, np.zeros(len(uv))]


@st.composite
def rotations(draw):
    """Rotation matrices, evenly distributed."""
    q, r = np.linalg.qr(np.random.default_rng(draw(seeds)).normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


@st.composite
def clouds(draw, smallest=30, largest=200):
    """Scans of bumpy discs, in general position."""
    n = draw(st.integers(smallest, largest))
    return shapes.add_noise(shapes.relief(n, seed=draw(st.integers(0, 10**6))), sigma_in_spacings=0.05).points


@st.composite
def planar_discs(draw, smallest=30, largest=300):
    """Even but irregular discs in z = 0, with a round rim."""
    return shapes.disc(draw(st.integers(smallest, largest)), seed=draw(st.integers(0, 10**6)))


@st.composite
def convex_discs(draw, largest=16):
    """Points inside a strictly convex polygon: (uv, loop), the loop first and anticlockwise.

    Some inner points huddle in clusters as small as 1e-14.
    """
    rng = np.random.default_rng(draw(seeds))
    n_rim, n_inner = draw(st.integers(3, 9)), draw(st.integers(0, largest))
    turn = 2 * np.pi * (np.arange(n_rim) + rng.uniform(0, 0.3, n_rim)) / n_rim
    inner = 0.15 * np.sqrt(rng.random((n_inner, 1))) * _directions(rng.uniform(0, 2 * np.pi, n_inner))
    if draw(st.booleans()):
        inner = inner[:1] + draw(st.sampled_from([1e-3, 1e-9, 1e-14])) * inner
    return np.r_[_directions(turn), np.unique(inner, axis=0)], np.arange(n_rim)


@st.composite
def integer_sets(draw):
    """Distinct planar points with small whole coordinates: many of them on common lines and circles."""
    cells = draw(st.sets(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=5, max_size=24))
    return np.array(sorted(cells), dtype=np.float64)


@st.composite
def cocircular_sets(draw):
    """Points exactly on a circle of radius^2 = 325, which passes 24 whole points, and some of the points inside."""
    whole = np.stack(np.meshgrid(np.arange(-18, 19), np.arange(-18, 19)), axis=-1).reshape(-1, 2).astype(np.float64)
    norm = (whole**2).sum(axis=1)
    rng = np.random.default_rng(draw(seeds))
    ring = rng.permutation(whole[norm == 325])[: draw(st.integers(4, 24))]
    inside = rng.permutation(whole[norm < 325])[: draw(st.integers(0, 6))]
    return np.r_[ring, inside]


class System(NamedTuple):
    neighborhoods: Neighborhoods
    weights: np.ndarray
    loop: np.ndarray
    layout: np.ndarray

    @property
    def inner(self):
        """The points whose place is unknown."""
        return np.setdiff1d(np.arange(self.neighborhoods.n_points), self.loop)

    @property
    def matrix(self):
        """The convex combinations as a sparse matrix."""
        graph = self.neighborhoods
        return sp.csr_array((self.weights, graph.indices, graph.indptr), shape=(graph.n_points,) * 2)

    def reaches(self, start, without=-1):
        """List the boundary points that a path from an inner point leads to, not by way of `without`."""
        graph, boundary = self.neighborhoods, set(self.loop.tolist())
        seen, todo = {start}, [start]
        while todo:
            i = todo.pop()
            for j in graph.indices[graph.indptr[i] : graph.indptr[i + 1]].tolist() if i not in boundary else []:
                if j not in seen and j != without:
                    seen.add(j)
                    todo.append(j)
        return sorted(seen & boundary)


@st.composite
def systems(draw, most_inner=8):
    """Random directed graphs with convex weights, some points fixed on the unit circle; not all need be connected."""
    n_rim = draw(st.integers(3, 5))
    n = n_rim + draw(st.integers(1, most_inner))
    rows = [sorted(draw(st.sets(st.integers(0, n - 1).filter(i.__ne__), min_size=1, max_size=4))) for i in range(n)]
    rng = np.random.default_rng(draw(seeds))
    graph = Neighborhoods(np.r_[0, np.cumsum([len(row) for row in rows])], np.concatenate(rows).astype(np.int64))
    weights = rng.uniform(0.5, 1.5, len(graph.indices))
    weights /= np.bincount(graph.rows, weights)[graph.rows]
    loop = rng.permutation(n)[:n_rim]
    return System(graph, weights, loop, _directions(np.sort(rng.uniform(0, 2 * np.pi, n_rim))))


def _directions(turn):
    return np.stack([np.cos(turn), np.sin(turn)], axis=-1)
