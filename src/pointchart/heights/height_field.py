"""A surface over a plane: the Delaunay triangulation of its projection, certified as every mesh is."""

from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points
from ..clock import StageClock
from ..errors import InputError, Remedy, points_called
from ..gaps.bridges import find_bridges, open_gaps
from ..mesh.make import MeshCounts
from ..mesh.planar_delaunay import coinciding, delaunay
from ..pipeline import Evidence, Reconstruction
from ..points.cloud import prepare
from ..points.neighbors import spacing_of_places
from ..proof.certificate import check_proof, prove
from ..solve.systems import Solution
from ..typing import UV, Floats, Indices
from .outline import drawn_in, usual_lengths
from .projection import axes_over, projected


class Keep(StrEnum):
    """Which of the points at one place of the plane stays."""

    highest = "highest"
    lowest = "lowest"


def reconstruct_heights(
    points: ArrayLike,
    normal: ArrayLike = (0.0, 0.0, 1.0),
    *,
    keep: Keep | None = None,
    gaps_open: bool = False,
    clock: StageClock | None = None,
) -> Reconstruction:
    """Triangulate a height field by its projection to a plane, prove it a disc and one-to-one over the plane.

    The parameters are the coordinates in the plane, in the unit of the points. The outline is the convex hull, less
    what only edges of over four times the usual length span.

    Parameters
    ----------
    points : (N, 3) array
        The scan. Repeated points are merged.
    normal : (3,) array
        Of the plane, towards the side that is looked at: z for terrain.
    keep : Keep, optional
        Which of several points at one place of the plane stays; without it they are refused.
    gaps_open : bool
        Leave gaps within the outline open; else they are bridged.
    clock : StageClock, optional

    Returns
    -------
    Reconstruction
        Its `rows` are those of the points that stay.

    Raises
    ------
    InputError
        If several points are at one place of the plane, or the points are at fault.

    Examples
    --------
    >>> from pointchart import shapes
    >>> hill = reconstruct_heights(shapes.relief(400, seed=1).points)
    >>> hill.certificate.is_disc, hill.certificate.is_one_to_one
    (True, True)
    """
    clock = clock or StageClock()
    with clock("prepare"):
        scan = check_points(points)
        axes = axes_over(normal)
        rows = np.sort(prepare(scan).rows)
        uv, heights = projected(scan[rows], axes)
        stays = _one_a_place(uv, heights, keep, rows)
        rows, uv = rows[stays], uv[stays]
    with clock("triangulate"), points_called(rows):
        flat = np.column_stack([uv - uv.mean(axis=0), np.zeros(len(uv))])
        hull = delaunay(uv)
        usual = usual_lengths(uv, hull, spacing_of_places(flat))
        triangles, loop = drawn_in(uv, hull, usual)
        found = find_bridges(flat, triangles, usual, lambda: np.ones(len(uv), np.bool_))
        holes = 0
        if gaps_open:
            triangles, holes = open_gaps(triangles, [bridge.triangles for bridge in found], len(uv))
    with clock("certify"), points_called(rows):
        proof = prove(scan[rows], triangles, uv, loop, spacing=usual, holes=holes)
        check_proof(proof, is_one_to_one=True)
    bridges = [bridge.called(np.arange(len(rows))) for bridge in found]
    none = Solution(uv, 0.0, (), "projection", 0, 0)
    evidence = Evidence([], bridges, [], MeshCounts(0, True, 0, 0, 0), None, none)
    return Reconstruction(rows, triangles, uv, loop, proof, evidence)


def _one_a_place(uv: UV, heights: Floats, keep: Keep | None, rows: Indices) -> Indices:
    """Return which points stay, ascending: at each place of the plane one."""
    doubled = coinciding(uv)
    if len(doubled) == 0:
        return np.arange(len(uv))
    if keep is None:
        raise InputError(
            f"{len(doubled)} points share their places in the plane with others ({{doubled}}), at other heights",
            remedies=[Remedy.keep_one_a_place],
            doubled=np.sort(rows[doubled]),
        )
    _, place = np.unique(uv, axis=0, return_inverse=True)
    order = np.lexsort((heights if keep is Keep.lowest else -heights, place.ravel()))
    is_first = np.ones(len(order), np.bool_)
    is_first[1:] = place.ravel()[order[1:]] != place.ravel()[order[:-1]]
    return np.sort(order[is_first])
