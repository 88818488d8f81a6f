"""Which way a boundary runs: anticlockwise seen from the outside of its patch."""

import numpy as np

from ..typing import Loop, Points
from .layout import reversed_loop

UPRIGHT = 0.9  # cosine of the slope of the boundary's plane, over which above is a side of the patch
LEVEL = 0.15  # mean height over the root of the loop's area, under which a patch counts as level, such as terrain


def anticlockwise(points: Points, loop: Loop) -> Loop:
    """Turn a loop so that it runs anticlockwise seen from the outside of the patch.

    A point cloud has no side of its own. The outside is taken to be where the patch bulges to from the plane of its
    boundary, and above for a nearly level patch on a nearly horizontal boundary, such as terrain.

    Parameters
    ----------
    points : (n, 3) array
    loop : (b,) int64 array
        Boundary points in order, in either direction.

    Returns
    -------
    (b,) int64 array, beginning with the same point.

    Examples
    --------
    >>> tent = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 2]])
    >>> anticlockwise(tent, np.array([0, 3, 2, 1]))
    array([0, 1, 2, 3])
    """
    corners = points[loop] - points[loop].mean(axis=0)
    area = 0.5 * np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    size = np.linalg.norm(area)
    bulge = (points - points[loop].mean(axis=0)).mean(axis=0) @ area
    is_level = abs(bulge) <= LEVEL * size**1.5 and abs(area[2]) > UPRIGHT * size
    return reversed_loop(loop) if (area[2] if is_level else bulge) < 0.0 else loop
