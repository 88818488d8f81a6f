"""Radial surfaces: smooth splines through the points of discs, blended into one surface."""

from dataclasses import dataclass
from math import ceil, pi

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from .._check import check_points, check_uv
from .._kernels.surface import radial_blend as kernels
from .._parallel import over_ranges
from ..errors import InputError
from ..mesh.planar_delaunay import coinciding
from ..points.morton import morton_order
from ..points.trees import search
from ..proof.intersections import box_tree
from ..typing import UV, Floats, Points
from .radial_splines import quadratics, solve_splines

NEARBY = 48  # points of a spline: eight times the six that a quadratic needs; a choice, as 30 to 100 work well
OVERLAP = 1.5  # radius of a disc over half the diagonal of its cell
LARGEST_SMOOTHING = 10.0  # spacings: discs have 3 times their square for points then, 300, and systems that are full
FLATTEST = 1e-13  # least over largest eigenvalue of the quadratics' normal matrix
ORDERS = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))  # in the order of a jet of the kernels


@dataclass(frozen=True, slots=True, eq=False)
class RadialSurface:
    r"""A surface with continuous second derivatives, blended of splines on overlapping discs of the parameters.

    .. math:: s(x) = \frac{\sum_d w_d(x) \, s_d(x)}{\sum_d w_d(x)}, \qquad
        s_d(x) = \sum_i c_{di} \| x - x_{di} \|^5 + q_d(x)

    Attributes
    ----------
    domain : (2, 2) float64
        The least and the largest parameters: ((u, v), (u, v)).
    discs : (d, 4) float64
        Middle, radius, and the unit of length of its spline, about the spacing of its points.
    boxes : (b, 6) float64
        The tree of boxes around the discs.
    centres : (d, k, 2) float64
        Parameters that each spline is centred on, in its unit and seen from the middle.
    coefficients : (d, k + 6, 3) float64
        Of the fifth powers of the distances, and of the quadratic: of 1, u, v, u^2, u v and v^2.

    References
    ----------
    Wendland 2005, Scattered data approximation, section 15.4.
    """

    domain: Floats
    discs: Floats
    boxes: Floats
    centers: Floats
    coefficients: Floats

    def derivatives(self, uv: UV, du: int = 0, dv: int = 0) -> Points:
        """Return the derivative of order `du` in u and `dv` in v, 2 in all at most, (n, 3); (0, 0): the points.

        Outside the domain it is nan. Within it, but far from all points, as in a bay or a hole of theirs, the surface
        goes on smoothly.
        """
        if (du, dv) not in ORDERS:
            raise InputError(
                f"the derivative of order {du} in u and {dv} in v is not continuous; orders 0, 1 and 2 in all are"
            )
        places = np.ascontiguousarray(uv, dtype=np.float64)
        out, k = np.empty((len(places), 3)), ORDERS.index((du, dv))
        surface = (self.domain, self.discs, self.boxes, self.centers, self.coefficients)
        over_ranges(lambda first, last: kernels.evaluate(*surface, places, k, first, last, out), len(places))
        return out


