"""Large meshes with fewer points, for the screen."""

from dataclasses import dataclass

import numpy as np

from ...points.morton import morton_order
from ...typing import Indices, Loop, Points, Triangles


@dataclass(frozen=True, slots=True, eq=False)
class Thinned:
    """A mesh shared out among some of its points.

    Attributes
    ----------
    kept : (k,) int64
        Points that are kept, along a Morton curve.
    owner : (n,) int64
        The place in `kept` of the one that each point went to.
    triangles : (m, 3) int64
        Of places in `kept`.
    """

    kept: Indices
    owner: Indices
    triangles: Triangles

    def along(self, loop: Loop) -> Loop:
        """Return the points kept along a loop."""
        owners = self.owner[loop]
        return np.asarray(owners[owners != np.roll(owners, 1)])


def thin(points: Points, triangles: Triangles, most: int) -> Thinned:
    """Share a mesh out among `most` of its points, and join those whose shares meet.

    Each point goes to a kept one that is among the nearest by edges; triangles whose corners went to three are
    the new ones, so that gaps and folds stay. Now and then one is missing: this serves to look at a mesh, not to work
    with it.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
        In one part.
    most : int
        Points to keep; all, if there are no more.

    Returns
    -------
    Thinned

    Examples
    --------
    >>> square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> shown = thin(square, np.array([[0, 1, 2], [0, 2, 3]]), 9)
    >>> sorted(shown.kept[shown.triangles].sum(axis=1).tolist())
    [3, 5]
    """
    order, n = morton_order(points), len(points)
    kept = order[np.linspace(0, n - 1, min(most, n)).astype(np.int64)]
    owner = np.full(n, -1, np.int64)
    owner[kept] = np.arange(len(kept))
    _share_out(triangles, owner)
    corners = owner[triangles]
    is_whole = (corners != np.roll(corners, 1, axis=1)).all(axis=1) & (corners >= 0).all(axis=1)
    return Thinned(kept, owner, _distinct(corners[is_whole], len(kept)))


def _distinct(triangles: Triangles, n_points: int) -> Triangles:
    """Drop triangles that are there already, from whichever corner they begin."""
    first = np.argmin(triangles, axis=1)
    a, b, c = (np.take_along_axis(triangles, (first[:, None] + k) % 3, axis=1)[:, 0] for k in range(3))
    key = (a * n_points + b) * n_points + c
    return np.stack([a, b, c], axis=1)[np.unique(key, return_index=True)[1]]


def _share_out(triangles: Triangles, owner: Indices) -> None:
    """Give points the owner of a neighbour, round by round."""
    open_triangles = triangles
    while True:
        owners = owner[open_triangles]
        has_one, has_all = (owners >= 0).any(axis=1), (owners >= 0).all(axis=1)
        if not (has_one & ~has_all).any():
            return
        giver = np.take_along_axis(owners, np.argmax(owners >= 0, axis=1)[:, None], axis=1)[:, 0]
        for k in range(3):
            takes = has_one & (owners[:, k] < 0)
            owner[open_triangles[takes, k]] = giver[takes]
        open_triangles = open_triangles[~has_all]
