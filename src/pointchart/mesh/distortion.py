"""Measures of the map between a mesh and its parameters, one function each."""

import numpy as np

from .._kernels.mesh.triangle_shapes import measure_stretches
from .._parallel import over_ranges
from ..points.morton import morton_order
from ..points.trees import BoxTree
from ..typing import UV, Floats, Points, Triangles
from .quality import areas, plane_areas


def stretches(points: Points, triangles: Triangles, uv: UV) -> tuple[Floats, Floats]:
    """Measure the largest and smallest stretch of the map from the plane to space, triangle by triangle.

    Parameters are scaled so that plane and surface have the same area; 1 means no stretch.

    Returns
    -------
    largest, smallest : (m,) float64 arrays, dimensionless: singular values of the map's derivative.

    References
    ----------
    Sander, Snyder, Gortler and Hoppe 2001, Texture mapping progressive meshes, section 3.

    Examples
    --------
    >>> import numpy as np
    >>> flat = np.array([[0.0, 0, 0], [2, 0, 0], [0, 2, 0]])
    >>> [s.round(12) for s in stretches(flat, np.array([[0, 1, 2]]), flat[:, :2] / 8)]
    [array([1.]), array([1.])]
    """
    scale = np.sqrt(np.abs(plane_areas(uv, triangles)).sum() / areas(points, triangles).sum())
    largest, smallest = np.empty(len(triangles)), np.empty(len(triangles))
    over_ranges(
        lambda first, last: measure_stretches(points, triangles, uv, scale, first, last, largest, smallest),
        len(triangles),
    )
    return largest, smallest


def vertex_stretches(points: Points, triangles: Triangles, uv: UV) -> Floats:
    """Measure the stretch at each point: root of the mean square over its triangles, weighed by area, (n,).

    Triangles that are flat in the plane, of infinite stretch, count as ten times the largest finite one, and points
    without any area around them as 1.

    References
    ----------
    Yoshizawa, Belyaev and Seidel 2004, section 3.

    Examples
    --------
    >>> import numpy as np
    >>> flat = np.array([[0.0, 0, 0], [2, 0, 0], [0, 2, 0]])
    >>> vertex_stretches(flat, np.array([[0, 1, 2]]), flat[:, :2] / 8).round(12)
    array([1., 1., 1.])
    """
    largest, smallest = stretches(points, triangles, uv)
    square = 0.5 * (largest**2 + smallest**2)
    is_finite = np.isfinite(square)
    square[~is_finite] = 100.0 * square[is_finite].max(initial=1.0)
    area = areas(points, triangles)
    corners = triangles.ravel()
    total = np.bincount(corners, np.repeat(area * square, 3), len(points))
    around = np.bincount(corners, np.repeat(area, 3), len(points))
    return np.sqrt(np.divide(total, around, out=np.ones(len(points)), where=total > 0.0))


def l2_stretch(points: Points, triangles: Triangles, uv: UV) -> float:
    """Return the root of the area-weighted mean square stretch; 1 for an isometry, infinite for a flat triangle.

    References
    ----------
    Sander, Snyder, Gortler and Hoppe 2001, section 3.
    """
    largest, smallest = stretches(points, triangles, uv)
    area = areas(points, triangles)
    mean = np.sum(area * 0.5 * (largest**2 + smallest**2)) / area.sum()
    return float(np.sqrt(mean)) if np.isfinite(mean) else float("inf")


def linf_stretch(points: Points, triangles: Triangles, uv: UV) -> float:
    """Return the largest stretch of all triangles; 1 for an isometry, infinite for a flat triangle.

    References
    ----------
    Sander, Snyder, Gortler and Hoppe 2001, section 3.

    Examples
    --------
    >>> import numpy as np
    >>> flat = np.array([[0.0, 0, 0], [4, 0, 0], [0, 1, 0]])
    >>> linf_stretch(flat, np.array([[0, 1, 2]]), np.array([[0.0, 0], [2, 0], [0, 2]]))
    2.0
    """
    largest, _ = stretches(points, triangles, uv)
    return float(largest.max()) if np.isfinite(largest).all() else float("inf")


def conformal_distortions(points: Points, triangles: Triangles, uv: UV) -> Floats:
    r"""Measure by how much angles change, triangle by triangle: 1 where they are kept, infinite in a flat triangle.

    .. math:: \sigma_1 / \sigma_2

    Returns
    -------
    (m,) float64 array, dimensionless.

    References
    ----------
    Hormann and Greiner 2000, MIPS: an efficient global parametrization method, section 3.

    Examples
    --------
    >>> import numpy as np
    >>> flat = np.array([[0.0, 0, 0], [4, 0, 0], [0, 1, 0]])
    >>> conformal_distortions(flat, np.array([[0, 1, 2]]), np.array([[0.0, 0], [2, 0], [0, 2]]))
    array([4.])
    """
    largest, _ = stretches(points, triangles, uv)
    # The product of both is a ratio of areas, which keeps the digits that the smaller one alone has lost.
    product = _area_ratios(points, triangles, uv)
    is_whole = np.isfinite(largest) & (product > 0.0)
    return np.asarray(np.divide(largest**2, product, out=np.full(len(triangles), np.inf), where=is_whole))


def area_distortions(points: Points, triangles: Triangles, uv: UV) -> Floats:
    r"""Measure by how many times each triangle is too large or too small: 1 where areas are kept.

    .. math:: \max(\sigma_1 \sigma_2, 1 / (\sigma_1 \sigma_2))

    Parameters are scaled as for `stretches`, so that plane and surface have the same area.

    Returns
    -------
    (m,) float64 array, dimensionless; infinite in a triangle that is flat in the plane or in space.

    References
    ----------
    Hormann, Levy and Sheffer 2007, Mesh parameterization: theory and practice, section 3.

    Examples
    --------
    >>> import numpy as np
    >>> strip = np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [-3, 0, 0]])
    >>> uv = np.array([[0.0, 0], [2, 0], [0, 2], [-2, 0]])
    >>> area_distortions(strip, np.array([[0, 1, 2], [0, 2, 3]]), uv)
    array([2. , 1.5])
    """
    ratio = _area_ratios(points, triangles, uv)
    inverse = np.divide(1.0, ratio, out=np.full(len(ratio), np.inf), where=ratio > 0.0)
    return np.asarray(np.maximum(ratio, inverse))


def _area_ratios(points: Points, triangles: Triangles, uv: UV) -> Floats:
    """Divide the area of each triangle by that of its image, after scaling as for `stretches`; infinite if flat."""
    area, image = areas(points, triangles), np.abs(plane_areas(uv, triangles))
    share, image_share = area / area.sum(), image / image.sum()
    return np.asarray(np.divide(share, image_share, out=np.full(len(triangles), np.inf), where=image_share > 0.0))


def least_distance(uv: UV) -> float:
    """Return the least distance between two parameter points.

    References
    ----------
    Floater and Reimers 2001, section 5.

    Examples
    --------
    >>> import numpy as np
    >>> least_distance(np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 1.0]]))
    1.0
    """
    places = np.column_stack([uv, np.zeros(len(uv))])[morton_order(uv)]
    return float(np.linalg.norm(places[BoxTree(places).nearest(1)[:, 0]] - places, axis=1).min())