def fit_radial(points: ArrayLike, uv: ArrayLike, *, smoothing: float = 0.0, nearby: int | None = None) -> RadialSurface:
    r"""Fit a surface with continuous curvature to points, without a mesh.

    The rectangle of the parameters is halved until a disc around each cell has at most `nearby` points. The nearest
    points to its middle have a spline of their own, so time and memory grow with the points. Quadratic maps are
    reproduced; errors fall about with the third power of the spacing, those of second derivatives with the first.
    Thin-plate splines, of :math:`r^2 \log r` and a linear part, would do neither: their second derivatives are infinite
    at the points, and vanish towards the rim of a disc.

    With `smoothing`, the spline of a disc minimizes the squared misses plus a multiple of its bending. On an even
    lattice waves of length :math:`\ell` in spacings are then reduced to about :math:`1 / (1 + (\sigma / \ell)^7)`, and
    independent noise in the points to about :math:`1.6 / \sigma` of its size; more of both is left at the rim.

    Parameters
    ----------
    points : (n, 3) array
    uv : (n, 2) array
        Distinct parameters; as near to an isometry as can be, because distances in the plane weigh the points.
    smoothing : float
        Length of the waves to be halved, in local spacings, at most 10: 4 to 8 for noise; 0 passes through the points.
    nearby : int, optional
        Points of each spline; 48, or more with a smoothing that reaches farther.

    Returns
    -------
    RadialSurface

    Raises
    ------
    InputError
        If parameters coincide, those of a disc lie on a conic, or the options are out of range.
    SolveError
        If the surface misses points, because parameters nearly coincide or their density varies too much in a disc.

    References
    ----------
    Wendland 2002, Fast evaluation of radial basis functions: methods based on partition of unity.

    Examples
    --------
    >>> u, v = np.mgrid[0:9, 0:9].reshape(2, -1) / 8
    >>> plane = fit_radial(np.c_[u, v, 2 * u + v], np.c_[u, v])
    >>> plane.derivatives(np.array([[0.3, 0.6], [0.3, 1.6]])).round(12)
    array([[0.3, 0.6, 1.2],
           [nan, nan, nan]])
    """
    cloud = check_points(points, least=6)
    plane = check_uv(uv, len(cloud))
    doubled = coinciding(plane)
    if len(doubled):
        raise InputError(
            "points {doubled} share their parameters with others, so no surface passes through all; separate them or "
            "remove one of each",
            doubled=doubled,
        )
    if not 0.0 <= smoothing <= LARGEST_SMOOTHING:
        raise InputError(
            f"the smoothing is {smoothing:g} spacings; it has to be 0 to {LARGEST_SMOOTHING:g}: fit a B-spline surface "
            "with few control points to smooth more"
        )
    wanted = max(NEARBY, ceil(3.0 * smoothing**2)) if nearby is None else nearby
    if wanted < 6:
        raise InputError(f"{wanted} nearby points determine no quadratic; give at least 6, and 30 to 100 work well")
    k, tree = min(len(plane), wanted), cKDTree(plane)
    discs = _cover(tree, plane, k)
    members = search(tree, discs[:, :2], k)[1]
    spacing = _spacings(plane[members], discs)
    discs = np.column_stack([discs, spacing])
    centers = (plane[members] - discs[:, None, :2]) / spacing[:, None, None]
    coefficients = solve_splines(cloud, members, centers, smoothing)
    return RadialSurface(np.array([plane.min(axis=0), plane.max(axis=0)]), discs, _boxes(discs), centers, coefficients)


def _cover(tree: cKDTree, uv: UV, k: int) -> Floats:
    """Cover the rectangle of the parameters by discs of `k` points at most: middle and radius, (d, 3).

    Each is the disc around a cell and its surroundings; cells are halved until it is small enough.
    """
    low, high = uv.min(axis=0), uv.max(axis=0)
    middle, half = (low + high)[None] / 2.0, (high - low)[None] / 2.0
    kept = []
    while len(middle):
        radius = OVERLAP * np.linalg.norm(half, axis=1)
        reach = search(tree, middle, k)[0][:, -1] if k < len(uv) else np.full(len(middle), np.inf)
        # Then the k nearest of its middle are all points of the disc, and a spline through them knows it whole.
        is_small = radius <= reach
        kept.append(np.column_stack([middle, radius])[is_small])
        middle, half = _halve(middle[~is_small], half[~is_small])
    discs = np.concatenate(kept)
    return discs[morton_order(discs[:, :2])]


def _halve(middle: Floats, half: Floats) -> tuple[Floats, Floats]:
    """Halve rectangles across their longer side."""
    step = 0.5 * half * (half >= half[:, ::-1])
    step[step.all(axis=1), 1] = 0.0
    return np.concatenate([middle - step, middle + step]), np.tile(half - step, (2, 1))


def _spacings(near: Floats, discs: Floats) -> Floats:
    """Return the spacing of the parameters of each disc: of a lattice as dense, from the area that they spread over.

    The area of an ellipse is 4 pi times the root of the determinant of its covariance, that of a rectangle or half a
    disc by a twentieth less.
    """
    offset = near - near.mean(axis=1, keepdims=True)
    covariance = offset.swapaxes(1, 2) @ offset / near.shape[1]
    terms = quadratics(offset / np.sqrt(np.trace(covariance, axis1=1, axis2=2))[:, None, None])
    values = np.linalg.eigvalsh(terms.swapaxes(1, 2) @ terms)
    flat = np.flatnonzero(values[:, 0] <= FLATTEST * values[:, -1])
    if len(flat):
        u, v, _ = discs[flat[0]]
        raise InputError(
            f"the {near.shape[1]} parameters nearest to ({u:.6g}, {v:.6g}) lie on one or two lines or another conic, "
            f"as do those of {len(flat) - 1} more of {len(discs)} discs, so the surface beside it is undetermined; "
            "raise nearby"
        )
    return np.asarray(np.sqrt(4.0 * pi * np.sqrt(np.linalg.det(covariance)) / near.shape[1]))


def _boxes(discs: Floats) -> Floats:
    """Return the tree of boxes around discs, in the plane z = 0."""
    middle, reach = (np.pad(array, ((0, 0), (0, 1))) for array in (discs[:, :2], np.tile(discs[:, 2:3], 2)))
    return box_tree(middle - reach, middle, middle + reach)
