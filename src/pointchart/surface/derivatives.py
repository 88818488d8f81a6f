"""What all fitted surfaces share: derivatives at parameters, and what follows from them."""

from typing import Protocol

import numpy as np

from .._check import check_uv
from ..typing import UV, Floats, Points

HALVINGS = 0.5 ** np.arange(6)  # of a step that leads no nearer
SETTLED = 1e-12  # of the domain: a smaller step ends the search
ROUNDING = 1e-14  # of the metric, added so that a singular place has a step
CONVEX = 0.1  # of the metric: a Hessian below it is left for Gauss's


class Surface(Protocol):
    """A smooth map from the parameter plane to space."""

    @property
    def domain(self) -> Floats:
        """The least and the largest parameters: ((u, v), (u, v))."""
        ...

    def derivatives(self, uv: UV, du: int = 0, dv: int = 0) -> Points:
        """Return the derivative of order `du` in u and `dv` in v at each parameter pair, (n, 3); (0, 0): the points."""
        ...


def evaluate(surface: Surface, uv: UV) -> Points:
    """Return the points of a surface at parameters, (n, 3), in the unit of the surface."""
    return surface.derivatives(np.asarray(uv, np.float64), 0, 0)


def normals(surface: Surface, uv: UV) -> Points:
    """Return unit normals, s_u x s_v over its length, (n, 3); nan where the surface is singular."""
    across = np.cross(surface.derivatives(uv, 1, 0), surface.derivatives(uv, 0, 1))
    length = np.linalg.norm(across, axis=1, keepdims=True)
    return np.asarray(np.divide(across, length, out=np.full_like(across, np.nan), where=length > 0.0))


def curvatures(surface: Surface, uv: UV) -> tuple[Floats, Floats]:
    r"""Return Gaussian and mean curvature, (n,) and (n,), in one over the square of the unit and one over the unit.

    With the first and second fundamental forms E, F, G and L, M, N,

    .. math:: K = \frac{LN - M^2}{EG - F^2}, \qquad H = \frac{EN - 2FM + GL}{2 (EG - F^2)}

    H is positive where the surface bends towards its normal.

    References
    ----------
    do Carmo 1976, Differential Geometry of Curves and Surfaces, section 3.3.
    """
    in_u, in_v = surface.derivatives(uv, 1, 0), surface.derivatives(uv, 0, 1)
    normal = normals(surface, uv)
    first = _dot(in_u, in_u), _dot(in_u, in_v), _dot(in_v, in_v)
    second = [_dot(surface.derivatives(uv, du, 2 - du), normal) for du in (2, 1, 0)]
    area = first[0] * first[2] - first[1] ** 2
    mixed = first[0] * second[2] - 2.0 * first[1] * second[1] + first[2] * second[0]
    return (second[0] * second[2] - second[1] ** 2) / area, mixed / (2.0 * area)


def closest_parameters(surface: Surface, points: Points, uv: UV, *, n_steps: int = 20) -> UV:
    r"""Find the parameters of the points of a surface that are nearest to given points, from parameters near by.

    Newton's method on :math:`|s(u, v) - x|^2`, Gauss's where the Hessian is not positive. Each step is halved until it
    leads nearer, and ends at the border of the domain, so the distance never grows.

    Parameters
    ----------
    surface : Surface
    points : (n, 3) array
    uv : (n, 2) array
        Where to start; the nearest point of the neighbourhood is found, not of the whole surface.
    n_steps : int
        At most.

    Returns
    -------
    (n, 2) array

    References
    ----------
    Hoschek and Lasser 1993, section 4.4 (parameter correction). Piegl and Tiller 1997, section 6.1.
    """
    points = np.asarray(points, np.float64)
    uv = np.clip(check_uv(uv, len(points)), *surface.domain)
    square = _square(evaluate(surface, uv) - points)
    moving = np.arange(len(points))
    for _ in range(n_steps):
        if len(moving) == 0:
            break
        at = uv[moving]
        step = _newton_step(surface, points[moving], at)
        left = np.arange(len(moving))  # without a gain so far
        for size in HALVINGS:
            there = np.clip(at[left] + size * step[left], *surface.domain)
            rows = moving[left]
            nearer = _square(evaluate(surface, there) - points[rows])
            gains = nearer < square[rows]
            uv[rows[gains]], square[rows[gains]] = there[gains], nearer[gains]
            left = left[~gains]
            if len(left) == 0:
                break
        moving = moving[np.abs(uv[moving] - at).max(axis=1) > SETTLED * np.ptp(surface.domain, axis=0).max()]
    return uv


def _newton_step(surface: Surface, points: Points, uv: UV) -> UV:
    """Return the step to the nearest point; along one axis only where the border holds the other."""
    off = evaluate(surface, uv) - points
    in_u, in_v = surface.derivatives(uv, 1, 0), surface.derivatives(uv, 0, 1)
    slope = np.stack([_dot(in_u, off), _dot(in_v, off)], axis=1)
    e, f, g = _dot(in_u, in_u), _dot(in_u, in_v), _dot(in_v, in_v)
    a, b, c = (_dot(surface.derivatives(uv, du, 2 - du), off) for du in (2, 1, 0))
    is_convex = ((e + a) * (g + c) - (f + b) ** 2 > CONVEX * (e * g - f * f)) & (e + a > CONVEX * e)
    e, f, g = (np.where(is_convex, first + second, first) for first, second in ((e, a), (f, b), (g, c)))
    low, high = surface.domain
    held = ((uv <= low) & (slope > 0.0)) | ((uv >= high) & (slope < 0.0))
    slope[held] = 0.0
    f = np.where(held.any(axis=1), 0.0, f)
    least = ROUNDING * (e + g)
    e, g = e + least, g + least
    step = np.stack([f * slope[:, 1] - g * slope[:, 0], f * slope[:, 0] - e * slope[:, 1]], axis=1)
    area = (e * g - f * f)[:, None]
    return np.asarray(np.divide(step, area, out=np.zeros_like(step), where=area > 0.0))


def _square(vectors: Points) -> Floats:
    return _dot(vectors, vectors)


def _dot(a: Points, b: Points) -> Floats:
    return np.asarray((a * b).sum(axis=1))
