"""The whole way from points to a trimmed B-spline surface."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points
from ..chart.free_boundary import uv_free_boundary
from ..chart.low_stretch import uv_low_stretch
from ..chart.rule import Chart
from ..clock import StageClock
from ..errors import InputError, Remedy, SolveError
from ..gaps.bridges import BridgedPatch
from ..gaps.rules import BoundaryAndGaps, GapRule, leave_gaps_open, refuse_second_boundary
from ..map.scan_parameters import LayoutRule
from ..mesh.connectivity import boundary_loops, half_edges
from ..pipeline import Reconstruction, reconstruct
from ..plane.crossings import is_simple
from ..plane.polygons import signed_area
from ..typing import UV, Points, Triangles
from . import Deviation, Fit, fit_bspline, measure_deviation, squares
from .knots import MARGIN
from .loss import Loss
from .to_tolerance import check_tolerance

FREE_MOST = 100_000  # points up to which a free boundary costs minutes at most; beyond, low stretch on the circle
SPIKE = 120.0  # degrees
COARSE = 0.1  # of the diagonal: a tolerance beyond it is one in another unit


@dataclass(frozen=True, slots=True, eq=False)
class SurfacedScan:
    """A trimmed B-spline surface of a scan, with the mesh that gave it its parameters.

    Attributes
    ----------
    reconstruction : Reconstruction
        The certified mesh; its `uv` are those that the fit began with, but for a turn.
    fit : Fit
        In the order of the mesh's vertices.
    loops : list of (b, 2) arrays
        The feet of the boundary, anticlockwise, and of gaps of the scan, clockwise: they trim the surface.
    deviation : Deviation
    chart : Chart
        What gave the parameters: `uv_free_boundary` or `uv_low_stretch`.
    """

    reconstruction: Reconstruction
    fit: Fit
    loops: list[UV]
    deviation: Deviation
    chart: Chart


def fit_scan(
    points: ArrayLike,
    loop: ArrayLike | None = None,
    *,
    tolerance: float,
    outliers: float = 0.005,
    max_control: int | None = None,
    degree: int = 3,
    fairness: float | None = None,
    loss: Loss = squares,
    outer: ArrayLike | None = None,
    gaps: GapRule | None = None,
    square: LayoutRule | None = None,
    clock: StageClock | None = None,
) -> SurfacedScan:
    """Fit a B-spline surface to a scan of one surface patch, trimmed along its boundary and its gaps.

    The parameters are those of a free boundary, which keep lengths and angles as well as may be: no corners have to be
    chosen, spans are nearly square in space, and the fit has its full order of convergence. Scans of more than 100,000
    points take parameters of low stretch on the circle, which cost less.

    Parameters
    ----------
    points, loop, outer, gaps, clock
        See `reconstruct`; but gaps are cut out of the surface, if nothing else is asked for.
    tolerance, outliers, max_control, degree, fairness, loss
        See `fit_bspline`; the tolerance is in the unit of the scan.

    square : callable, optional
        ``square(points, loop) -> (b, 2)``, as `layout` of `reconstruct`, with corners on the square: the surface is
        then a four-sided patch without a trimmed border, over parameters of low stretch on the square.

    Returns
    -------
    SurfacedScan
        Whether the tolerance is met says ``fit.is_met``; see `check_met`.

    Raises
    ------
    InputError, SolveError
        See `reconstruct` and `fit_bspline`; and if the tolerance is more than a tenth of the size of the scan.

    References
    ----------
    Floater and Reimers 2001, section 6.

    Examples
    --------
    >>> from pointchart import shapes
    >>> cap = fit_scan(shapes.hemisphere(600).points, tolerance=0.01)
    >>> cap.fit.is_met, len(cap.loops), cap.deviation.largest(0.005) <= 0.01
    (True, 1, True)
    """
    clock = clock or StageClock()
    cloud = check_points(points)
    check_tolerance(tolerance)
    _check_unit(cloud, tolerance)
    rule = gaps or (cut_gaps_out if loop is None and outer is None else leave_gaps_open)
    if square is None:
        chart: Chart = uv_free_boundary if len(cloud) <= FREE_MOST else uv_low_stretch
        meshed = reconstruct(cloud, loop, outer=outer, gaps=rule, chart=chart, clock=clock)
        uv, margin = _turned(meshed.uv), MARGIN
    else:
        chart = uv_low_stretch
        meshed = reconstruct(cloud, loop, outer=outer, gaps=rule, layout=square, chart=chart, clock=clock)
        uv, margin = meshed.uv, 0.0
    cloud = cloud[meshed.rows]
    with clock("fit"):
        fit = fit_bspline(
            cloud,
            uv,
            tolerance=tolerance,
            outliers=outliers,
            max_control=max_control,
            degree=degree,
            fairness=fairness,
            margin=margin,
            loss=loss,
        )
    loops = _trims(meshed.triangles, uv, fit.uv)
    if square is not None:
        (low_u, low_v), (high_u, high_v) = fit.surface.domain
        loops[0] = np.array([[low_u, low_v], [high_u, low_v], [high_u, high_v], [low_u, high_v]])
    return SurfacedScan(meshed, fit, loops, measure_deviation(cloud, fit.surface, fit.uv), chart)


def cut_gaps_out(found: BoundaryAndGaps) -> list[BridgedPatch]:
    """Leave all gaps open, but refuse a scan of which one may be the boundary."""
    refuse_second_boundary(found)
    return leave_gaps_open(found)


def check_met(surfaced: SurfacedScan, tolerance: float, outliers: float) -> None:
    """Check that a surface is within its tolerance.

    Raises
    ------
    SolveError
        Saying how far it is, with how many control points, and what may help.
    """
    if surfaced.fit.is_met:
        return
    off, n_control = surfaced.deviation, surfaced.fit.surface.n_control
    remedies: tuple[Remedy, ...] = (Remedy.allow_control_points, Remedy.allow_deviation, Remedy.take_the_best)
    noise = ""
    if surfaced.fit.is_noise:
        held_out = min(level.held_out for level in surfaced.fit.levels)
        remedies = (Remedy.allow_deviation, Remedy.take_the_best)
        noise = (
            f"; finer knots would follow noise, or what no point shows: points left out of the fit stay {held_out:.3g} "
            f"away (RMS), which allows a tolerance of about {max(3.0 * held_out, 1.1 * off.largest(outliers)):.2g}"
        )
    raise SolveError(
        f"the surface of {n_control} control points deviates by {off.largest(outliers):.4g} but for "
        f"{100 * outliers:g} % of the points (RMS {off.rms:.4g}), more than the tolerance of {tolerance:.4g}{noise}",
        remedies=remedies,
    )


def _check_unit(points: Points, tolerance: float) -> None:
    diagonal = float(np.hypot.reduce(np.ptp(points, axis=0)))
    if tolerance > COARSE * diagonal:
        raise InputError(
            f"the tolerance of {tolerance:g} is {tolerance / diagonal:.2g} times the scan, {diagonal:.4g} across: is "
            "it in another unit? Give it in the unit of the scan"
        )


def _turned(uv: UV) -> UV:
    """Turn parameters so that they extend most along u and least along v."""
    middle = uv - uv.mean(axis=0)
    _, axes = np.linalg.eigh(middle.T @ middle)
    long = axes[:, 1]
    return np.asarray(middle @ np.column_stack([long, [-long[1], long[0]]]))


def _trims(triangles: Triangles, before: UV, feet: UV) -> list[UV]:
    """Return the boundary of a mesh on the surface; before the parameters were corrected, where its feet cross."""
    loops = boundary_loops(half_edges(triangles, len(feet)))
    loops.sort(key=lambda loop: -np.ptp(before[loop], axis=0).max())
    either = ([without_spikes(places[loop]) for loop in loops] for places in (feet, before))
    sound = [[outer, *(hole for hole in holes if signed_area(hole) < 0.0)] for outer, *holes in either]
    # A gap that is a mere slit may have no area left, and is not cut out then.
    return sound[0] if len(sound[0]) == len(sound[1]) and all(map(is_simple, sound[0])) else sound[1]


def without_spikes(polygon: UV) -> UV:
    """Leave out corners at which a polygon turns back by more than 120 degrees, until there are none; 3 corners stay.

    A boundary point that was squeezed out of the surface makes a needle that no CAD system takes for an edge.

    Examples
    --------
    >>> without_spikes(np.array([[0.0, 0], [4, 0], [4, 4], [2, 4], [2, 9], [1.9, 4], [0, 4]])).tolist()
    [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 4.0], [1.9, 4.0], [0.0, 4.0]]
    """
    while len(polygon) > 3:
        polygon = polygon[(polygon != np.roll(polygon, 1, axis=0)).any(axis=1)]
        ahead = np.roll(polygon, -1, axis=0) - polygon
        behind = np.roll(ahead, 1, axis=0)
        cosine = (ahead * behind).sum(axis=1)
        length = np.linalg.norm(ahead, axis=1) * np.linalg.norm(behind, axis=1)
        sharpest = int(np.argmin(cosine / length))
        if cosine[sharpest] >= np.cos(np.deg2rad(SPIKE)) * length[sharpest]:
            break
        polygon = np.delete(polygon, sharpest, axis=0)
    return polygon
