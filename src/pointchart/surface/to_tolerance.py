"""B-spline surfaces refined until a tolerance is met: knots where points are out of it, parameters corrected."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points, check_uv, check_weights
from ..errors import InputError
from ..typing import UV, Floats, Indices, Mask, Points
from .bspline import BSplineSurface
from .derivatives import closest_parameters, evaluate
from .deviation import Deviation
from .knots import FIRST_SPANS, MARGIN, Knots, first_knots, halve, n_control
from .loss import Loss, squares
from .normal_equations import least_squares

CORRECTIONS = 8  # of the parameters, at most, before deviations are judged
WORTH = 0.95  # of the RMS: a correction that brings less is the last
STEPS, LAST_STEPS = 2, 20  # of Newton's method in each correction, and at the end
HELD_OUT = 10  # one point in ten is held out, to choose the fairness and to know noise from shape
SHARE = 16  # points a control point that are enough for a level but the last
LEAST_SAMPLE = 20_000  # points of a level, so that coarse ones, of few control points, still see all of the surface
FAIRNESS = (1e-1, 1e-3, 1e-5, 1e-7, 1e-9)  # that are tried: by tens instead they bring points held out no nearer
GAIN = 0.97  # of the RMS of points held out: more control points that bring less follow noise
HOPELESS = 2.0  # times the control points without such a gain, after which refinement ends


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
        Whether the surface is within the tolerance.
    is_noise : bool
        Whether refinement ended because finer knots would follow noise.
    """

    surface: BSplineSurface
    uv: UV
    levels: list[Level]
    is_met: bool
    is_noise: bool


