"""Longitude and latitude that nobody named: degrees beside a height in metres."""

import numpy as np
from scipy.spatial import cKDTree

from ..typing import Points

# A degree is 111 km, so heights in metres span more than this many times what degrees span, on all but flat land.
_STEEP = 20.0
# Heights of neighbours in the plane differ by less than this share of all heights on land; round a pole by a third.
_SMOOTH = 0.1
_SAMPLE = 1000  # points whose neighbours are looked at


def seem_degrees(points: Points) -> bool:
    """Tell whether x and y are degrees rather than lengths: in range, and far smaller than heights that vary smoothly.

    Parameters
    ----------
    points : (n, 3) array

    Examples
    --------
    >>> lon, lat = np.meshgrid(np.linspace(8.0, 8.1, 20), np.linspace(47.0, 47.1, 20))
    >>> height = 400.0 + 900.0 * (lon - 8.0)
    >>> seem_degrees(np.column_stack([lon.ravel(), lat.ravel(), height.ravel()]))
    True
    >>> seem_degrees(np.column_stack([lon.ravel(), lat.ravel(), height.ravel() / 900.0]))
    False
    """
    if len(points) < 4 or not np.isfinite(points).all():
        return False
    low, high = points.min(axis=0), points.max(axis=0)
    is_in_range = max(abs(low[0]), abs(high[0])) <= 180.0 and max(abs(low[1]), abs(high[1])) <= 90.0
    if not is_in_range or high[2] - low[2] <= _STEEP * max(high[0] - low[0], high[1] - low[1]):
        return False
    sample = points[:: max(1, len(points) // _SAMPLE)]
    _, nearest = cKDTree(points[:, :2]).query(sample[:, :2], k=2)
    rises = np.abs(points[nearest[:, 1], 2] - points[nearest[:, 0], 2])
    return bool(np.median(rises) <= _SMOOTH * (high[2] - low[2]))
