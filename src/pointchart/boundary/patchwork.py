"""Patchwork surfaces: triangles of which at most two share an edge, such as those on which neighbouring stars agree."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points
from .._kernels.rims import (
    FULL,
    close_up,
    collect_triangles,
    count_at_edges,
    count_votes,
    keep_manifold,
    name_edges,
    turn_alike,
)
from .._parallel import over_ranges
from ..errors import InputError
from ..neighbors import Neighborhoods
from ..typing import Floats, Indices, Mask, Triangles

LEAST_VOTES, ALL_VOTES = 2, 3
WIDEST = 2.0  # circumradius of the largest triangle taken, in local spacings


@dataclass(frozen=True, slots=True, eq=False)
class Patchwork:
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
    """

    triangles: Triangles
    edge_of: Indices
    ends: Indices
    sides: Indices
    part: Indices
    n_points: int

    def without(self, dropped: Mask) -> "Patchwork":
        """Return the patchwork without some triangles."""
        if not dropped.any():
            return self
        number = np.cumsum(~dropped, dtype=np.int32) - 1
        sides = self.sides.copy()
        close_up(sides, dropped, number)
        # A part is named after a triangle that may be gone; any number that tells parts apart will do.
        kept = ~dropped
        return Patchwork(self.triangles[kept], self.edge_of[kept], self.ends, sides, self.part[kept], self.n_points)


def patchwork(triangles: ArrayLike, n_points: int) -> Patchwork:
    """Take triangles in turn wherever no edge gets a third one, and orient neighbours alike.

    Those that no orientation fits come last; where edges have room for them too, they make a one-sided surface.

    Parameters
    ----------
    triangles : (m, 3) int array
        The best first.
    n_points : int

    Returns
    -------
    Patchwork

    Examples
    --------
    >>> patchwork([[0, 1, 2], [0, 1, 3], [1, 0, 4]], 5).triangles.tolist()
    [[0, 1, 2], [0, 3, 1]]
    """
    faces = np.array(triangles, dtype=np.int32).reshape(-1, 3)
    edge_of, ends = _named(faces, n_points)
    return _taken(faces, edge_of, ends, np.arange(len(faces)), np.ones(len(faces), np.bool_), n_points)


def agreed_patchwork(points: ArrayLike, star: Neighborhoods, spacing: Floats) -> Patchwork:
    """Collect the triangles that at least two stars hold, the best ones where three would share an edge.

    Triangles that all three stars hold come first, then those with small circles.

    Parameters
    ----------
    points : (n, 3) array
    star : Neighborhoods
        Delaunay stars.
    spacing : (n,) array
        Local spacing: triangles with a circumradius over two spacings bridge a gap and are left out.

    Returns
    -------
    Patchwork
    """
    cloud = check_points(points)
    if star.is_open is None:
        raise InputError("only ordered neighbourhoods hold triangles; use Delaunay stars")
    n, is_open = len(cloud), star.is_open
    votes = np.empty(len(star.indices), np.int8)
    over_ranges(lambda first, last: count_votes(star.indptr, star.indices, is_open, first, last, votes), n)
    most = int(np.count_nonzero(votes >= LEAST_VOTES))
    faces, width, held = np.empty((most, 3), np.int32), np.empty(most), np.empty(most, np.int8)
    m = collect_triangles(cloud, star.indptr, star.indices, votes, spacing, LEAST_VOTES, WIDEST, faces, width, held)
    faces, width, held = faces[:m], width[:m], held[:m]
    edge_of, ends = _named(faces, n)
    # Only triangles at an edge that more than two want have to be compared.
    wanted = np.zeros(len(ends), np.int8)
    is_contested = np.empty(m, np.bool_)
    count_at_edges(edge_of, wanted, is_contested)
    contested = np.flatnonzero(is_contested)
    clear = [np.flatnonzero(~is_contested & (held == count)) for count in (ALL_VOTES, LEAST_VOTES)]
    in_turn = contested[np.lexsort((width[contested], -held[contested]))]
    # Two stars may agree on a triangle that folds over another; where three do, the surface itself is one-sided.
    return _taken(faces, edge_of, ends, np.concatenate([*clear, in_turn]), held == ALL_VOTES, n)


def _named(faces: Triangles, n_points: int) -> tuple[Indices, Indices]:
    """Return the edges of each triangle, and the ends of the edges."""
    edge_of, ends = np.empty_like(faces), np.empty((3 * len(faces), 2), np.int32)
    count = name_edges(faces, np.empty(n_points + 1, np.int64), ends, edge_of)
    return edge_of, ends[:count]


def _taken(
    faces: Triangles, edge_of: Indices, ends: Indices, order: Indices, may_twist: Mask, n_points: int
) -> Patchwork:
    m = len(faces)
    sides, parent, is_odd = np.full((len(ends), 2), -1, np.int32), np.empty(m, np.int32), np.zeros(m, np.bool_)
    outcome = np.empty(m, np.int8)
    keep_manifold(faces, order, may_twist, edge_of, sides, parent, is_odd, outcome)
    turn_alike(faces, edge_of, parent, is_odd, outcome)
    return Patchwork(faces, edge_of, ends, sides, parent, n_points).without(outcome == FULL)
