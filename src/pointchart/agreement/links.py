"""Links of a surface: the stars of all points joined to one symmetric graph, each link with its trust."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .._kernels.agreement.link_trust import agreement
from .._parallel import over_ranges
from ..errors import InputError
from ..map.convex_combination import cut_points
from ..map.weights import WeightScheme, normalize, reciprocal_distance
from ..points.neighbors import Neighborhoods
from ..typing import Floats, Indices, Loop, Mask, Points, Weights

FULL_TRUST = 1.0  # factor of the weight: as it is
LONE_TRUST = 0.01  # a link that only one star sees: never 0, since the graph must stay connected
TIES = 3  # of a point that hangs on one point: to as many points beside, since two may lie on a line with it


@dataclass(frozen=True, slots=True, eq=False)
class Links:
    """A symmetric graph with a trust for each link.

    Attributes
    ----------
    neighborhoods : Neighborhoods
        Unordered; j is a neighbour of i if and only if i is one of j (condition 4.5).
    trust : (nnz,) float64
        In (0, 1], the same both ways.
    """

    neighborhoods: Neighborhoods
    trust: Floats


def link_stars(star: Neighborhoods, *, also: Neighborhoods | None = None) -> Links:
    """Join Delaunay stars to one symmetric graph, trusting links by the agreement of neighbouring stars.

    A link has full trust when it is an edge of a triangle that at least two of its corners' stars hold. The others,
    mostly across to a close second sheet, keep a hundredth.

    Parameters
    ----------
    star : Neighborhoods
        Ordered.
    also : Neighborhoods, optional
        Further links, trusted as those on which no stars agree: other diagonals that the mesh may take, so that its
        graph is nearly the same and one order of elimination serves both.

    Returns
    -------
    Links

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.points.stars import delaunay_star
    >>> plus = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    >>> links = link_stars(delaunay_star(plus, nearest(plus, 4)))
    >>> links.neighborhoods.sizes, links.trust.min()
    (array([4, 3, 3, 3, 3]), np.float64(1.0))
    """
    trust = np.where(_agree(star), FULL_TRUST, LONE_TRUST)
    graph = sp.csr_array((trust, star.indices, star.indptr), shape=(star.n_points, star.n_points))
    if also is not None:
        lone = np.full(len(also.indices), LONE_TRUST)
        graph = graph.maximum(sp.csr_array((lone, also.indices, also.indptr), shape=graph.shape))
    both = graph.maximum(graph.T.tocsr()).tocsr()
    neighborhoods = Neighborhoods(both.indptr.astype(np.int64), both.indices.astype(np.int64))
    return Links(neighborhoods, both.data)


def tie_down(points: Points, links: Links, loop: Loop) -> Links:
    """Link points that hang on a single point, or on none, to the nearest points that do not.

    All paths from such a point to the boundary pass one point, into which it would collapse (Proposition 3.1), as in a
    clump that floats over the surface. The new links have the least trust.

    Parameters
    ----------
    points : (n, 3) array
    links : Links
    loop : (b,) int array
        The boundary.

    Returns
    -------
    Links
        The same, if no point hangs.

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.points.stars import delaunay_star
    >>> plus = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 9]])
    >>> star = delaunay_star(plus[:5], nearest(plus[:5], 4))
    >>> apart = Neighborhoods(np.append(star.indptr, 16), star.indices, None, np.append(star.is_open, True))
    >>> tied = tie_down(plus, link_stars(apart), np.arange(1, 5))
    >>> int(tied.neighborhoods.sizes[5])
    3
    """
    graph, n = links.neighborhoods, len(points)
    hangs = cut_points(graph, loop) != -1
    if not hangs.any():
        return links
    from scipy.spatial import KDTree

    loose, rest = np.flatnonzero(hangs), np.flatnonzero(~hangs)
    _, nearest = KDTree(points[rest]).query(points[loose], k=min(TIES, len(rest)))
    rows, columns = np.repeat(loose, nearest.shape[1]), rest[nearest.ravel()]
    ties = sp.csr_array((np.full(len(rows), LONE_TRUST), (rows, columns)), shape=(n, n))
    tied = sp.csr_array((links.trust, graph.indices, graph.indptr), shape=(n, n)).maximum(ties.maximum(ties.T)).tocsr()
    return Links(Neighborhoods(tied.indptr.astype(np.int64), tied.indices.astype(np.int64)), tied.data)


def disputed_links(star: Neighborhoods) -> Indices:
    """Count the links of each point's star on which no neighbouring star agrees, (n,).

    None on a clearly sampled surface; some where sheets are close, at creases and in noise.

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.points.stars import delaunay_star
    >>> plus = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    >>> disputed_links(delaunay_star(plus, nearest(plus, 4)))
    array([0, 0, 0, 0, 0])
    """
    return np.bincount(star.rows, ~_agree(star), star.n_points).astype(np.int64)


def _agree(star: Neighborhoods) -> Mask:
    """Tell for each link of a star whether it is an edge of a triangle that another star holds as well."""
    if star.is_open is None:
        raise InputError("only ordered neighbourhoods can agree on triangles; use Delaunay stars")
    agrees, is_open = np.zeros(len(star.indices), np.bool_), star.is_open
    over_ranges(lambda first, last: agreement(star.indptr, star.indices, is_open, first, last, agrees), star.n_points)
    return agrees


def trusted(links: Links, scheme: WeightScheme = reciprocal_distance) -> WeightScheme:
    """Multiply a weight scheme by the trust of links, for use on their neighbourhoods."""

    def weights(points: Points, neighborhoods: Neighborhoods) -> Weights:
        return normalize(links.trust * scheme(points, neighborhoods), neighborhoods)

    return weights
