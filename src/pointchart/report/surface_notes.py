"""How near a fitted surface is to its scan, and which choices were made on the way."""

from ..surface import Level, deviation_table
from ..surface.surfacing import SurfacedScan
from .record import Note


def surface_notes(surfaced: SurfacedScan, tolerance: float, outliers: float, unit: str) -> list[Note]:
    """Say how near a surface is to its scan, one figure a note."""
    surface, n = surfaced.fit.surface, len(surfaced.deviation.signed)
    across, along = surface.control.shape[:2]
    met = "met" if surfaced.fit.is_met else "NOT met"
    lines = [
        f"B-spline surface of degree {surface.degree}, {across} x {along} control points for {n} points "
        f"({n / surface.n_control:.1f} each), trimmed by {_loops(len(surfaced.loops))}",
        f"tolerance {tolerance:.4g} {unit} but for {100 * outliers:g} % outliers: {met}",
    ]
    figures = deviation_table(surfaced.deviation, outliers, tolerance=tolerance)
    return [Note(line) for line in (*lines, *(f"  {name}: {value:.4g}" for name, value in figures))]


def choice_notes(surfaced: SurfacedScan) -> list[Note]:
    """Say which choices were made and why: parameters, knots, fairness, and where refinement ended."""
    fit = surfaced.fit
    low, high = fit.surface.domain
    extent = " x ".join(f"{side:.4g}" for side in high - low)
    ended = "the tolerance is met" if fit.is_met else "no more control points are allowed"
    if fit.is_noise:
        ended = "finer knots bring points left out of the fit no nearer: they would follow noise"
    lines = [
        f"parameters {surfaced.chart.name}: a domain of {extent}",
        "level by level, knots halved where points are out of tolerance; fairness by points left out of the fit:",
        *(_level(number, level) for number, level in enumerate(fit.levels, start=1)),
        f"ended because {ended}",
    ]
    return [Note(line) for line in lines]


def _level(number: int, level: Level) -> str:
    return (
        f"  {number}: {level.n_control} control points, fairness {level.fairness:g}, deviation {level.largest:.4g} but "
        f"for outliers, RMS {level.rms:.4g}, {level.held_out:.4g} of points left out"
    )


def _loops(n: int) -> str:
    return "its boundary" if n == 1 else f"its boundary and {n - 1} gaps" if n > 2 else "its boundary and a gap"
