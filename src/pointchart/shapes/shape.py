"""The shape itself: points, their true mesh and the parameters that they were made from."""

from dataclasses import dataclass

import numpy as np

from pointchart.typing import UV, Indices, Loop, Points, Triangles


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Hold a simulated surface: what a scanner gives, and the truth behind it.

    Attributes
    ----------
    points : (n, 3) float64
        The surface points.
    triangles : (m, 3) int64
        The true mesh, anticlockwise seen from the outside.
    uv : (n, 2) float64
        The parameters that the points were made from, dimensionless.

    Examples
    --------
    >>> import numpy as np
    >>> square = Shape(np.eye(4, 3), np.array([[0, 1, 2], [0, 2, 3]]), np.zeros((4, 2)))
    >>> square.boundary.tolist()
    [0, 1, 2, 3]
    """

    points: Points
    triangles: Triangles
    uv: UV

    @property
    def loops(self) -> tuple[Loop, ...]:
        """All boundary loops, the one with most points first; each has the surface on its left."""
        return tuple(sorted(_walk(_rim_edges(self.triangles)), key=len, reverse=True))

    @property
    def boundary(self) -> Loop:
        """The longest boundary loop, (b,), in order and not closed; empty for a closed surface."""
        return (*self.loops, np.empty(0, dtype=np.int64))[0]

    @property
    def spacing(self) -> float:
        """The median edge length of the true mesh, in the unit of the points."""
        ends = self.points[_edges(self.triangles)]
        return float(np.median(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)))


def grid_triangles(index: Indices) -> Triangles:
    """Split each cell of an array of point indices into two triangles.

    Rows of `index` run along the second parameter, columns along the first; repeat a row or a column to close the
    surface on itself.

    Parameters
    ----------
    index : (rows, columns) int64

    Returns
    -------
    (2 (rows - 1) (columns - 1), 3) int64

    Examples
    --------
    >>> import numpy as np
    >>> grid_triangles(np.array([[0, 1], [2, 3]])).tolist()
    [[0, 1, 3], [0, 3, 2]]
    """
    a, b = index[:-1, :-1].ravel(), index[:-1, 1:].ravel()
    c, d = index[1:, 1:].ravel(), index[1:, :-1].ravel()
    triangles: Triangles = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3).astype(np.int64)
    return triangles


def _edges(triangles: Triangles) -> Indices:
    return triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)


def _rim_edges(triangles: Triangles) -> Indices:
    edges = _edges(triangles)
    _, first, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    rim: Indices = edges[np.sort(first[count == 1])]
    return rim


def _walk(edges: Indices) -> list[Loop]:
    """Chain edges into loops; undirected, because the triangles of a one-sided surface disagree on the direction."""
    neighbors: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        neighbors.setdefault(a, []).append(b)
        neighbors.setdefault(b, []).append(a)
    loops, seen = [], set[int]()
    for a, b in edges.tolist():
        if a in seen:
            continue
        loop = [a]
        while b != a:
            ahead = next(c for c in neighbors[b] if c != loop[-1])
            loop.append(b)
            b = ahead
        seen.update(loop)
        loops.append(np.array(loop, dtype=np.int64))
    return loops
