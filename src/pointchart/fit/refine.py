"""B-spline surfaces refined until a tolerance is met: knots where points are out of it, parameters corrected."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points, check_uv
from ..errors import InputError
from ..typing import UV, Floats, Indices, Mask, Points
from .bspline import BSplineSurface
from .deviation import Deviation
from .least_squares import least_squares
from .surface import closest_parameters, evaluate

MARGIN = 0.02  # of the extent of uv, by which the domain is larger, so that feet find room beyond the outermost points
FIRST_SPANS = 4  # in the shorter direction
CORRECTIONS = 3  # of the parameters, before deviations are judged
STEPS = 2  # of Newton's method in each correction
HELD_OUT = 10  # every tenth point is held out, to choose the fairness and to know noise from shape
SHARE = 16  # points a control point that are enough for a level but the last
MOST_ASPECT = 64.0
LEAST_SAMPLE = 20_000
SHARES = (0.8, 0.4, 0.2, 0.1)
FAIRNESS = (1e-1, 1e-3, 1e-5, 1e-7, 1e-9)
GAIN = 0.97  # of the RMS of points held out: more control points that bring less follow noise
HOPELESS = 2  # levels without such a gain, after which refinement ends

Loss: TypeAlias = Callable[[Floats], Floats | None]


@dataclass(frozen=True, slots=True, eq=False)
class Level:
    """One level of refinement.

    Attributes
    ----------
    n_control : int
    fairness : float
    largest : float
        Deviation but for the outliers, in the unit of the points.
    rms : float
    held_out : float
        RMS over the points that the level was not fitted to.
    """

    n_control: int
    fairness: float
    largest: float
    rms: float
    held_out: float


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """A surface with the feet of the points on it.

    Attributes
    ----------
    surface : BSplineSurface
    uv : (n, 2) float64
        Corrected parameters: those of the nearest point of the surface.
    levels : list of Level
        From coarse to fine.
    is_met : bool
        Whether the last level is within the tolerance.
    is_noise : bool
        Whether refinement ended because finer knots would follow noise.
    """

    surface: BSplineSurface
    uv: UV
    levels: list[Level]
    is_met: bool
    is_noise: bool


def squares(_residuals: Floats) -> Floats | None:
    """Weigh all points the same: least squares."""
    return None


def huber(residuals: Floats) -> Floats | None:
    """Weigh points beyond 1.345 standard deviations by the inverse of their distance (Huber 1964); robust scale."""
    scale = 1.345 * 1.4826 * np.median(residuals)
    return np.minimum(1.0, scale / np.maximum(residuals, np.finfo(float).tiny)) if scale > 0.0 else None


def fit_bspline(
    points: ArrayLike,
    uv: ArrayLike,
    *,
    tolerance: float,
    outliers: float = 0.005,
    max_control: int | None = None,
    degree: int = 3,
    fairness: float | None = None,
    loss: Loss = squares,
) -> Fit:
    """Fit a B-spline surface to points at parameters until it is within a tolerance.

    Knots are laid evenly and halved where points are out of tolerance; at each level the parameters are corrected to
    those of the nearest points of the surface, and the surface is fitted again. Of every ten points one is held out
    until the last fit: where finer knots no longer bring the surface nearer to those, they would follow noise.

    Parameters
    ----------
    points : (n, 3) array
    uv : (n, 2) array
        One-to-one parameters, in any unit and at any offset; the better, the more evenly they stretch. Those with a
        free boundary (`uv_free_boundary`) give the full order of convergence.
    tolerance : float
        Largest deviation, in the unit of the points.
    outliers : float
        Share of the points that may deviate by more.
    max_control : int, optional
        Control points, at most; half the number of points, if not given.
    degree : int
        2 to 5.
    fairness : float, optional
        See `least_squares`; chosen at each level by the points held out, if not given.
    loss : callable
        ``loss(residuals) -> weights``: `squares`, or `huber` for scans with many outliers.

    Returns
    -------
    Fit
        Of the tolerance, if it is met; else the best that there is: `is_met` tells.

    Raises
    ------
    InputError
        If an argument is out of range, or the points are fewer than the control points of the coarsest surface.

    References
    ----------
    Hoschek and Lasser 1993, sections 4.4 and 13.4. Floater and Reimers 2001, section 7.

    Examples
    --------
    >>> uv = np.array([[i / 9, j / 9] for i in range(10) for j in range(10)])
    >>> bowl = np.column_stack([uv, uv[:, 0] ** 2 + uv[:, 1] ** 2])
    >>> fit = fit_bspline(bowl, uv, tolerance=1e-6)
    >>> fit.is_met, len(fit.levels)
    (True, 1)
    """
    points = check_points(points)
    uv = check_uv(uv, len(points))
    most = _most_control(len(points), tolerance, outliers, max_control, degree)
    rules = _Rules(degree, tolerance, outliers, FAIRNESS if fairness is None else (fairness,), loss)
    is_held = np.arange(len(points)) % HELD_OUT == HELD_OUT - 1
    knots: _Knots | None = _first_knots(uv, degree)
    levels: list[Level] = []
    best_level = 0
    while knots is not None:
        sampled = _fit_sample(points, uv, knots, is_held, rules)
        levels.append(sampled.level)
        met = sampled.level.largest <= tolerance
        if len(levels) == 1 or met or sampled.level.held_out < GAIN * levels[best_level].held_out:
            best, best_level = sampled, len(levels) - 1
        is_noise = not met and len(levels) - 1 - best_level >= HOPELESS
        knots = None if is_noise else _halved(knots, uv, sampled, rules, most)
        if met or knots is None:
            fit = _fit_all(points, uv, best, levels, is_noise, rules)
            if fit.is_met:
                break
    return fit


_Knots: TypeAlias = tuple[Floats, Floats]


@dataclass(frozen=True, slots=True, eq=False)
class _Rules:
    degree: int
    tolerance: float
    outliers: float
    fairness: tuple[float, ...]
    loss: Loss


def _most_control(n: int, tolerance: float, outliers: float, max_control: int | None, degree: int) -> int:
    """Check the numbers; return the largest number of control points."""
    if not 0.0 < tolerance < np.inf:
        raise InputError(f"the tolerance is {tolerance:g}; it has to be positive and finite, in the unit of the scan")
    if not 0.0 <= outliers < 1.0:
        raise InputError(f"the share of outliers is {outliers:g}; it has to be at least 0 and below 1")
    if not 2 <= degree <= 5:
        raise InputError(f"the degree is {degree}; it has to be 2, 3, 4 or 5")
    least = (FIRST_SPANS + degree) ** 2
    most = n // 2 if max_control is None else max_control
    if most < least:
        said = f"{n} points are" if max_control is None else f"{max_control} control points are"
        raise InputError(f"{said} too few: the coarsest surface of degree {degree} has {least} control points")
    return min(most, n)


def _first_knots(uv: UV, degree: int) -> _Knots:
    """Lay knots with nearly square spans, half by length and half by number of points."""
    low, extent = uv.min(axis=0), np.ptp(uv, axis=0)
    if not extent.min() > 0.0:
        raise InputError("the parameters lie on one line, so they hold no surface; give one-to-one parameters")
    n_spans = np.rint(FIRST_SPANS * np.minimum(extent / extent.min(), MOST_ASPECT)).astype(int)
    margin = MARGIN * extent.min()
    in_u, in_v = (
        _clamped(places, low[k] - margin, low[k] + extent[k] + margin, n_spans[k], degree)
        for k, places in enumerate(uv.T)
    )
    return in_u, in_v


def _clamped(places: Floats, first: float, last: float, n_spans: int, degree: int) -> Floats:
    shares = np.linspace(0.0, 1.0, n_spans + 1)[1:-1]
    inner = 0.5 * (first + shares * (last - first)) + 0.5 * np.quantile(places, shares)
    return np.concatenate([[first] * (degree + 1), inner, [last] * (degree + 1)])


def _n_control(knots: _Knots, degree: int) -> int:
    return (len(knots[0]) - degree - 1) * (len(knots[1]) - degree - 1)


def _thinned(rows: Indices, n: int) -> Indices:
    return rows[:: max(1, len(rows) // n)]


@dataclass(frozen=True, slots=True, eq=False)
class _Sampled:
    """A surface fitted to a sample of the points: as many as its control points need."""

    surface: BSplineSurface
    level: Level
    rows: Indices
    is_out: Mask


def _fit_sample(points: Points, uv: UV, knots: _Knots, is_held: Mask, rules: _Rules) -> _Sampled:
    """Fit with given knots, choose the fairness, and judge by the sample and by points held out."""
    enough = max(LEAST_SAMPLE, SHARE * _n_control(knots, rules.degree))
    rows, test = _thinned(np.flatnonzero(~is_held), enough), _thinned(np.flatnonzero(is_held), enough)

    def fitted(fairness: float, feet: UV, weights: Floats | None = None) -> BSplineSurface:
        return least_squares(points[rows], feet, *knots, degree=rules.degree, weights=weights, fairness=fairness)

    trials = {fairness: fitted(fairness, uv[rows]) for fairness in rules.fairness}
    fairness = min(trials, key=lambda f: Deviation(_distances(trials[f], points[test], uv[test])[1]).rms)
    surface = trials[fairness]
    for _ in range(CORRECTIONS):
        feet, distance = _distances(surface, points[rows], uv[rows])
        surface = fitted(fairness, feet, rules.loss(distance))
    seen = np.concatenate([rows, test])
    distance = _distances(surface, points[seen], uv[seen])[1]
    whole, held = Deviation(distance), Deviation(distance[len(rows) :])
    level = Level(surface.n_control, fairness, whole.largest(rules.outliers), whole.rms, held.rms)
    return _Sampled(surface, level, seen, distance > rules.tolerance)


def _fit_all(points: Points, uv: UV, sampled: _Sampled, levels: list[Level], is_noise: bool, rules: _Rules) -> Fit:
    """Fit to all points, with the knots and the fairness that were found on a sample."""
    surface = sampled.surface
    feet, distance = _distances(surface, points, uv)
    surface = least_squares(
        points,
        feet,
        surface.knots_u,
        surface.knots_v,
        degree=rules.degree,
        weights=rules.loss(distance),
        fairness=sampled.level.fairness,
    )
    feet, distance = _distances(surface, points, uv)
    return Fit(surface, feet, list(levels), Deviation(distance).largest(rules.outliers) <= rules.tolerance, is_noise)


def _distances(surface: BSplineSurface, points: Points, uv: UV) -> tuple[UV, Floats]:
    """Return the feet of points and how far they are."""
    uv = closest_parameters(surface, points, uv, n_steps=STEPS)
    return uv, np.linalg.norm(evaluate(surface, uv) - points, axis=1)


def _halved(knots: _Knots, uv: UV, sampled: _Sampled, rules: _Rules, most: int) -> _Knots | None:
    """Halve the spans in which too many points are out of tolerance; the worst of them, if there is no room for all."""
    degree, spans, out, splits = rules.degree, [], [], []
    for knots_of, places in zip(knots, uv[sampled.rows].T, strict=True):
        ends = knots_of[degree:-degree]
        span = np.clip(np.searchsorted(ends, places, side="right") - 1, 0, len(ends) - 2)
        inside, outside = np.bincount(span, minlength=len(ends) - 1), np.bincount(span, sampled.is_out, len(ends) - 1)
        spans.append(ends)
        out.append(np.where(outside > rules.outliers * inside, outside, 0.0))
    for share in SHARES:
        splits = [_worst(o, share) for o in out]
        in_u, in_v = (
            np.sort(np.concatenate([k, 0.5 * (e[s] + e[s + 1])])) for k, e, s in zip(knots, spans, splits, strict=True)
        )
        finer = in_u, in_v
        if _n_control(finer, degree) <= most:
            return finer if any(map(len, splits)) else None
    return None


def _worst(out: Floats, share: float) -> Indices:
    """Return the spans that hold a share of all points out of tolerance, the worst first."""
    order = np.argsort(-out, kind="stable")[: np.count_nonzero(out)]
    before = np.cumsum(out[order]) - out[order]
    return np.asarray(order[before < share * out.sum()])
