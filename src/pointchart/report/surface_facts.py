"""Fitted surfaces as text and as plain data for JSON; computes nothing but figures of the deviation."""

from dataclasses import asdict
from typing import Any

import numpy as np

from .chart.on_mesh import ChartRule, uv_free_boundary, uv_low_stretch
from .surface import Level, deviation_table
from .surface.surfacing import SurfacedScan
from .typing import Points

CHARTS: dict[ChartRule, str] = {
    uv_free_boundary: "with a free boundary, in the unit of the scan",
    uv_low_stretch: "of low stretch on a convex domain",
}
FIGURES = ("max", "max_but_outliers", "percentile_95", "rms", "mean", "share_within_tolerance")


def surface_lines(surfaced: SurfacedScan, tolerance: float, outliers: float, unit: str) -> list[str]:
    """Say how near a surface is to its scan, one figure a line."""
    surface, n = surfaced.fit.surface, len(surfaced.deviation.signed)
    across, along = surface.control.shape[:2]
    met = "met" if surfaced.fit.is_met else "NOT met"
    lines = [
        f"B-spline surface of degree {surface.degree}, {across} x {along} control points for {n} points "
        f"({n / surface.n_control:.1f} each), trimmed by {_loops(len(surfaced.loops))}",
        f"tolerance {tolerance:.4g} {unit} but for {100 * outliers:g} % outliers: {met}",
    ]
    figures = deviation_table(surfaced.deviation, outliers, tolerance=tolerance)
    return lines + [f"  {name}: {value:.4g}" for name, value in figures]


def explain_lines(surfaced: SurfacedScan) -> list[str]:
    """Say which choices were made and why: parameters, knots, fairness, and where refinement ended."""
    fit = surfaced.fit
    low, high = fit.surface.domain
    extent = " x ".join(f"{side:.4g}" for side in high - low)
    ended = "the tolerance is met" if fit.is_met else "no more control points are allowed"
    if fit.is_noise:
        ended = "finer knots bring points left out of the fit no nearer: they would follow noise"
    return [
        f"parameters {CHARTS[surfaced.chart]}: a domain of {extent}",
        "level by level, knots halved where points are out of tolerance; fairness by points left out of the fit:",
        *(_level(number, level) for number, level in enumerate(fit.levels, start=1)),
        f"ended because {ended}",
    ]


def surface_report(
    surfaced: SurfacedScan, points: Points, tolerance: float, outliers: float, unit: str
) -> dict[str, Any]:
    """Return a surface and its deviations as plain data for JSON; `points` are those of the vertices."""
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


def _level(number: int, level: Level) -> str:
    return (
        f"  {number}: {level.n_control} control points, fairness {level.fairness:g}, deviation {level.largest:.4g} but "
        f"for outliers, RMS {level.rms:.4g}, {level.held_out:.4g} of points left out"
    )


def _loops(n: int) -> str:
    return "its boundary" if n == 1 else f"its boundary and {n - 1} gaps" if n > 2 else "its boundary and a gap"
