"""Knots of tensor-product B-splines: laid over parameters, halved where points are out of tolerance."""

from typing import TypeAlias

import numpy as np

from ..errors import InputError, name_some
from ..typing import UV, Floats, Indices, Mask

MARGIN = 0.02  # of the shorter extent of uv, by which the domain is larger, so that feet find room outside
FIRST_SPANS = 4  # in the shorter direction: 49 control points for degree 3
MOST_ASPECT = 64.0  # of the spans, for parameters in a narrow strip
FLAT = 1e-24  # of the larger variance of uv: less is rounding
SHARES = (0.8, 0.4, 0.2, 0.1)  # of the points out of tolerance, whose spans are halved: less where there is no room

Knots: TypeAlias = tuple[Floats, Floats]


def check_knots(name: str, knots: Floats, degree: int, count: int) -> None:
    """Check that knots make `count` functions of a degree.

    Raises
    ------
    InputError
        On numbers that are not finite, a wrong number of them, or knots that descend.
    """
    if degree < 1:
        raise InputError(f"the degree is {degree}; a surface needs at least 1")
    if knots.shape != (count + degree + 1,) or count <= degree or not np.isfinite(knots).all():
        raise InputError(
            f"{name} has shape {knots.shape}; {count} control points of degree {degree} need "
            f"{max(count, degree + 1) + degree + 1} finite knots"
        )
    wrong = np.flatnonzero(np.diff(knots) < 0.0)
    if len(wrong):
        raise InputError(f"{name} descends after {name_some(wrong)}; sort the knots")


def check_clamped(name: str, knots: Floats, degree: int) -> None:
    """Check that a surface begins and ends with its outermost control points, and is continuous between.

    Raises
    ------
    InputError
        On knots that repeat too often or not often enough.
    """
    counts = np.unique(knots, return_counts=True)[1]
    if counts[0] != degree + 1 or counts[-1] != degree + 1 or (counts[1:-1] > degree).any():
        raise InputError(
            f"{name} repeats its knots {name_some(counts)} times; degree {degree} needs {degree + 1} at both ends and "
            f"at most {degree} between"
        )


def first_knots(uv: UV, degree: int, margin: float, most: int) -> Knots:
    """Lay knots with nearly square spans, if control points allow, half by length and half by number of points."""
    low, extent = uv.min(axis=0), np.ptp(uv, axis=0)
    spread = np.linalg.eigvalsh(np.cov(uv.T))
    if not spread[0] > FLAT * spread[1]:
        raise InputError("the parameters lie on one line, so they hold no surface; give one-to-one parameters")
    n_spans = np.rint(FIRST_SPANS * np.minimum(extent / extent.min(), MOST_ASPECT)).astype(int)
    # Of most control points, those across take up FIRST_SPANS + degree each.
    n_spans = np.minimum(n_spans, most // (FIRST_SPANS + degree) - degree)
    room = margin * extent.min()
    in_u, in_v = (
        _clamped(places, low[k] - room, low[k] + extent[k] + room, n_spans[k], degree) for k, places in enumerate(uv.T)
    )
    return in_u, in_v


def _clamped(places: Floats, first: float, last: float, n_spans: int, degree: int) -> Floats:
    shares = np.linspace(0.0, 1.0, n_spans + 1)[1:-1]
    inner = 0.5 * (first + shares * (last - first)) + 0.5 * np.quantile(places, shares)
    return np.concatenate([[first] * (degree + 1), inner, [last] * (degree + 1)])


def n_control(knots: Knots, degree: int) -> int:
    """Return the number of control points of a surface with these knots."""
    return (len(knots[0]) - degree - 1) * (len(knots[1]) - degree - 1)


def halve(knots: Knots, uv: UV, is_out: Mask, outliers: float, degree: int, most: int) -> Knots | None:
    """Halve the spans in which too many points are out of tolerance; the worst of them, if there is no room for all."""
    spans, out, splits = [], [], []
    for knots_of, places in zip(knots, uv.T, strict=True):
        ends = knots_of[degree:-degree]
        span = np.clip(np.searchsorted(ends, places, side="right") - 1, 0, len(ends) - 2)
        inside, outside = np.bincount(span, minlength=len(ends) - 1), np.bincount(span, is_out, len(ends) - 1)
        spans.append(ends)
        out.append(np.where(outside > outliers * inside, outside, 0.0))
    for share in SHARES:
        splits = [_worst(o, share) for o in out]
        in_u, in_v = (
            np.sort(np.concatenate([k, 0.5 * (e[s] + e[s + 1])])) for k, e, s in zip(knots, spans, splits, strict=True)
        )
        finer = in_u, in_v
        if n_control(finer, degree) <= most:
            return finer if any(map(len, splits)) else None
    return None


def _worst(out: Floats, share: float) -> Indices:
    """Return the spans that hold a share of all points out of tolerance, the worst first."""
    order = np.argsort(-out, kind="stable")[: np.count_nonzero(out)]
    before = np.cumsum(out[order]) - out[order]
    return np.asarray(order[before < share * out.sum()])
