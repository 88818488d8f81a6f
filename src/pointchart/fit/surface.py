"""What all fitted surfaces share: derivatives at parameters, and what follows from them."""

from typing import Protocol

import numpy as np

from ..typing import UV, Floats, Points


class Surface(Protocol):
    """A smooth map from the parameter plane to space."""

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


def _dot(a: Points, b: Points) -> Floats:
    return np.asarray((a * b).sum(axis=1))
