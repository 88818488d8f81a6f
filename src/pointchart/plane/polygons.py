"""Polygons in the plane."""

import numpy as np

from ..typing import UV


def signed_area(loop: UV) -> float:
    """Return the area of a polygon, positive if it runs anticlockwise."""
    a = loop - loop[0]
    b = np.roll(a, -1, axis=0)
    return float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2.0)
