"""The proof, on each run, that a mesh is a disc on exactly the given points, with one-to-one parameters."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_loop, check_points, check_triangles
from .._kernels.mesh.half_edges import count_parts, measure_edges
from .._parallel import over_ranges
from ..boundary import is_same_loop
from ..errors import InputError, SolveError
from ..mesh.connectivity import HalfEdges, boundary_loops, fans, half_edges
from ..mesh.planar_delaunay import coinciding
from ..plane.crossings import is_simple
from ..plane.exact_signs import orientation_signs, sense
from ..points.neighbors import spacing_of_places
from ..typing import UV, Floats, Loop, Points, Triangles

FOLD_COSINE = np.cos(np.deg2rad(150.0))  # of the turn at an edge: a choice, as folds are counted and never refused


@dataclass(frozen=True, slots=True)
class Certificate:
    """What was found when a mesh was checked; all counts are exact.

    Attributes
    ----------
    n_points, n_triangles : int
    unused_points : int
        Points in no triangle.
    overfull_edges : int
        Edges with more than two triangles, or with triangles of opposite orientation.
    pinched_points : int
        Points with more than one fan of triangles.
    parts : int
        Parts that no edge joins.
    euler : int
        Euler characteristic: points in use - edges + triangles; 1 for a disc, 1 less for every hole.
    boundary_loops : int
    boundary_as_given : bool or None
        Whether the loop that was asked for is one of the boundary loops, None if none was.
    coinciding_uv : int or None
        Points that share their parameters with others, None without uv.
    flat_or_folded_uv : int or None
        Triangles whose area in the plane is not positive, by exact arithmetic.
    simple_uv_boundary : bool or None
        Whether all boundary loops are simple polygons in the plane, one of them anticlockwise and those of holes
        clockwise, by exact arithmetic: without it, positive triangles might overlap. None without uv, or unless there
        are as many loops as there should be.
    longest_edge_over_spacing : float
        Largest ratio of an edge's length to the spacing of the points at its ends: a bridge over a gap shows here.
    folds : int
        Edges at which the surface turns back by more than 150 degrees.
    holes : int
        How many holes the disc was to have.
    """

    n_points: int
    n_triangles: int
    unused_points: int
    overfull_edges: int
    pinched_points: int
    parts: int
    euler: int
    boundary_loops: int
    boundary_as_given: bool | None
    coinciding_uv: int | None
    flat_or_folded_uv: int | None
    simple_uv_boundary: bool | None
    longest_edge_over_spacing: float
    folds: int
    holes: int

    @property
    def is_disc(self) -> bool:
        """Whether the mesh is a disc without holes on all points, with the boundary asked for."""
        return self.is_as_asked and self.holes == 0

    @property
    def is_as_asked(self) -> bool:
        """Whether the mesh is a disc with the holes and the boundary asked for, on all points."""
        return not self.faults

    @property
    def is_one_to_one(self) -> bool:
        """Whether the parameters map the mesh to the plane one-to-one; False without uv.

        All triangles are positive and their boundary loops are simple polygons that run round their outside. A place in
        the plane is covered as often as the loops wind around it, so at most once.
        """
        is_positive = self.coinciding_uv == 0 and self.flat_or_folded_uv == 0
        return self.is_as_asked and is_positive and self.simple_uv_boundary is True

    @property
    def faults(self) -> tuple[str, ...]:
        """The ways in which the mesh is not the disc asked for, as phrases; empty when it is one."""
        euler, loops = 1 - self.holes, 1 + self.holes
        checks = (
            (self.n_triangles == 0, "it has no triangles"),
            (self.unused_points > 0, f"{self.unused_points} points are in no triangle"),
            (self.overfull_edges > 0, f"{self.overfull_edges} edges have more than two triangles or turn over"),
            (self.pinched_points > 0, f"{self.pinched_points} points have several fans of triangles"),
            (self.parts > 1, f"it has {self.parts} parts instead of 1"),
            (self.euler != euler, f"its Euler characteristic is {self.euler} instead of {euler}"),
            (self.boundary_loops != loops, f"it has {self.boundary_loops} boundary loops instead of {loops}"),
            (self.boundary_as_given is False, "its boundary is not the loop given"),
        )
        return tuple(phrase for failed, phrase in checks if failed)


def certify(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    uv: ArrayLike | None = None,
    loop: ArrayLike | None = None,
    spacing: Floats | None = None,
    holes: int = 0,
) -> Certificate:
    """Check a mesh against its points, its parameters and the boundary asked for.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
    uv : (n, 2) array, optional
        Parameters, to be checked for being one-to-one.
    loop : (b,) int array, optional
        The boundary asked for; where it starts and which way it runs does not matter.
    spacing : (n,) array, optional
        Local spacing; measured, if not given.
    holes : int
        How many holes the disc should have: gaps that were left open.

    Returns
    -------
    Certificate

    Raises
    ------
    InputError
        If triangles name points that are not there, uv has another length, or `holes` is negative.

    Examples
    --------
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> certify(square, [[0, 1, 2], [0, 2, 3]], loop=[3, 2, 1, 0]).is_disc
    True
    >>> certify(square, [[0, 1, 2]]).faults
    ('1 points are in no triangle',)
    """
    cloud = check_points(points)
    faces = check_triangles(triangles, len(cloud))
    if holes < 0:
        raise InputError(f"a disc cannot have {holes} holes; give 0 or more")
    plane = None if uv is None else _checked_uv(uv, len(cloud))
    asked = None if loop is None else check_loop(loop, len(cloud))
    apart = spacing_of_places(cloud) if spacing is None else spacing
    return prove(cloud, faces, plane, asked, spacing=apart, holes=holes)


def prove(
    cloud: Points, faces: Triangles, plane: UV | None, asked: Loop | None, *, spacing: Floats, holes: int
) -> Certificate:
    """Certify as `certify` does, by arrays that are known to be right in shape."""
    edges = half_edges(faces, len(cloud))
    fan_counts = fans(edges, len(cloud))
    n_edges, n_overfull = _count_edges(edges)
    is_manifold = edges.n_overfull == 0 and not (fan_counts > 1).any()
    loops = boundary_loops(edges) if is_manifold else []
    longest, folds = _measure(cloud, edges, spacing)
    return Certificate(
        n_points=len(cloud),
        n_triangles=len(faces),
        unused_points=int((fan_counts == 0).sum()),
        overfull_edges=n_overfull,
        pinched_points=int((fan_counts > 1).sum()),
        parts=int(count_parts(edges.origins, len(cloud))) - int((fan_counts == 0).sum()),
        euler=int((fan_counts > 0).sum()) - n_edges + len(faces),
        boundary_loops=len(loops),
        boundary_as_given=None if asked is None else any(is_same_loop(found, asked) for found in loops),
        coinciding_uv=None if plane is None else len(coinciding(plane)),
        flat_or_folded_uv=None if plane is None else int((orientation_signs(plane, faces) <= 0).sum()),
        simple_uv_boundary=_bound_simply(plane, loops) if plane is not None and len(loops) == 1 + holes else None,
        longest_edge_over_spacing=longest,
        folds=folds,
        holes=holes,
    )


def check_proof(proof: Certificate, *, is_one_to_one: bool) -> None:
    """Check that a mesh was proved to be what was asked for.

    Parameters
    ----------
    proof : Certificate
    is_one_to_one : bool
        Whether the parameters have to be one-to-one.

    Raises
    ------
    SolveError
        If it is not the disc asked for, or the parameters are not one-to-one.
    """
    if not proof.is_as_asked:
        raise SolveError(f"the mesh is no disc: {', '.join(proof.faults)}; give another boundary or neighbourhood")
    if is_one_to_one and not proof.is_one_to_one:
        raise SolveError(
            f"the parameters are not one-to-one: {proof.flat_or_folded_uv} triangles are flat and "
            f"{proof.coinciding_uv} points coincide: a part of the surface is too long for its neck in double "
            "precision, or too narrow for a straight side of the domain; cut that part off, or use the circle"
        )


def _checked_uv(uv: ArrayLike, n_points: int) -> UV:
    plane = np.asarray(uv, dtype=np.float64)
    if plane.shape != (n_points, 2):
        raise InputError(f"uv has shape {plane.shape}; {n_points} points need ({n_points}, 2)")
    broken = np.flatnonzero(~np.isfinite(plane).all(axis=1))
    if len(broken):
        raise InputError(f"the parameters of {len(broken)} points are NaN or infinite, the first at index {broken[0]}")
    return plane


def _count_edges(edges: HalfEdges) -> tuple[int, int]:
    """Count all edges, and the overfull ones."""
    if edges.n_overfull == 0:
        return len(edges.twins) - int((edges.twins >= 0).sum()) // 2, 0
    low, high = np.minimum(edges.origins, edges.targets), np.maximum(edges.origins, edges.targets)
    ways, uses = np.unique(np.column_stack([low, high, edges.origins == low]), axis=0, return_counts=True)
    return len(np.unique(ways[:, :2], axis=0)), len(np.unique(ways[uses > 1, :2], axis=0))


def _measure(points: Points, edges: HalfEdges, spacing: Floats) -> tuple[float, int]:
    """Return the largest ratio of an edge's length to the spacing at its ends, and how many edges are folds."""
    ratios, folds = np.zeros(len(edges.origins)), []

    def measure(first: int, last: int) -> None:
        folds.append(measure_edges(points, edges.origins, edges.twins, spacing, FOLD_COSINE, first, last, ratios))

    over_ranges(measure, len(ratios))
    return float(ratios.max(initial=0.0)), int(sum(folds))


def _bound_simply(plane: UV, loops: list[Loop]) -> bool:
    """Tell whether loops are simple polygons, one of them anticlockwise and the others, those of holes, clockwise."""
    polygons = [plane[loop] for loop in loops]
    senses = sorted(map(sense, polygons), reverse=True)
    return senses == [1] + [-1] * (len(loops) - 1) and all(map(is_simple, polygons))
