"""One level of a fit to a tolerance: given knots, a sample of the points, and the judgement of those held out."""

from dataclasses import dataclass

import numpy as np

from ..typing import UV, Floats, Indices, Mask, Points
from .bspline import BSplineSurface
from .derivatives import closest_parameters, evaluate
from .deviation import Deviation
from .knots import Knots, n_control
from .loss import Loss
from .normal_equations import least_squares

CORRECTIONS = 8  # of the parameters, at most, before deviations are judged
WORTH = 0.95  # of the RMS: a correction that brings less is the last
STEPS, LAST_STEPS = 2, 20  # of Newton's method in each correction, and at the end
SHARE = 16  # points a control point that are enough for a level but the last
LEAST_SAMPLE = 20_000  # points of a level, so that coarse ones, of few control points, still see all of the surface


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


@dataclass(frozen=True, slots=True, eq=False)
class FitRules:
    """What is asked of a fit, the same at every level.

    Attributes
    ----------
    degree : int
    tolerance : float
    outliers : float
        Share of the points that may deviate by more.
    fairness : tuple of float
        That are tried.
    weights : (n,) float64
        Of the points.
    loss : callable
        See `fit_bspline`.
    """

    degree: int
    tolerance: float
    outliers: float
    fairness: tuple[float, ...]
    weights: Floats
    loss: Loss


def _thinned(rows: Indices, n: int) -> Indices:
    return np.sort(rows[:n])


@dataclass(frozen=True, slots=True, eq=False)
class Sampled:
    """A surface fitted to a sample of the points: as many as its control points need."""

    surface: BSplineSurface
    level: Level
    rows: Indices
    is_out: Mask


def fit_sample(points: Points, uv: UV, knots: Knots, split: tuple[Indices, Indices], rules: FitRules) -> Sampled:
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
    return Sampled(surface, level, seen, distance > rules.tolerance)


def fit_all(points: Points, uv: UV, sampled: Sampled, levels: list[Level], rules: FitRules) -> tuple[Fit, Mask]:
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
