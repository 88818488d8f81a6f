"""Places of points in words, as messages tell them."""

from ..typing import Points


def place_of(points: Points, index: int) -> str:
    """Write where a point is.

    Examples
    --------
    >>> import numpy as np
    >>> place_of(np.array([[0.5, -2.0, 1e6]]), 0)
    '(0.5, -2, 1000000)'
    """
    return "(" + coordinates_of(points, index).replace(",", ", ") + ")"


def coordinates_of(points: Points, index: int) -> str:
    """Write the coordinates of a point as options take them.

    Examples
    --------
    >>> import numpy as np
    >>> coordinates_of(np.array([[0.5, -2.0, 1e6]]), 0)
    '0.5,-2,1000000'
    """
    return ",".join(f"{x:.9g}" for x in points[index])