def fit_bspline(
    points: ArrayLike,
    uv: ArrayLike,
    *,
    tolerance: float,
    outliers: float = 0.005,
    max_control: int | None = None,
    degree: int = 3,
    fairness: float | None = None,
    margin: float = MARGIN,
    weights: ArrayLike | None = None,
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
    margin : float
        Of the shorter extent of uv, by which the domain is larger; 0 for four-sided patches.
    weights : (n,) array, optional
        Of the points, positive: such as one over the variance of a scanner's noise.
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
    Hoschek and Lasser 1993, sections 4.4 and 13.4. Floater and Reimers 2001, section 6.

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
    for name, value in (("fairness", fairness), ("margin", margin)):
        if value is not None and not 0.0 <= value < np.inf:
            raise InputError(f"the {name} is {value:g}; it has to be at least 0 and finite")
    rules = _Rules(
        degree,
        tolerance,
        outliers,
        FAIRNESS if fairness is None else (fairness,),
        np.ones(len(points)) if weights is None else check_weights(weights, len(points)),
        loss,
    )
    # At random, since scanners deliver rows; with a seed, since the same scan has to give the same surface.
    shuffled = np.random.default_rng(len(points)).permutation(len(points))
    n_held = len(points) // HELD_OUT
    split = shuffled[n_held:], shuffled[:n_held]
    knots: Knots | None = first_knots(uv, degree, margin, most)
    levels: list[Level] = []
    smoothest = nearest = None
    is_noise = False
    while knots is not None and not is_noise:
        sampled = _fit_sample(points, uv, knots, split, rules)
        level = sampled.level
        levels.append(level)
        if nearest is None or level.largest < nearest.level.largest:
            nearest = sampled
        if smoothest is None or level.held_out < GAIN * smoothest.level.held_out:
            smoothest = sampled
        rows, is_out = sampled.rows, sampled.is_out
        if level.largest <= tolerance:  # of a sample: what all the points say decides
            fit, is_out = _fit_all(points, uv, sampled, levels, rules)
            rows = np.arange(len(points))
            if fit.is_met:
                return fit
        is_noise = level.n_control >= HOPELESS * smoothest.level.n_control
        knots = halve(knots, uv[rows], is_out, outliers, degree, most)
    fit, _ = _fit_all(points, uv, (smoothest if is_noise else nearest) or sampled, levels, rules)
    return replace(fit, is_noise=is_noise and not fit.is_met)


@dataclass(frozen=True, slots=True, eq=False)
class _Rules:
    degree: int
    tolerance: float
    outliers: float
    fairness: tuple[float, ...]
    weights: Floats
    loss: Loss


def check_tolerance(tolerance: float) -> None:
    """Check that a tolerance is positive and finite."""
    if not 0.0 < tolerance < np.inf:
        raise InputError(f"the tolerance is {tolerance:g}; it has to be positive and finite, in the unit of the scan")


def _most_control(n: int, tolerance: float, outliers: float, max_control: int | None, degree: int) -> int:
    """Check the numbers; return the largest number of control points."""
    check_tolerance(tolerance)
    if not 0.0 <= outliers < 1.0:
        raise InputError(f"the share of outliers is {outliers:g}; it has to be at least 0 and below 1")
    if degree not in (2, 3, 4, 5):
        raise InputError(f"the degree is {degree}; it has to be 2, 3, 4 or 5")
    least = (FIRST_SPANS + degree) ** 2
    most = n // 2 if max_control is None else min(max_control, n)
    if most < least:
        said = f"{most} control points" + (", half as many as points," if max_control is None else "")
        raise InputError(
            f"{said} are too few: the coarsest surface of degree {degree} has {least}; allow more, up to the {n} "
            "points, or take a lower degree"
        )
    return most


def _thinned(rows: Indices, n: int) -> Indices:
    return np.sort(rows[:n])


@dataclass(frozen=True, slots=True, eq=False)
class _Sampled:
    """A surface fitted to a sample of the points: as many as its control points need."""

    surface: BSplineSurface
    level: Level
    rows: Indices
    is_out: Mask


def _fit_sample(points: Points, uv: UV, knots: Knots, split: tuple[Indices, Indices], rules: _Rules) -> _Sampled:
    """Fit with given knots, choose the fairness, and judge by the sample and by points held out."""
    enough = max(LEAST_SAMPLE, SHARE * n_control(knots, rules.degree))
    rows, test = (_thinned(part, enough) for part in split)

    def fitted(fairness: float, feet: UV, loss: Floats | float = 1.0) -> BSplineSurface:
        weights = rules.weights[rows] * loss
        return least_squares(points[rows], feet, *knots, degree=rules.degree, weights=weights, fairness=fairness)

    trials = {fairness: fitted(fairness, uv[rows]) for fairness in rules.fairness}
    fairness = min(trials, key=lambda f: Deviation(_distances(trials[f], points[test], uv[test])[1]).rms)
    surface = trials[fairness]
    before = np.inf
    for _ in range(CORRECTIONS):
        feet, distance = _distances(surface, points[rows], uv[rows])
        rms = Deviation(distance).rms
        if not rms < WORTH * before:
            break
        before, surface = rms, fitted(fairness, feet, rules.loss(distance))
    seen = np.concatenate([rows, test])
    distance = _distances(surface, points[seen], uv[seen])[1]
    whole, held = Deviation(distance), Deviation(distance[len(rows) :])
    level = Level(surface.n_control, fairness, whole.largest(rules.outliers), whole.rms, held.rms)
    return _Sampled(surface, level, seen, distance > rules.tolerance)


def _fit_all(points: Points, uv: UV, sampled: _Sampled, levels: list[Level], rules: _Rules) -> tuple[Fit, Mask]:
    """Fit to all points, with the knots and the fairness that were found on a sample; and say which are out.

    The surface of the sample stays, where it meets the tolerance and that of all points does not.
    """
    first = sampled.surface
    feet, distance = _distances(first, points, uv, LAST_STEPS)
    weights = rules.weights * rules.loss(distance)
    fairness, degree = sampled.level.fairness, rules.degree
    surface = least_squares(
        points, feet, first.knots_u, first.knots_v, degree=degree, weights=weights, fairness=fairness
    )
    tries = [(surface, *_distances(surface, points, uv, LAST_STEPS)), (first, feet, distance)]
    met = [bool(Deviation(away).largest(rules.outliers) <= rules.tolerance) for _, _, away in tries]
    surface, feet, distance = tries[1 if met == [False, True] else 0]
    return Fit(surface, feet, list(levels), any(met), False), distance > rules.tolerance


def _distances(surface: BSplineSurface, points: Points, uv: UV, n_steps: int = STEPS) -> tuple[UV, Floats]:
    """Return the feet of points and how far they are."""
    uv = closest_parameters(surface, points, uv, n_steps=n_steps)
    return uv, np.linalg.norm(evaluate(surface, uv) - points, axis=1)
