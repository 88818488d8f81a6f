"""Even samplings of discs and caps: sunflowers with a ring of points around them."""

from math import pi, sqrt

import numpy as np

from pointchart.errors import InputError
from pointchart.typing import UV, Floats


def polar(radius: Floats | float, turn: Floats) -> UV:
    """Convert polar to plane coordinates.

    Parameters
    ----------
    radius : (n,) float64 or float
    turn : (n,) float64
        In radians.

    Returns
    -------
    (n, 2) float64

    Examples
    --------
    >>> import numpy as np
    >>> polar(3.0, np.zeros(1)).tolist()
    [[3.0, 0.0]]
    """
    return np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=-1)


def ring_turns(n: int) -> Floats:
    """Divide a full turn evenly.

    Parameters
    ----------
    n : int

    Returns
    -------
    (n,) float64
        In radians, from 0.

    Examples
    --------
    >>> [round(float(turn), 4) for turn in ring_turns(4)]
    [0.0, 1.5708, 3.1416, 4.7124]
    """
    return 2 * pi / n * np.arange(n, dtype=np.float64)


def sunflower(n: int) -> tuple[Floats, Floats]:
    """Spread points evenly over the area of a disc, or of any surface of revolution.

    Each next point turns by the golden angle, and adds the same share of the area.

    Parameters
    ----------
    n : int

    Returns
    -------
    share : (n,) float64
        The share of the area within the circle of each point, between 0 and 1.
    turn : (n,) float64
        In radians.

    Examples
    --------
    >>> sunflower(2)[0].tolist()
    [0.25, 0.75]
    """
    count = np.arange(n, dtype=np.float64)
    return (count + 0.5) / n, pi * (3 - sqrt(5)) * count


def split_rim(n: int, *, area: float, perimeter: float) -> tuple[int, float]:
    """Divide points between a rim and the inside so that both are equally dense.

    With spacing d, nearly equilateral triangles take n = area / (sqrt(3)/2 d^2) + perimeter / (2 d) points.

    Parameters
    ----------
    n : int
        Points in all, at least 8.
    area, perimeter : float

    Returns
    -------
    n_rim : int
    spacing : float
        In the unit of the perimeter.

    Raises
    ------
    InputError
        With fewer than 8 points.

    Examples
    --------
    >>> split_rim(1000, area=3.14, perimeter=6.28)[0]
    102
    """
    if n < 8:
        raise InputError(f"{n} points are too few for a rim and an inside; take at least 8")
    spacing = (perimeter / 2 + sqrt(perimeter**2 / 4 + 8 / sqrt(3) * n * area)) / (2 * n)
    return round(perimeter / spacing), spacing
