"""Convex weights: from neighbourhoods to the numbers of system (2.1).

Every scheme has the one signature ``scheme(points, neighborhoods) -> (nnz,)``; so does whatever a user passes in its
place.
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from .._check import check_kind
from .._kernels.map.mean_value_weights import mean_value as mean_value_kernel
from .._kernels.map.shape_preserving_weights import shape_preserving as shape_preserving_kernel
from .._parallel import over_ranges
from ..agreement.links import Links
from ..points.neighborhoods import Neighborhoods, PlanarStars, Rings
from ..typing import Floats, Points, Weights

LEAST_TANGENT = 1e-14  # weights stay positive between neighbours in one direction

WeightScheme: TypeAlias = Callable[[Points, Neighborhoods], Weights]


def normalize(weights: Weights, neighborhoods: Neighborhoods) -> Weights:
    """Divide positive weights by their sum over each neighbourhood."""
    rows = neighborhoods.rows
    return np.asarray(weights / np.bincount(rows, weights, neighborhoods.n_points)[rows])


def fixed(weights: Weights) -> WeightScheme:
    """Make a scheme of weights that are known already."""
    return lambda points, neighborhoods: weights


def uniform(points: Points, neighborhoods: Neighborhoods) -> Weights:
    r"""Weigh all neighbours alike: :math:`\lambda_{ij} = 1 / |N_i|`.

    Two points with equal neighbourhoods fall together (Proposition 4.1): prefer another scheme, except for tests.

    Parameters
    ----------
    points : (n, 3) array
    neighborhoods : Neighborhoods

    Returns
    -------
    (nnz,) float64 array, dimensionless.

    References
    ----------
    Floater and Reimers 2001, section 4, method 1.

    Examples
    --------
    >>> import numpy as np
    >>> pair = Neighborhoods(np.array([0, 2, 2, 2]), np.array([1, 2]))
    >>> uniform(np.array([[0.0, 0, 0], [1, 0, 0], [-3, 0, 0]]), pair)
    array([0.5, 0.5])
    """
    return normalize(np.ones(len(neighborhoods.indices)), neighborhoods)


def reciprocal_distance(points: Points, neighborhoods: Neighborhoods) -> Weights:
    r"""Weigh neighbours by :math:`1 / \|x_j - x_i\|`: chord length parameterization, generalized.

    Needs no order among the neighbours, so it suits balls and nearest points.

    Parameters
    ----------
    points : (n, 3) array
        Distinct points.
    neighborhoods : Neighborhoods

    Returns
    -------
    (nnz,) float64 array, dimensionless.

    References
    ----------
    Floater and Reimers 2001, section 4, method 2.

    Examples
    --------
    >>> import numpy as np
    >>> pair = Neighborhoods(np.array([0, 2, 2, 2]), np.array([1, 2]))
    >>> reciprocal_distance(np.array([[0.0, 0, 0], [1, 0, 0], [-3, 0, 0]]), pair)
    array([0.75, 0.25])
    """
    return normalize(1.0 / _lengths(_offsets(points, neighborhoods)), neighborhoods)


def mean_value(points: Points, neighborhoods: Neighborhoods) -> Weights:
    r"""Weigh neighbours by mean value coordinates: positive, smooth in the points, exact on planes.

    .. math:: w_{ij} = \frac{\tan(\alpha_{j-1}/2) + \tan(\alpha_j/2)}{\|x_j - x_i\|}

    with :math:`\alpha_j` the angle at :math:`x_i` between neighbours j and j + 1, measured in space. An open star has
    no angle across its gap.

    Parameters
    ----------
    points : (n, 3) array
        Distinct points.
    neighborhoods : Neighborhoods
        Ordered: Delaunay stars or the one-rings of a mesh.

    Returns
    -------
    (nnz,) float64 array, dimensionless.

    Raises
    ------
    InputError
        If the neighbours are not ordered.

    References
    ----------
    Floater 2003, Mean value coordinates, equation (5).

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.points.stars import delaunay_star
    >>> import numpy as np
    >>> plus = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]])
    >>> mean_value(plus, delaunay_star(plus, nearest(plus, 4)))[:4].round(12)
    array([0.25, 0.25, 0.25, 0.25])
    """
    sentence = "mean value weights need ordered neighbours; use Delaunay stars or the rings of a mesh"
    rings = check_kind(neighborhoods, Rings, sentence)
    indptr, indices, is_open = rings.indptr, rings.indices, rings.is_open
    cloud, weights = np.ascontiguousarray(points, dtype=np.float64), np.empty(len(indices))
    over_ranges(
        lambda first, last: mean_value_kernel(cloud, indptr, indices, is_open, LEAST_TANGENT, first, last, weights),
        neighborhoods.n_points,
    )
    return weights


def shape_preserving(points: Points, neighborhoods: Neighborhoods) -> Weights:
    r"""Weigh neighbours by the averaged barycentric coordinates of Floater 1997: exact on planes.

    For each neighbour j, the ray from :math:`x_j` through :math:`x_i` meets an edge k, k + 1 of the star; the
    barycentric coordinates of :math:`x_i` in the triangle j, k, k + 1 are averaged over j. Open stars, which do not
    surround their centre, get mean value weights.

    Parameters
    ----------
    points : (n, 3) array
    neighborhoods : Neighborhoods
        Delaunay stars: ordered, with planar positions.

    Returns
    -------
    (nnz,) float64 array, dimensionless.

    Raises
    ------
    InputError
        If the neighbours have no planar positions.

    References
    ----------
    Floater 1997, Parametrization and smooth approximation of surface triangulations, section 6.
    Floater and Reimers 2001, section 4, method 3.

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.points.stars import delaunay_star
    >>> import numpy as np
    >>> kite = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [-3, 0, 0], [0, -1, 0]])
    >>> shape_preserving(kite, delaunay_star(kite, nearest(kite, 4)))[:4].round(12).tolist()
    [0.375, 0.25, 0.125, 0.25]
    """
    sentence = "shape-preserving weights need planar positions of the neighbours; use Delaunay stars"
    stars = check_kind(neighborhoods, PlanarStars, sentence)
    local, is_open = stars.local, stars.is_open
    weight = np.zeros(len(neighborhoods.indices))
    over_ranges(
        lambda first, last: shape_preserving_kernel(local, neighborhoods.indptr, is_open, first, last, weight),
        neighborhoods.n_points,
    )
    open_entries = np.repeat(is_open, neighborhoods.sizes)
    weight[open_entries] = mean_value(points, neighborhoods)[open_entries]
    return normalize(weight, neighborhoods)


def _offsets(points: Points, neighborhoods: Neighborhoods) -> Floats:
    return np.asarray(points[neighborhoods.indices] - points[neighborhoods.rows])


def _lengths(offset: Floats) -> Floats:
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", offset, offset)))


def trusted(links: Links, scheme: WeightScheme = reciprocal_distance) -> WeightScheme:
    """Multiply a weight scheme by the trust of links, for use on their neighbourhoods."""

    def weights(points: Points, neighborhoods: Neighborhoods) -> Weights:
        return normalize(links.trust * scheme(points, neighborhoods), neighborhoods)

    return weights
