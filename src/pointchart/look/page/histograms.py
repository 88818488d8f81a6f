"""How a mesh is made, as histograms."""

from typing import Any

import numpy as np

from ...mesh.connectivity import half_edges
from ...mesh.distortion import conformal_distortions
from ...mesh.quality import edge_lengths, radius_ratios, smallest_angles
from ...typing import UV, Floats, Points, Triangles
from ..color_scales import counted

BINS = 40  # bars: a choice, some pixels each beside the views
BEYOND = 99.5  # per cent of the values that a histogram without an end shows; the others are in its last bar


def quality_histograms(points: Points, triangles: Triangles, uv: UV, spacing: Floats) -> list[dict[str, Any]]:
    """Count triangles by their shape, edges by their length, and triangles by the distortion of their angles.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
    uv : (n, 2) array
    spacing : (n,) array

    Returns
    -------
    list of dict
        With `title`, `meaning`, `low`, `high` and `counts`.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    >>> made = quality_histograms(corners, np.array([[0, 1, 2]]), corners[:, :2], np.ones(3))
    >>> [sum(h["counts"]) for h in made]
    [1, 1, 3, 1]
    """
    pairs, lengths = edge_lengths(points, half_edges(triangles, len(points)))
    distortions = conformal_distortions(points, triangles, uv)
    return [
        _histogram("smallest angle", "of each triangle, in degrees", smallest_angles(points, triangles), 0.0, 60.0),
        _histogram("shape", "of triangles: 1 equilateral, 0 flat", radius_ratios(points, triangles), 0.0, 1.0),
        _histogram("edges", "length over the spacing at their ends", lengths / spacing[pairs].max(axis=1), 0.0, None),
        _histogram("angles in the plane", "conformal distortion of triangles: 1 is none", distortions, 1.0, None),
    ]


def _histogram(title: str, meaning: str, values: Floats, low: float, high: float | None) -> dict[str, Any]:
    if high is None:
        finite = values[np.isfinite(values)]
        high = max(float(np.percentile(finite, BEYOND)), low + 1.0) if len(finite) else low + 1.0
    counts, _ = counted(values, low, high, BINS)
    return {"title": title, "meaning": meaning, "low": low, "high": high, "counts": counts.tolist()}
