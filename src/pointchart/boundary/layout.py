"""Lay a boundary loop out on a convex domain: step lengths along the loop, then a curve (paper, section 2)."""

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_loop, check_points
from ..errors import InputError
from ..plane.polygons import check_convex
from ..typing import UV, Floats, Indices, Loop, Points
from .steps import step_lengths


def uniform_steps(points: ArrayLike, loop: ArrayLike) -> Floats:
    """Give every step from one boundary point to the next the same length.

    Examples
    --------
    >>> uniform_steps([[0, 0, 0], [9, 0, 0], [0, 1, 0], [1, 1, 1]], [0, 1, 2])
    array([1., 1., 1.])
    """
    return _steps(points, loop, 0.0)


def chord_length_steps(points: ArrayLike, loop: ArrayLike) -> Floats:
    """Give every step from one boundary point to the next its length in space.

    Examples
    --------
    >>> chord_length_steps([[0, 0, 0], [4, 0, 0], [4, 3, 0], [1, 1, 1]], [0, 1, 2])
    array([4., 3., 5.])
    """
    return _steps(points, loop, 1.0)


def centripetal_steps(points: ArrayLike, loop: ArrayLike) -> Floats:
    """Give every step from one boundary point to the next the root of its length in space (Lee 1989).

    Examples
    --------
    >>> centripetal_steps([[0, 0, 0], [4, 0, 0], [4, 9, 0], [1, 1, 1]], [0, 1, 2]).round(3)
    array([2.   , 3.   , 3.138])
    """
    return _steps(points, loop, 0.5)


def _steps(points: ArrayLike, loop: ArrayLike, power: float) -> Floats:
    cloud = np.asarray(points, dtype=np.float64)
    rim = check_loop(loop, len(cloud))
    check_points(cloud[rim], least=3)  # of the others nothing is asked
    return np.asarray(step_lengths(cloud, rim) ** power)


def on_circle(steps: Floats) -> UV:
    """Lay the loop out on the unit circle: arc lengths in proportion to the steps, the first point at (1, 0).

    Parameters
    ----------
    steps : (b,) array
        Length of the step from each boundary point to the next, in any unit.

    Returns
    -------
    (b, 2) float64 array, anticlockwise.

    Examples
    --------
    >>> on_circle([1, 1, 1, 1]).round(12) + 0.0
    array([[ 1.,  0.],
           [ 0.,  1.],
           [-1.,  0.],
           [ 0., -1.]])
    """
    lengths = _checked(steps)
    angle = 2.0 * np.pi * (np.cumsum(lengths) - lengths) / lengths.sum()
    return np.column_stack([np.cos(angle), np.sin(angle)])


def chord_length_on_circle(points: ArrayLike, loop: ArrayLike) -> UV:
    """Lay a loop out on the unit circle by chord length, as in all examples of the paper.

    Examples
    --------
    >>> chord_length_on_circle([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], range(4)).round(12)[2]
    array([-1.,  0.])
    """
    return on_circle(chord_length_steps(points, loop))


def on_polygon(steps: Floats, vertices: ArrayLike, corners: Indices) -> UV:
    """Lay the loop out on a convex polygon: on each side, chords in proportion to the steps.

    Parameters
    ----------
    steps : (b,) array
        Length of the step from each boundary point to the next, in any unit.
    vertices : (c, 2) array
        Vertices of the polygon, anticlockwise, strictly convex.
    corners : (c,) int array
        Places on the loop (not point indices) that go to the vertices, in the order of the loop.

    Returns
    -------
    (b, 2) float64 array, anticlockwise.

    Raises
    ------
    InputError
        If the polygon is not convex and anticlockwise, or the corners are not c places in cyclic order.

    Examples
    --------
    >>> on_polygon([1, 3, 4, 4], [[0, 0], [1, 0], [0, 1]], [0, 2, 3])
    array([[0.  , 0.  ],
           [0.25, 0.  ],
           [1.  , 0.  ],
           [0.  , 1.  ]])
    """
    lengths = _checked(steps)
    polygon = check_convex(vertices, is_strict=True)
    places = np.asarray(corners)
    b, c = len(lengths), len(polygon)
    if len(places) != c or ((places < 0) | (places >= b)).any():
        raise InputError(
            f"the corners are {places.tolist()}; {c} places on a loop of {b} points are needed, from 0 to {b - 1}"
        )
    ahead = (np.roll(places, -1) - places) % b
    if (ahead == 0).any() or ahead.sum() != b:
        raise InputError(f"the corners {places.tolist()} are not in the order of the loop; sort them along it")
    uv = np.empty((b, 2))
    for k in range(c):
        side = (places[k] + np.arange(ahead[k])) % b
        along = (np.cumsum(lengths[side]) - lengths[side]) / lengths[side].sum()
        uv[side] = polygon[k] + along[:, None] * (polygon[(k + 1) % c] - polygon[k])
    return uv


def on_square(steps: Floats, corners: Indices | None = None) -> UV:
    """Lay the loop out on the unit square; corner places are a quarter of the length apart, if not given.

    Examples
    --------
    >>> on_square([1, 1, 1, 1])
    array([[0., 0.],
           [1., 0.],
           [1., 1.],
           [0., 1.]])
    """
    lengths = _checked(steps)
    places = quarter_places(lengths) if corners is None else corners
    return on_polygon(lengths, [[0, 0], [1, 0], [1, 1], [0, 1]], places)


