"""Triangles that span more than the points are apart: narrow slots of a scan that a mesh closes."""

import numpy as np

from ..points.neighbors import spacing_of_places
from ..typing import Points, Triangles
from .quality import areas

SPANNING = 2.5  # spacings of an edge: on even samples none is longer, on random ones one in a hundred


def spanning_triangles(points: Points, triangles: Triangles) -> tuple[int, float]:
    """Count the triangles with an edge of over 2.5 local spacings, and tell their share of the area, in [0, 1].

    Examples
    --------
    >>> from pointchart import shapes
    >>> sheet = shapes.grid(9, 9)
    >>> spanning_triangles(sheet.points, sheet.triangles)
    (0, 0.0)
    """
    spacing = spacing_of_places(points)
    starts, ends = triangles, np.roll(triangles, -1, axis=1)
    lengths = np.linalg.norm(points[starts] - points[ends], axis=2)
    spans = (lengths > SPANNING * np.maximum(spacing[starts], spacing[ends])).any(axis=1)
    area = areas(points, triangles)
    return int(np.count_nonzero(spans)), float(area[spans].sum() / area.sum())
