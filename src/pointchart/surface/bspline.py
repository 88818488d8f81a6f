"""Tensor-product B-spline surfaces."""

from dataclasses import dataclass

import numpy as np

from .._check import check_uv
from .._kernels.surface import bspline_basis as kernels
from .._parallel import over_ranges
from ..errors import InputError
from ..typing import UV, Floats, Points
from .knots import check_knots


@dataclass(frozen=True, slots=True, eq=False)
class BSplineSurface:
    r"""A surface :math:`s(u, v) = \sum_{ij} B_i(u) B_j(v) c_{ij}` with clamped knots.

    Attributes
    ----------
    degree : int
        In both directions.
    knots_u : (a + degree + 1,) float64
    knots_v : (b + degree + 1,) float64
        Ascending; the first and last of them degree + 1 times.
    control : (a, b, 3) float64
        Control points, in the unit of the scan.

    Raises
    ------
    InputError
        On knots and control points that do not belong together.

    References
    ----------
    Piegl and Tiller 1997, The NURBS Book, section 3.4.

    Examples
    --------
    >>> corners = np.array([[[0.0, 0, 0], [0, 2, 0]], [[4, 0, 0], [4, 2, 8]]])
    >>> saddle = BSplineSurface(1, np.array([0.0, 0, 1, 1]), np.array([0.0, 0, 1, 1]), corners)
    >>> saddle.derivatives(np.array([[0.5, 0.5]]))
    array([[2., 1., 2.]])
    """

    degree: int
    knots_u: Floats
    knots_v: Floats
    control: Floats

    def __post_init__(self) -> None:
        control = self.control
        if control.ndim != 3 or control.shape[2] != 3 or not np.isfinite(control).all():
            raise InputError(f"the control points have shape {control.shape}; (a, b, 3) finite numbers are needed")
        for axis, knots, count in zip("uv", (self.knots_u, self.knots_v), control.shape[:2], strict=True):
            check_knots(f"knots_{axis}", knots, self.degree, count)

    @property
    def n_control(self) -> int:
        """Number of control points."""
        return self.control.size // 3

    @property
    def domain(self) -> Floats:
        """The least and the largest parameters: ((u, v), (u, v))."""
        p = self.degree
        return np.array([[self.knots_u[p], self.knots_v[p]], [self.knots_u[-p - 1], self.knots_v[-p - 1]]])

    def derivatives(self, uv: UV, du: int = 0, dv: int = 0) -> Points:
        """Return the derivative of order `du` in u and `dv` in v at each parameter pair, (n, 3); (0, 0): the points.

        Beyond the domain the outermost polynomials go on.
        """
        uv = check_uv(uv, len(uv))
        if min(du, dv) < 0:
            raise InputError(f"the orders of the derivative are {du} and {dv}; they have to be at least 0")
        knots_u, knots_v, control, out = self.knots_u, self.knots_v, self.control, np.empty((len(uv), 3))
        over_ranges(
            lambda first, last: kernels.evaluate(knots_u, knots_v, self.degree, control, uv, du, dv, first, last, out),
            len(uv),
        )
        return out
