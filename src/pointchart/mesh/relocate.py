"""Vertex relocation: points that sit in the wrong place of a mesh, moved to the right one."""

from dataclasses import dataclass

import numpy as np

from .._kernels.mesh.editable import EditableMesh
from .._kernels.mesh.energy import total_energy
from .._kernels.mesh.far_links import mark_far
from .._kernels.mesh.put_back import JOURNAL
from .._kernels.mesh.put_back import relocate as relocate_kernel
from .._parallel import over_ranges
from ..points.neighborhoods import Neighborhoods
from ..typing import Indices, Mask, Points, Triangles
from .connectivity import editable_mesh

LEAST_GAIN = 1e-9  # of the mean energy of a triangle: smaller ones are rounding, and might move points for ever
TRIES = 30  # per point of the mesh, in all: a cap that no scan of the evaluation has reached


@dataclass(frozen=True, slots=True, eq=False)
class Relocated:
    """A mesh after points were moved to other places of it.

    Attributes
    ----------
    triangles : (m, 3) int64
        On the same points, with the same boundary.
    n_moves : int
    """

    triangles: Triangles
    n_moves: int


def relocate_points(points: Points, triangles: Triangles, around: Neighborhoods, suspects: Indices) -> Relocated:
    """Take points out of a mesh and put each back where it costs least; keep the move if the energy falls.

    Edge swaps cannot carry a point past others, so one that the map put on the wrong side of a crease, or on the other
    of two close sheets, stays there. A move takes it out by swaps, closes the hole, splits the triangle near the point
    where it costs least, and swaps edges around both places. What a move touches is tried next. The energy (see
    `mesh_energy`) falls with every move; at most 30 moves a point of the mesh are tried.

    Parameters
    ----------
    points : (n, 3) float64 array
    triangles : (m, 3) int64 array
        A manifold mesh.
    around : Neighborhoods
        Near points, at whose triangles each point may be put.
    suspects : (k,) int64 array
        Points to begin with. Those on the boundary stay.

    Returns
    -------
    Relocated

    Examples
    --------
    >>> from pointchart.points.neighbors import nearest
    >>> square = np.array([[0.0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [3, 2, 0]])
    >>> astray = np.array([[0, 1, 2], [0, 2, 4], [2, 3, 4], [3, 0, 4]])  # the last point lies in the first triangle
    >>> moved = relocate_points(square, astray, nearest(square, 4), np.array([4]))
    >>> moved.n_moves, sorted(np.bincount(moved.triangles.ravel()).tolist())
    (1, [2, 2, 2, 2, 4])
    """
    draft = editable_mesh(points, triangles, journal=JOURNAL)
    n_moves, _ = relocate_in_place(draft, around, suspects, least_gain(draft))
    return Relocated(draft.corners.reshape(-1, 3), n_moves)


def least_gain(draft: EditableMesh) -> float:
    """Return by how much the energy of a mesh has to fall with a move, in the fourth power of the points' unit."""
    return LEAST_GAIN * float(total_energy(draft)) / (len(draft.corners) // 3)


def relocate_in_place(draft: EditableMesh, around: Neighborhoods, suspects: Indices, least: float) -> tuple[int, Mask]:
    """Relocate points of a draft as `relocate_points` does, where the energy falls by more than `least`.

    Returns
    -------
    n_moves : int
    is_touched : (n,) bool array
        The points of all triangles that changed.
    """
    n = len(draft.points)
    is_touched = np.zeros(n, np.bool_)
    if len(suspects) == 0:
        return 0, is_touched
    queue, waiting = np.zeros(n, np.int32), np.zeros(n, np.bool_)
    queue[: len(suspects)], waiting[suspects] = suspects, True
    moves = relocate_kernel(
        draft, queue, waiting, len(suspects), around.indptr, around.indices, least, TRIES * n, is_touched
    )
    return int(moves), is_touched


def suspect_points(links: Neighborhoods, draft: EditableMesh, among: Indices | None = None) -> Indices:
    """Find the points with a link whose other end is more than two edges away on a mesh, (k,), ascending.

    Either the link reaches across to another sheet or the mesh has the point in a wrong place.

    Parameters
    ----------
    links : Neighborhoods
    draft : EditableMesh
        The mesh; see `editable_mesh`.
    among : (k,) int array, optional
        Points whose links are looked at; all, if not given.

    Examples
    --------
    >>> pair = Neighborhoods(np.array([0, 1, 1, 1, 1, 1, 1]), np.array([5]))
    >>> strip = np.array([[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]])
    >>> suspect_points(pair, editable_mesh(np.zeros((6, 3)), strip, journal=0))
    array([0, 5])
    """
    places = np.arange(links.n_points, dtype=np.int32) if among is None else np.asarray(among, np.int32)
    rows = links.table
    is_far = np.zeros(links.n_points, np.bool_)
    over_ranges(lambda first, last: mark_far(draft, *rows, first, last, places, is_far), len(places))
    return np.flatnonzero(is_far)


def mesh_energy(points: Points, triangles: Triangles) -> float:
    r"""Return the energy of a mesh in space, which long, large and bent triangles raise.

    .. math:: \sum_T |T| (a^2 + b^2 + c^2) + 2 \sum_e |e|^2 (|T_1| + |T_2|) \sin^4 \frac{\theta}{2}

    over triangles T of sides a, b, c and inner edges e between triangles T_1 and T_2, at which the surface turns by
    theta. In a plane it is least for the Delaunay triangulation; on a surface a point in a wrong place, a bridge or a
    fold costs more than any true edge.

    Returns
    -------
    float, in the fourth power of the unit of the points.

    References
    ----------
    Musin 1997, Properties of the Delaunay triangulation (the first sum).

    Examples
    --------
    >>> right = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> mesh_energy(right[:3], np.array([[0, 1, 2]]))  # 1/2 (1 + 1 + 2)
    2.0
    >>> mesh_energy(right, np.array([[0, 1, 2], [1, 0, 3]])).__round__(12)  # bent by 90 degrees along an edge of 1
    4.5
    """
    return float(total_energy(editable_mesh(points, triangles, journal=0))) / 2.0
