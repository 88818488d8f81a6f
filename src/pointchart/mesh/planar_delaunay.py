"""Exact Delaunay triangulation of the parameter points, held inside the boundary loop."""

import numpy as np
import startinpy
from numpy.typing import ArrayLike

from .._check import check_loop
from .._kernels.mesh.peel import peel
from ..errors import InputError, SolveError
from ..points.morton import morton_order
from ..typing import UV, Indices, Loop, Triangles
from .connectivity import half_edges

GOLDEN_RATIO = 0.6180339887498949  # its multiples, less whole numbers, are spread evenly however many there are


def triangulate(uv: ArrayLike, loop: ArrayLike) -> Triangles:
    """Triangulate all parameter points by Delaunay's criterion, with the boundary loop as the boundary.

    Predicates are exact, so points as close as 1e-14 are kept apart. Boundary points that were rounded to doubles are
    not exactly in convex position: triangles of the hull that lie outside the loop are peeled off.

    Parameters
    ----------
    uv : (n, 2) array
        Distinct parameter points.
    loop : (b,) int array
        Boundary points, anticlockwise in uv.

    Returns
    -------
    (m, 3) int64 array of anticlockwise triangles; m = 2 n - 2 - b.

    Raises
    ------
    SolveError
        If parameter points coincide, or some interior point lies on or outside the loop.

    References
    ----------
    Floater and Reimers 2001, section 2.

    Examples
    --------
    >>> triangulate([[0, 0], [3, 0], [0, 3], [1, 1]], [0, 1, 2]).shape
    (3, 3)
    """
    plane = np.ascontiguousarray(uv, dtype=np.float64)
    if plane.ndim != 2 or plane.shape[1] != 2 or not np.isfinite(plane).all():
        raise InputError(f"uv has shape {plane.shape}; a finite (n, 2) array is needed")
    rim = check_loop(loop, len(plane))
    triangles = _peel_to_loop(delaunay(plane), rim, len(plane))
    if len(triangles) != 2 * len(plane) - 2 - len(rim):
        outside = np.setdiff1d(np.setdiff1d(np.arange(len(plane)), triangles), rim)
        named = " points {outside} lie on or outside it;" if len(outside) else ""
        raise SolveError(
            f"the parameter points do not fill the boundary loop: {len(triangles)} triangles instead of "
            f"{2 * len(plane) - 2 - len(rim)};{named} use another boundary or a larger neighbourhood",
            outside=outside,
        )
    return triangles


def coinciding(uv: UV) -> Indices:
    """List the points whose parameters equal those of another point, in the order of their parameters.

    Examples
    --------
    >>> import numpy as np
    >>> coinciding(np.array([[0.0, 1.0], [2.0, 2.0], [0.0, 1.0]]))
    array([0, 2])
    """
    order = np.argsort(uv[:, 0])
    if (uv[order[1:], 0] != uv[order[:-1], 0]).all():
        return np.empty(0, np.int64)
    order = np.lexsort((uv[:, 1], uv[:, 0]))
    same = (uv[order[1:]] == uv[order[:-1]]).all(axis=1)
    return np.asarray(order[np.append(same, False) | np.insert(same, 0, False)])


def separate(uv: UV, loop: Loop) -> UV:
    """Move coinciding parameter points apart by a thousandth of the distance to the nearest other one.

    Uniform weights may give points the same parameters (Proposition 4.1), and long protrusions exhaust double
    precision. All such points still have to become vertices; edge swaps then repair what the arbitrary directions
    spoil. Boundary points stay.

    Examples
    --------
    >>> import numpy as np
    >>> square = np.array([[0.0, 0.0], [1, 0], [1, 1], [0, 1], [0.5, 0.5], [0.5, 0.5]])
    >>> len(coinciding(separate(square, np.arange(4))))
    0
    """
    doubled = coinciding(uv)
    if len(doubled) == 0:
        return uv
    from scipy.spatial import cKDTree

    distinct, group = np.unique(uv, axis=0, return_inverse=True)
    room = cKDTree(distinct).query(distinct, k=2)[0][:, 1][group.ravel()[doubled]]
    inward = uv[loop].mean(axis=0) - uv[doubled]
    # Directions within 60 degrees of inwards keep points that have fallen onto the boundary inside it.
    turn = (np.arange(len(doubled)) * GOLDEN_RATIO % 1.0 - 0.5) * np.deg2rad(120.0) + np.arctan2(*inward.T[::-1])
    reach = np.maximum(1e-3 * room, 1e-15) * (0.5 + 0.5 * np.arange(1, len(doubled) + 1) / len(doubled))
    apart = uv.copy()
    apart[doubled] += reach[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    apart[loop] = uv[loop]
    return apart


def delaunay(uv: UV) -> Triangles:
    """Triangulate the convex hull of points in the plane by Delaunay's criterion, with exact predicates.

    Raises
    ------
    SolveError
        If points coincide.

    Examples
    --------
    >>> len(delaunay(np.array([[0.0, 0], [3, 0], [0, 3], [1, 1]])))
    3
    """
    doubled = coinciding(uv)
    if len(doubled):
        raise SolveError(
            f"the parameters of {len(doubled)} points coincide with those of others (points {{doubled}}), so they "
            "cannot be triangulated; use other weights or a larger neighbourhood",
            doubled=doubled,
        )
    order = morton_order(uv)
    engine = startinpy.DT()
    engine.snap_tolerance = 1e-300  # by default points closer than 1e-3 are taken for one
    engine.insert(np.column_stack([uv[order], np.zeros(len(uv))]))
    return np.asarray(order[engine.triangles.astype(np.int64) - 1])


def _peel_to_loop(triangles: Triangles, rim: Loop, n_points: int) -> Triangles:
    edges = half_edges(triangles, n_points)
    successor = np.full(n_points, -1, np.int64)
    successor[rim] = np.roll(rim, -1)
    removed = np.zeros(len(triangles), np.bool_)
    peel(edges.origins, edges.twins, successor, np.empty(len(edges.origins), np.int64), removed)
    kept = triangles[~removed]
    return kept[np.argsort(kept[:, 0], kind="stable")]  # near in memory what is near in space