def quarter_places(steps: Floats) -> Indices:
    """Find four places on the loop that quarter its length as nearly as the points allow.

    Examples
    --------
    >>> quarter_places([1, 1, 2, 2, 2]).tolist()
    [0, 2, 3, 4]
    """
    lengths = _checked(steps)
    b = len(lengths)
    if b < 4:
        raise InputError(f"the boundary has {b} points; a square needs at least 4: use the circle")
    start = np.cumsum(lengths) - lengths
    places = [0]
    for k in range(1, 4):
        free = np.arange(places[-1] + 1, b - 3 + k)
        places.append(int(free[np.argmin(np.abs(start[free] - k * lengths.sum() / 4))]))
    return np.array(places)


def places_of(corners: ArrayLike, loop: ArrayLike) -> Indices:
    """Find the places of boundary points on the loop, in the order of the loop, the first given one first.

    Raises
    ------
    InputError
        If a corner is not on the loop.

    Examples
    --------
    >>> places_of([7, 3, 9], [3, 5, 7, 9])
    array([2, 3, 0])
    """
    rim, names = np.asarray(loop), np.asarray(corners)
    missing = names[~np.isin(names, rim)]
    if len(missing):
        raise InputError("corners {missing} are not on the boundary; choose boundary points", missing=missing)
    places = np.array([int(np.flatnonzero(rim == name)[0]) for name in names])
    ordered = np.sort(places)
    return np.roll(ordered, -int(np.flatnonzero(ordered == places[0])[0]))


def sharpest_places(points: ArrayLike, loop: ArrayLike, count: int = 4) -> Indices:
    """Find the places where the loop turns most sharply, at least half a fair share of its length apart.

    The turn at a point is measured between the chords to the points a twentieth of the length before and behind it, so
    that the raggedness of a scan's edge does not count.

    Parameters
    ----------
    points : (n, 3) array
    loop : (b,) int array
    count : int

    Returns
    -------
    (count,) int64 array of places on the loop, ascending.

    Examples
    --------
    >>> rectangle = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0], [2, 2, 0], [1, 2, 0], [0, 2, 0], [0, 1, 0]]
    >>> sharpest_places(rectangle, range(8))
    array([0, 2, 4, 6])
    """
    cloud = check_points(points)
    rim = check_loop(loop, len(cloud))
    if len(rim) < count:
        raise InputError(f"the boundary has {len(rim)} points; {count} corners need at least as many: use the circle")
    steps = chord_length_steps(cloud, rim)
    at, total = np.cumsum(steps) - steps, steps.sum()
    # Twenty windows a loop smooth ragged edges; a coarse loop falls back on the neighbouring points.
    reach = max(total / 20.0, steps.max() * (1.0 + 1e-9)) if len(rim) > 8 else steps.max()
    behind = cloud[rim] - _position(cloud[rim], at, total, at - reach)
    ahead = _position(cloud[rim], at, total, at + reach) - cloud[rim]
    lengths = np.linalg.norm(behind, axis=1) * np.linalg.norm(ahead, axis=1)
    turn = 1.0 - np.einsum("ij,ij->i", behind, ahead) / np.where(lengths > 0.0, lengths, 1.0)
    chosen: list[int] = []
    apart = total / (2 * count)
    while len(chosen) < count:
        distance = np.full(len(rim), np.inf)
        for place in chosen:
            gap = np.abs(at - at[place])
            distance = np.minimum(distance, np.minimum(gap, total - gap))
        allowed = distance >= apart if (distance >= apart).any() else distance == distance.max()
        chosen.append(int(np.argmax(np.where(allowed, turn, -1.0))))
    return np.sort(np.array(chosen))


def _position(corners: Points, at: Floats, total: float, where: Floats) -> Points:
    """Interpolate along the closed polygon at arc lengths `where`."""
    closed_at, closed = np.append(at, total), np.vstack([corners, corners[:1]])
    return np.column_stack([np.interp(where % total, closed_at, closed[:, axis]) for axis in range(3)])


def _checked(steps: ArrayLike) -> Floats:
    lengths = np.asarray(steps, dtype=np.float64)
    if lengths.ndim != 1 or len(lengths) < 3 or not np.all(lengths > 0.0):
        raise InputError(
            "steps along the boundary have to be positive, one for each of at least 3 points; "
            "points that repeat give steps of length 0"
        )
    return lengths


def reversed_loop(loop: Loop) -> Loop:
    """Turn a loop round, keeping its first point first.

    Examples
    --------
    >>> import numpy as np
    >>> reversed_loop(np.array([4, 7, 9]))
    array([4, 9, 7])
    """
    return np.concatenate([loop[:1], loop[:0:-1]])


def is_same_loop(one: Loop, other: Loop) -> bool:
    """Tell whether two loops are the same, wherever they start and whichever way they run.

    Examples
    --------
    >>> import numpy as np
    >>> is_same_loop(np.array([4, 7, 9]), np.array([9, 7, 4]))
    True
    """
    places = np.flatnonzero(one == other[0])
    if len(one) != len(other) or len(places) != 1:
        return False
    turned = np.roll(one, -int(places[0]))
    return bool(np.array_equal(turned, other) or np.array_equal(turned[1:], other[:0:-1]))
