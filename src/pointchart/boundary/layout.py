"""Lay a boundary loop out on a convex domain: step lengths along the loop, then a curve (paper, section 2)."""

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError
from ..plane.polygons import check_convex
from ..typing import UV, Floats, Indices, Loop
from .corners import quarter_places
from .steps import checked_steps, chord_length_steps


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
    lengths = checked_steps(steps)
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
    lengths = checked_steps(steps)
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
    lengths = checked_steps(steps)
    places = quarter_places(lengths) if corners is None else corners
    return on_polygon(lengths, [[0, 0], [1, 0], [1, 1], [0, 1]], places)


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
