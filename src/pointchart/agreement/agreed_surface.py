"""Surfaces of triangles on which neighbouring stars agree: at most two of them share an edge."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_kind
from .._kernels.agreement.agreed_triangles import collect_triangles, count_at_edges, count_votes, name_edges
from .._kernels.agreement.manifold_patches import FULL, JOINED, close_up, keep_manifold, turn_alike
from .._parallel import over_ranges
from ..points.neighborhoods import Rings
from ..typing import Floats, Indices, Loop, Mask, Points, Triangles

LEAST_VOTES, ALL_VOTES = 2, 3  # of the stars of its corners, for a triangle to be taken; and to be taken first
WIDEST = 2.0  # circumradius of the largest triangle taken, in local spacings


@dataclass(frozen=True, slots=True, eq=False)
class AgreedSurface:
    """Triangles of which at most two share an edge, with the edges between them.

    Attributes
    ----------
    triangles : (m, 3) int32
        The best first.
    edge_of : (m, 3) int32
        Edge k of a triangle lies opposite to its corner k.
    ends : (e, 2) int32
        Points at the ends of each edge.
    sides : (e, 2) int32
        Triangles at each edge, -1 where there is none.
    part : (m,) int32
        Triangles with the same number, that of one of them, are joined by edges and oriented alike; -1 for those that
        no orientation fits.
    n_points : int
    spare, spare_edges : (s, 3) int32
        Further triangles that may be put in and their edges, the best first: those that a single star holds.
    """

    triangles: Triangles
    edge_of: Indices
    ends: Indices
    sides: Indices
    part: Indices
    n_points: int
    spare: Triangles
    spare_edges: Indices

    def without(self, dropped: Mask) -> "AgreedSurface":
        """Return the agreed surface without some triangles."""
        if not dropped.any():
            return self
        number = np.cumsum(~dropped, dtype=np.int32) - 1
        sides = self.sides.copy()
        close_up(sides, dropped, number)
        kept = np.flatnonzero(~dropped)
        # A part is named after a triangle that may be gone; any number that tells parts apart will do.
        triangles, edge_of, part = (rows.take(kept, axis=0) for rows in (self.triangles, self.edge_of, self.part))
        return replace(self, triangles=triangles, edge_of=edge_of, sides=sides, part=part)

    @property
    def largest(self) -> Mask:
        """Which triangles are of the largest part, (m,)."""
        joined = self.part[self.part >= 0]
        return np.asarray(self.part == (np.argmax(np.bincount(joined)) if len(joined) else 0))

    def extended(self, loop: Loop) -> "AgreedSurface":
        """Put spare triangles in wherever they fit, but none across a boundary.

        Parameters
        ----------
        loop : (b,) int array
            The boundary.

        Returns
        -------
        AgreedSurface
            Without spare triangles, and without those that no orientation fits.

        Examples
        --------
        >>> whole = patchwork([[0, 1, 4], [1, 2, 4], [2, 3, 4]], 5)
        >>> less = whole.without(np.array([False, True, False]))
        >>> spared = replace(less, spare=whole.triangles[1:2], spare_edges=whole.edge_of[1:2])
        >>> spared.extended(np.array([0, 1, 2, 3, 4])).triangles.tolist()
        [[0, 1, 4], [2, 3, 4], [1, 2, 4]]
        """
        if (self.part < 0).any():  # no spare triangle may hang on one that has no orientation
            return self.without(self.part < 0).extended(loop)
        m, k = len(self.triangles), len(self.spare)
        bare = replace(self, spare=self.spare[:0], spare_edges=self.spare_edges[:0])
        if k == 0:
            return bare
        # At edges of the boundary the side without a triangle is held by one that is not there, so no spare one fits.
        ahead = np.full(self.n_points, -1, np.int32)
        ahead[loop] = np.roll(loop, -1)
        sides, (a, b) = self.sides.copy(), self.ends.T
        is_boundary = ((ahead[a] == b) | (ahead[b] == a)) & (sides[:, 0] >= 0) & (sides[:, 1] < 0)
        sides[is_boundary, 1] = m + k
        triangles = np.concatenate([self.triangles, self.spare])
        edge_of = np.concatenate([self.edge_of, self.spare_edges])
        # Triangles of a part hang on its first one.
        _, first, place = np.unique(self.part, return_index=True, return_inverse=True)
        parent = np.arange(m + k, dtype=np.int32)
        parent[:m] = first[place]
        outcome = np.full(m + k, JOINED, np.int8)
        is_odd, may_twist = np.zeros(m + k, np.bool_), np.zeros(m + k, np.bool_)
        keep_manifold(triangles, np.arange(m, m + k), may_twist, edge_of, sides, parent, is_odd, outcome)
        sides[is_boundary, 1] = -1
        turn_alike(triangles, edge_of, parent, is_odd, outcome)
        return replace(bare, triangles=triangles, edge_of=edge_of, sides=sides, part=parent).without(outcome == FULL)


def patchwork(triangles: ArrayLike, n_points: int) -> AgreedSurface:
    """Take triangles in turn wherever no edge gets a third one, and orient neighbours alike.

    Those that no orientation fits come last; where edges have room for them too, they make a one-sided surface.

    Parameters
    ----------
    triangles : (m, 3) int array
        The best first.
    n_points : int

    Returns
    -------
    AgreedSurface

    Examples
    --------
    >>> patchwork([[0, 1, 2], [0, 1, 3], [1, 0, 4]], 5).triangles.tolist()
    [[0, 1, 2], [0, 3, 1]]
    """
    faces = np.array(triangles, dtype=np.int32).reshape(-1, 3)
    edge_of, ends = _named(faces, n_points)
    order, may_twist = np.arange(len(faces)), np.ones(len(faces), np.bool_)
    return _taken(faces, edge_of, ends, order, may_twist, n_points, faces[:0])


def collect_agreed(cloud: Points, star: Rings, spacing: Floats) -> AgreedSurface:
    """Collect the triangles that at least two stars hold, the best ones where three would share an edge.

    Triangles that all three stars hold come first, then those with small circles.

    Parameters
    ----------
    cloud : (n, 3) float64 array
    star : Rings
        Delaunay stars.
    spacing : (n,) array
        Local spacing: triangles with a circumradius over two spacings bridge a gap and are left out.

    Returns
    -------
    AgreedSurface
    """
    check_kind(star, Rings, "only ordered neighbourhoods hold triangles; use Delaunay stars")
    n, is_open = len(cloud), star.is_open
    votes = np.empty(len(star.indices), np.int8)
    over_ranges(lambda first, last: count_votes(star.indptr, star.indices, is_open, first, last, votes), n)
    most = int(np.count_nonzero(votes > 0))
    faces, width, held = np.empty((most, 3), np.int32), np.empty(most), np.empty(most, np.int8)
    m = collect_triangles(cloud, star.indptr, star.indices, votes, spacing, WIDEST, faces, width, held)
    faces, width, held = faces[:m], width[:m], held[:m]
    spare = np.flatnonzero(held < LEAST_VOTES)
    spare = spare[np.argsort(width[spare], kind="stable")]
    is_held = held >= LEAST_VOTES
    others, faces, width, held = faces[spare], faces[is_held], width[is_held], held[is_held]
    edge_of, ends = _named(np.concatenate([faces, others]), n)
    m = len(faces)
    # Only triangles at an edge that more than two want have to be compared.
    wanted = np.zeros(len(ends), np.int8)
    is_contested = np.empty(m, np.bool_)
    count_at_edges(edge_of[:m], wanted, is_contested)
    contested = np.flatnonzero(is_contested)
    clear = [np.flatnonzero(~is_contested & (held == count)) for count in (ALL_VOTES, LEAST_VOTES)]
    in_turn = contested[np.lexsort((width[contested], -held[contested]))]
    # Two stars may agree on a triangle that folds over another; where three do, the surface itself is one-sided.
    return _taken(faces, edge_of, ends, np.concatenate([*clear, in_turn]), held == ALL_VOTES, n, others)


def _named(faces: Triangles, n_points: int) -> tuple[Indices, Indices]:
    """Return the edges of each triangle, and the ends of the edges."""
    edge_of, ends = np.empty_like(faces), np.empty((3 * len(faces), 2), np.int32)
    count = name_edges(faces, np.empty(n_points + 1, np.int64), ends, edge_of)
    return edge_of, ends[:count]


def _taken(
    faces: Triangles,
    edge_of: Indices,
    ends: Indices,
    order: Indices,
    may_twist: Mask,
    n_points: int,
    spare: Triangles,
) -> AgreedSurface:
    """Take triangles in turn; the edges of the spare ones follow theirs."""
    m = len(faces)
    own = np.ascontiguousarray(edge_of[:m])
    sides, parent, is_odd = np.full((len(ends), 2), -1, np.int32), np.empty(m, np.int32), np.zeros(m, np.bool_)
    outcome = np.empty(m, np.int8)
    keep_manifold(faces, order, may_twist, own, sides, parent, is_odd, outcome)
    turn_alike(faces, own, parent, is_odd, outcome)
    whole = AgreedSurface(faces, own, ends, sides, parent, n_points, spare, edge_of[m:])
    return whole.without(outcome == FULL)
