"""The paper's own ordering of boundary points: two halves, each by the univariate analogue of system (2.1)."""

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike

from .._check import check_place, check_points
from ..errors import InputError
from ..solve.systems import solve_fixed
from ..typing import Floats, Indices, Loop, Points
from .steps import perimeter

PLANES = 12  # in steps of 15 degrees: a choice, as the paper has its user place the plane


def order_by_halves(points: ArrayLike, members: ArrayLike, *, normal: ArrayLike | None = None, k: int = 8) -> Loop:
    """Order boundary points the paper's way: cut by a plane, each half ordered by a linear system on the line.

    In each half the two end points next to the plane go to 0 and 1, and every other point to a convex combination of
    its `k` nearest in the same half, by reciprocal distances; the order of these parameters is the order of the
    points. Suits a boundary that some plane through its middle cuts exactly twice: if none is given, planes in steps of
    15 degrees about the shortest principal axis are tried, and the shortest loop is taken.

    Parameters
    ----------
    points : (n, 3) array
    members : (b,) int array
        Boundary points, in any order.
    normal : (3,) array, optional
        Normal of the plane through the members' centroid; found, if not given.
    k : int
        Neighbours along the boundary.

    Returns
    -------
    (b,) int64 array: the members in order.

    Raises
    ------
    InputError
        If a half has fewer than 3 members, or some of them have no path to both of its ends.

    References
    ----------
    Floater and Reimers 2001, section 5 and Figure 4.

    Examples
    --------
    >>> angle = np.deg2rad([0, 200, 80, 320, 120, 40, 240, 160, 280])
    >>> ring = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    >>> loop = order_by_halves(ring, range(9), k=2)
    >>> steps = np.diff(np.rad2deg(angle[loop]).round()) % 360
    >>> sorted({float(min(step, 360 - step)) for step in steps})
    [40.0]
    """
    cloud = check_points(points)
    chosen = np.asarray(members, dtype=np.int64)
    if len(chosen) < 6:
        raise InputError(f"{len(chosen)} boundary points cannot be put in order by halves; each half needs at least 3")
    centred = cloud[chosen] - cloud[chosen].mean(axis=0)
    if normal is not None:
        return _order_by_plane(cloud, chosen, centred @ check_place(normal, "normal of the plane"), k)
    first, second = np.linalg.svd(centred, full_matrices=False)[2][:2]
    loops, failures = list[Loop](), list[InputError]()
    # Half a turn is enough: a plane and its other side are the same.
    for angle in np.arange(PLANES) * np.pi / PLANES:
        try:
            loops.append(_order_by_plane(cloud, chosen, centred @ (np.cos(angle) * first + np.sin(angle) * second), k))
        except InputError as failure:
            failures.append(failure)
    if not loops:
        raise failures[0]
    return min(loops, key=lambda loop: perimeter(cloud, loop))


def _order_by_plane(cloud: Points, chosen: Indices, height: Floats, k: int) -> Loop:
    """Order the members above and below a plane, and join the halves."""
    upper = _order_half(cloud, chosen[height >= 0.0], height[height >= 0.0], k)
    lower = _order_half(cloud, chosen[height < 0.0], height[height < 0.0], k)
    gap = np.linalg.norm(cloud[upper[-1]] - cloud[lower[[0, -1]]], axis=1)
    return np.concatenate([upper, lower if gap[0] <= gap[1] else lower[::-1]])


def _order_half(cloud: Points, half: Indices, height: Floats, k: int) -> Loop:
    if len(half) < 3:
        raise InputError(f"the plane leaves {len(half)} boundary points on one side; each half needs at least 3")
    from scipy.spatial import cKDTree

    distance, found = cKDTree(cloud[half]).query(cloud[half], k=np.arange(2, min(k, len(half) - 1) + 2))
    ends = _end_points(cloud[half], np.abs(height), reach=2.0 * float(distance[:, 0].max()))
    rows = np.repeat(np.arange(len(half)), found.shape[1])
    matrix = sp.csr_array((1.0 / distance.ravel(), (rows, found.ravel())), shape=(len(half), len(half)))
    reached = sp.csgraph.breadth_first_order(matrix.T.tocsr(), ends[0], return_predecessors=False)
    also = sp.csgraph.breadth_first_order(matrix.T.tocsr(), ends[1], return_predecessors=False)
    lost = np.setdiff1d(np.arange(len(half)), np.intersect1d(reached, also))
    if len(lost):
        raise InputError(
            "boundary points {lost} have no path to both ends of their half; use a larger k", lost=half[lost]
        )
    matrix = sp.csr_array(sp.diags_array(1.0 / matrix.sum(axis=1)) @ matrix)
    parameter = solve_fixed(matrix, ends, np.array([[0.0], [1.0]])).values[:, 0]
    return np.asarray(half[np.argsort(parameter, kind="stable")])


def _end_points(half: Points, height: Floats, reach: float) -> Indices:
    """Find the ends of a half: the point next to the plane, and the one next to it where the other end must be."""
    one = int(np.argmin(height))
    near = np.flatnonzero(height <= height[one] + reach)
    distance = np.linalg.norm(half[near] - half[one], axis=1)
    opposite = near[distance >= 0.5 * distance.max()]
    return np.array([one, opposite[np.argmin(height[opposite])]])
