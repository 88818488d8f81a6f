"""Curves in space over curves in the parameter plane."""

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from ..surface import BSplineSurface, evaluate
from ..typing import Floats, Points

_CHECKS = np.array([0.2, 0.5, 0.8])  # of a span: where it is halved, and beside, as the error may vanish in the middle
_ROUNDS = 16  # of halving: to a span in 65,000, where a kink is no more to be seen


def lift(surface: BSplineSurface, curve: BSpline, tolerance: float) -> tuple[BSpline, float]:
    """Return the cubic spline x(t) that follows s(c(t)), and how far it is from it at most.

    It interpolates with the slopes of s(c(t)) at both ends, over the knots of c, halved where it is still too far away
    at a check. At a kink that a surface of degree 1 has halving stops after some rounds.

    Parameters
    ----------
    surface
    curve
        c, in the domain.
    tolerance
        The distance to reach, in the unit of the surface.

    Returns
    -------
    spline
        Over the same parameters as the curve; with three components.
    error
        The largest distance that was measured, in the unit of the surface.

    Examples
    --------
    >>> knots, corners = np.array([0.0, 0, 1, 1]), np.array([[[0.0, 0, 0], [0, 2, 0]], [[4, 0, 0], [4, 2, 8]]])
    >>> diagonal = BSpline(knots, np.array([[0.0, 0.0], [1.0, 1.0]]), 1)
    >>> spline, error = lift(BSplineSurface(1, knots, knots, corners), diagonal, 1e-9)
    >>> spline(0.5).round(9).tolist(), error < 1e-9
    ([2.0, 1.0, 2.0], True)
    """
    at = np.unique(curve.t)
    slopes = [[(1, slope)] for slope in _slopes(surface, curve, at[[0, -1]])]
    for _ in range(_ROUNDS):
        spline = make_interp_spline(at, evaluate(surface, curve(at)), 3, bc_type=tuple(slopes))
        checks = at[:-1, None] + np.diff(at)[:, None] * _CHECKS
        gaps = spline(checks.ravel()) - evaluate(surface, curve(checks.ravel()))
        errors = np.linalg.norm(gaps, axis=1).reshape(checks.shape).max(axis=1)
        if errors.max() <= tolerance:
            break
        at = np.sort(np.concatenate([at, checks[errors > tolerance, 1]]))
    return spline, float(errors.max())


def _slopes(surface: BSplineSurface, curve: BSpline, at: Floats) -> Points:
    uv, slope = curve(at), curve(at, 1)
    along_u, along_v = surface.derivatives(uv, 1, 0), surface.derivatives(uv, 0, 1)
    return np.asarray(along_u * slope[:, :1] + along_v * slope[:, 1:])
