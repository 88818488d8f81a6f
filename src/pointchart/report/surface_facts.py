"""Fitted surfaces as plain data for JSON."""

from dataclasses import asdict
from typing import Any

import numpy as np

from ..surface import deviation_table
from ..surface.surfacing import SurfacedScan
from ..typing import Points

# For programs: the names of a deviation table's rows, in its order, without its numbers in them.
FIGURES = ("max", "max_but_outliers", "percentile_95", "rms", "mean", "share_within_tolerance")


def surface_facts(
    surfaced: SurfacedScan, points: Points, tolerance: float, outliers: float, unit: str
) -> dict[str, Any]:
    """Return a surface and its deviations; `points` are those of the vertices."""
    fit = surfaced.fit
    figures = deviation_table(surfaced.deviation, outliers, tolerance=tolerance)
    worst = int(np.argmax(np.abs(surfaced.deviation.signed)))
    return {
        "unit": unit,
        "degree": fit.surface.degree,
        "control_points": list(fit.surface.control.shape[:2]),
        "points_a_control_point": len(points) / fit.surface.n_control,
        "domain": fit.surface.domain.tolist(),
        "trimming_loops": [len(loop) for loop in surfaced.loops],
        "tolerance": tolerance,
        "outliers": outliers,
        "met": fit.is_met,
        "ended_at_noise": fit.is_noise,
        "deviation": dict(zip(FIGURES, (value for _, value in figures), strict=True)),
        "worst_at": points[worst].tolist(),
        "levels": [asdict(level) for level in fit.levels],
    }
