"""Edge recovery: links that the surface has, brought back into the triangulation of the parameters."""

from dataclasses import dataclass

import numpy as np

from .._kernels.mesh.recover_edges import JOURNAL
from .._kernels.mesh.recover_edges import recover as recover_kernel
from ..agreement.links import FULL_TRUST, Links
from ..typing import UV, Points, Triangles
from .connectivity import editable_mesh


@dataclass(frozen=True, slots=True, eq=False)
class Recovered:
    """A triangulation of the parameters with the links of the surface in it.

    Attributes
    ----------
    triangles : (m, 3) int64
    n_recovered, n_missed : int
        Links that became edges, and that did not: other edges are better there, or no swaps lead to them.
    """

    triangles: Triangles
    n_recovered: int
    n_missed: int


def recover_links(points: Points, uv: UV, triangles: Triangles, links: Links) -> Recovered:
    """Make links of full trust edges of the triangulation, where that lowers the energy of the mesh in space.

    Where the map is narrow, the Delaunay triangulation of the parameters joins points that are far apart on the
    surface, and edge swaps in space do not find back. Links on which neighbouring stars agree do: each is made an edge
    by swapping the edges that it crosses in the plane, the shortest links first, as in constrained triangulation; where
    it makes the mesh worse (see `mesh_energy`), as one from sheet to sheet does, that is undone.

    Parameters
    ----------
    points : (n, 3) float64 array
    uv : (n, 2) float64 array
        Parameters of the points.
    triangles : (m, 3) int64 array
        Their triangulation.
    links : Links

    Returns
    -------
    Recovered

    References
    ----------
    Sloan 1993, A fast algorithm for generating constrained Delaunay triangulations.

    Examples
    --------
    >>> from pointchart.agreement.links import link_stars
    >>> from pointchart.points.neighbors import nearest
    >>> from pointchart.points.stars import delaunay_star
    >>> kite = np.array([[0.0, 0, 0], [9, 0, 0], [4, 1, 0], [4, -1, 0]])
    >>> links = link_stars(delaunay_star(kite, nearest(kite, 3)))
    >>> recover_links(kite, kite[:, :2].copy(), np.array([[0, 1, 2], [1, 0, 3]]), links).triangles.tolist()
    [[3, 1, 2], [2, 0, 3]]
    """
    graph = links.neighborhoods
    is_meant = (graph.rows < graph.indices) & (links.trust == FULL_TRUST)
    one, other = graph.rows[is_meant], graph.indices[is_meant]
    shortest_first = np.argsort(np.linalg.norm(points[one] - points[other], axis=1), kind="stable")
    draft = editable_mesh(points, triangles, journal=JOURNAL)
    made, missed = recover_kernel(draft, uv, one[shortest_first], other[shortest_first])
    return Recovered(draft.corners.reshape(-1, 3), int(made), int(missed))
