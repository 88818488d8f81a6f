"""B-spline surfaces with the least squared distance from points at given parameters."""

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike

from .._check import check_points, check_uv, check_weights
from .._kernels.surface import bspline_basis as kernels
from ..errors import InputError
from ..solve.factors import direct
from ..typing import Floats
from .bspline import BSplineSurface
from .knots import check_clamped, check_knots

GAUSS = 6  # nodes a span: exact up to degree 11, and products have twice that of the surface


def least_squares(
    points: ArrayLike,
    uv: ArrayLike,
    knots_u: Floats,
    knots_v: Floats,
    *,
    degree: int = 3,
    weights: ArrayLike | None = None,
    fairness: float = 1e-9,
) -> BSplineSurface:
    r"""Fit a B-spline surface with given knots to points at given parameters.

    .. math:: \sum_k w_k |s(u_k) - x_k|^2
              + \lambda \int |s_{uu}|^2 + 2 |s_{uv}|^2 + |s_{vv}|^2 \, du \, dv \to \min

    The second term, the energy of a thin plate, goes on smoothly where there are no points.

    Parameters
    ----------
    points : (n, 3) array
    uv : (n, 2) array
        Within the domain of the knots.
    knots_u, knots_v : arrays
        Clamped.
    degree : int
    weights : (n,) array, optional
        Of the points, positive; 1, if not given.
    fairness : float
        Share of the second term, dimensionless: lambda is this times the ratio of the traces of the two matrices. With
        0 every basis function needs points of its own (Schoenberg and Whitney).

    Returns
    -------
    BSplineSurface

    Raises
    ------
    InputError
        If the points do not determine the surface.

    References
    ----------
    Hoschek and Lasser 1993, Fundamentals of Computer Aided Geometric Design, section 13.4. Floater 2000.

    Examples
    --------
    >>> uv = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1], [0.5, 0.5]])
    >>> plane = np.column_stack([2 * uv, uv.sum(axis=1)])
    >>> clamped = np.array([0.0, 0, 1, 1])
    >>> least_squares(plane, uv, clamped, clamped, degree=1, fairness=0.0).control[1, 1].round(12)
    array([2., 2., 2.])
    """
    points = check_points(points)
    uv = check_uv(uv, len(points))
    weights = np.ones(len(points)) if weights is None else check_weights(weights, len(points))
    if not 0.0 <= fairness < np.inf:
        raise InputError(f"the fairness is {fairness:g}; it has to be at least 0 and finite")
    for name, knots, places in (("knots_u", knots_u, uv[:, 0]), ("knots_v", knots_v, uv[:, 1])):
        check_knots(name, knots, degree, len(knots) - degree - 1)
        check_clamped(name, knots, degree)
        if places.min() < knots[0] or places.max() > knots[-1]:
            raise InputError(f"parameters from {places.min():g} to {places.max():g} lie beyond {name}; lay wider knots")
    middle = points.mean(axis=0)
    shape = len(knots_u) - degree - 1, len(knots_v) - degree - 1
    n, width = shape[0] * shape[1], 2 * degree + 1
    band, right = np.zeros((n, width, width)), np.zeros((n, 3))
    kernels.gather(knots_u, knots_v, degree, uv, points - middle, weights, band, right)
    normal = _from_band(band, shape)
    if fairness > 0.0:
        energy = thin_plate(knots_u, knots_v, degree)
        normal = normal + fairness * normal.trace() / energy.trace() * energy
    elif n > len(points):
        raise InputError(
            f"{len(points)} points do not determine {n} control points; use fewer knots or a fairness above 0"
        )
    elif (bare := np.flatnonzero(normal.diagonal() <= 0.0)).size:
        raise InputError(
            f"{len(bare)} of {n} control points have no scan points, so their place is undetermined; "
            "use fewer knots or a fairness above 0"
        )
    control, _ = direct(sp.csr_array(normal), right)
    return BSplineSurface(degree, knots_u, knots_v, control.reshape(*shape, 3) + middle)


def thin_plate(knots_u: Floats, knots_v: Floats, degree: int) -> sp.csr_array:
    """Return the matrix of the thin plate energy of a scalar B-spline, (a b, a b): exact Gauss quadrature."""
    u, v = ([_gram(knots, degree, order) for order in range(3)] for knots in (knots_u, knots_v))
    return sp.csr_array(sp.kron(u[2], v[0]) + 2.0 * sp.kron(u[1], v[1]) + sp.kron(u[0], v[2]))


def _gram(knots: Floats, degree: int, order: int) -> sp.csr_array:
    """Return the integrals of products of the derivatives of basis functions, (a, a)."""
    spans = np.unique(knots)
    nodes, weights = np.polynomial.legendre.leggauss(GAUSS)
    half, middle = 0.5 * np.diff(spans), 0.5 * (spans[1:] + spans[:-1])
    places = (middle[:, None] + half[:, None] * nodes).ravel()
    values = _basis_matrix(knots, degree, places, order)
    return sp.csr_array(values.T @ sp.diags_array((half[:, None] * weights).ravel()) @ values)


def _basis_matrix(knots: Floats, degree: int, places: Floats, order: int) -> sp.csr_array:
    values = np.empty((len(places), degree + 1))
    columns = np.empty((len(places), degree + 1), np.int64)
    kernels.basis_rows(knots, degree, places, order, values, columns)
    starts = np.arange(0, values.size + 1, degree + 1)
    return sp.csr_array((values.ravel(), columns.ravel(), starts), shape=(len(places), len(knots) - degree - 1))


def _from_band(band: Floats, shape: tuple[int, int]) -> sp.csr_array:
    """Return the sparse matrix whose row (i, j) has its entries at (i + k - p, j + l - p)."""
    p = band.shape[1] // 2
    i, j = np.divmod(np.arange(len(band)), shape[1])
    offsets = np.arange(-p, p + 1)
    to_i, to_j = i[:, None, None] + offsets[:, None], j[:, None, None] + offsets
    inside = (to_i >= 0) & (to_i < shape[0]) & (to_j >= 0) & (to_j < shape[1])
    columns = (to_i * shape[1] + to_j)[inside]
    starts = np.concatenate([[0], np.cumsum(inside.sum(axis=(1, 2)))])
    return sp.csr_array((band[inside], columns, starts), shape=(len(band), len(band)))
