"""The measures of a mesh and its map all together, each boiled down to a few figures."""

from dataclasses import dataclass

import numpy as np

from ..typing import UV, Floats, Points, Triangles
from .distortion import area_distortions, conformal_distortions, l2_stretch, least_distance, linf_stretch
from .quality import areas, radius_ratios


@dataclass(frozen=True, slots=True)
class Spread:
    """How values of triangles are spread; the mean and the percentile weigh triangles by their area in space."""

    mean: float
    percentile_95: float
    largest: float


@dataclass(frozen=True, slots=True)
class MeshQuality:
    """The shape of the triangles and the distortion of the map, dimensionless; what folds or is flat is infinite.

    Attributes
    ----------
    least_radius_ratio, median_radius_ratio : float
    l2_stretch, linf_stretch : float
    conformal, area : Spread
    least_uv_distance : float
    """

    least_radius_ratio: float
    median_radius_ratio: float
    l2_stretch: float
    linf_stretch: float
    conformal: Spread
    area: Spread
    least_uv_distance: float


def measure_quality(points: Points, triangles: Triangles, uv: UV) -> MeshQuality:
    """Measure the shape of the triangles and the distortion of the map.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> quality = measure_quality(corners, np.array([[0, 1, 2], [0, 2, 3]]), corners[:, :2])
    >>> round(quality.l2_stretch, 12), round(quality.area.largest, 12), quality.least_uv_distance
    (1.0, 1.0, 1.0)
    """
    ratios, area = radius_ratios(points, triangles), areas(points, triangles)
    return MeshQuality(
        least_radius_ratio=float(ratios.min()),
        median_radius_ratio=float(np.median(ratios)),
        l2_stretch=float(l2_stretch(points, triangles, uv)),
        linf_stretch=float(linf_stretch(points, triangles, uv)),
        conformal=_spread(conformal_distortions(points, triangles, uv), area),
        area=_spread(area_distortions(points, triangles, uv), area),
        least_uv_distance=least_distance(uv),
    )


def _spread(values: Floats, weights: Floats) -> Spread:
    # Triangles without area in space have no shape that a map could keep.
    values, weights = values[weights > 0.0], weights[weights > 0.0]
    order = np.argsort(values)
    up_to = np.cumsum(weights[order])
    place = min(int(np.searchsorted(up_to, 0.95 * up_to[-1])), len(values) - 1)
    return Spread(float(values @ weights / up_to[-1]), float(values[order[place]]), float(values.max()))
