"""Edge swaps that lower the curvature of a mesh: data-dependent triangulations, whose edges lie along the creases.

Each function lowers one measure of the whole mesh, swap by swap, until no single swap lowers it further: a local
minimum, which depends on the mesh at the start: let that be the Delaunay mesh. A thousandth of the
cotangents of all angles is part of each measure, times the mean distance to the nearest point where the measure is a
length. In a plane, which has no curvature, Delaunay's mesh has the least of them, so flat parts stay Delaunay; the
boundary never changes. Points that scatter about the surface have more curvature than it has, and nothing is gained by
lowering that: these swaps are for precise points on surfaces with creases.
"""

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points, check_triangles
from .._kernels.mesh.curvature_swaps import GAUSSIAN, MEAN, NORMALS, PRINCIPAL, curvature_swaps, sum_curvature
from ..errors import InputError
from ..points.neighbors import spacing
from ..typing import Triangles
from .connectivity import half_edges
from .swap_rule import Swapped


def swap_to_least_turn(points: ArrayLike, triangles: Triangles) -> Swapped:
    r"""Swap edges while that lowers the sum of the angles between the normals of neighbouring triangles.

    .. math:: \frac12 \sum_{e} \beta_e

    Short edges count as much as long ones. A triangle without area counts as folded back, here and in the others.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
        A manifold mesh.

    Returns
    -------
    Swapped
        Always settled: the sum falls with each swap.

    References
    ----------
    Dyn, Levin and Rippa 1990, Data dependent triangulations for piecewise linear interpolation (angle between normals).

    Examples
    --------
    An edge that crosses the ridge of a roof gives way to the ridge.

    >>> roof = [[x, y, -abs(y)] for y in (-1, 0, 1) for x in (0, 1, 2)]
    >>> crossed = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [3, 4, 7], [3, 7, 6], [4, 8, 7], [4, 1, 8], [1, 5, 8]]
    >>> [4, 5, 8] in swap_to_least_turn(roof, crossed).triangles.tolist()
    True
    """
    return _descend(points, triangles, NORMALS)


def swap_to_least_mean_curvature(points: ArrayLike, triangles: Triangles) -> Swapped:
    r"""Swap edges while that lowers the total absolute mean curvature, by edge lengths and angles between normals.

    .. math:: \frac12 \sum_{e} \|e\| \, \beta_e

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
        A manifold mesh.

    Returns
    -------
    Swapped
        Always settled: the sum falls with each swap.

    References
    ----------
    Dyn, Hormann, Kim and Levin 2001, Optimizing 3D triangulations using discrete curvature analysis.

    Examples
    --------
    >>> roof = [[x, y, -abs(y)] for y in (-1, 0, 1) for x in (0, 1, 2)]
    >>> crossed = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [3, 4, 7], [3, 7, 6], [4, 8, 7], [4, 1, 8], [1, 5, 8]]
    >>> [4, 5, 8] in swap_to_least_mean_curvature(roof, crossed).triangles.tolist()
    True
    """
    return _descend(points, triangles, MEAN)


def swap_to_least_gaussian_curvature(points: ArrayLike, triangles: Triangles) -> Swapped:
    r"""Swap edges while that lowers the total absolute Gaussian curvature: the angle defects of the inner points.

    .. math:: \sum_{p} |\bar K_p|, \qquad \bar K_p = 2 \pi - \sum_i \alpha_i

    It is blind to folds, as folded paper has no Gaussian curvature, and wrinkles the mesh of noisy points. Boundary
    points are left out: their angles tell of the shape of the boundary.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
        A manifold mesh.

    Returns
    -------
    Swapped
        Always settled: the sum falls with each swap.

    References
    ----------
    Dyn, Hormann, Kim and Levin 2001, Optimizing 3D triangulations using discrete curvature analysis.

    Examples
    --------
    >>> roof = [[x, y, -abs(y)] for y in (-1, 0, 1) for x in (0, 1, 2)]
    >>> crossed = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [3, 4, 7], [3, 7, 6], [4, 8, 7], [4, 1, 8], [1, 5, 8]]
    >>> [4, 5, 8] in swap_to_least_gaussian_curvature(roof, crossed).triangles.tolist()
    True
    """
    return _descend(points, triangles, GAUSSIAN)


def swap_to_least_curvature(points: ArrayLike, triangles: Triangles) -> Swapped:
    r"""Swap edges while that lowers the total of the absolute principal curvatures, ``|k1| + |k2|``.

    With the angle defect :math:`\bar K` of a point (0 on the boundary), a third of the area of its triangles S and
    :math:`\bar H = \frac14 \sum \|e\| \, \beta_e` over its edges, the sum of

    .. math:: S (|k_1| + |k_2|) = 2 \bar H \text{ if } \bar K \ge 0, \quad 2 \sqrt{\bar H^2 - \bar K S} \text{ else}

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
        A manifold mesh.

    Returns
    -------
    Swapped
        Always settled: the sum falls with each swap.

    References
    ----------
    Dyn, Hormann, Kim and Levin 2001, Optimizing 3D triangulations using discrete curvature analysis.

    Examples
    --------
    >>> roof = [[x, y, -abs(y)] for y in (-1, 0, 1) for x in (0, 1, 2)]
    >>> crossed = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [3, 4, 7], [3, 7, 6], [4, 8, 7], [4, 1, 8], [1, 5, 8]]
    >>> [4, 5, 8] in swap_to_least_curvature(roof, crossed).triangles.tolist()
    True
    """
    return _descend(points, triangles, PRINCIPAL)


def _descend(points: ArrayLike, triangles: Triangles, cost: int) -> Swapped:
    cloud = check_points(points)
    edges = half_edges(check_triangles(triangles, len(cloud)), len(cloud))
    if edges.n_overfull:
        raise InputError(f"{edges.n_overfull} half-edges share their direction, so the mesh is no manifold; mend it")
    is_rim = np.zeros(len(cloud), np.bool_)
    is_rim[edges.origins[edges.twins < 0]] = True
    unit = float(spacing(cloud, k=1).mean()) if cost in (MEAN, PRINCIPAL) else 1.0
    sums, touched = np.empty((len(cloud), 3)), np.empty(len(cloud), np.int64)
    sum_curvature(cloud, edges.origins, edges.twins, cost, sums)
    n_swaps = curvature_swaps(cloud, edges.origins, edges.twins, cost, unit, is_rim, sums, touched)
    return Swapped(edges.origins.reshape(-1, 3), int(n_swaps), True)
