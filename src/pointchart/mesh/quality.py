"""Measures of meshes, one function each."""

from collections.abc import Callable

import numpy as np

from .._kernels.mesh.triangle_shapes import measure_areas, measure_plane_areas, measure_shapes
from .._parallel import over_ranges
from ..typing import UV, Floats, Indices, Points, Triangles
from .connectivity import HalfEdges


def edge_lengths(points: Points, edges: HalfEdges) -> tuple[Indices, Floats]:
    """List every edge of a mesh once with its length.

    Returns
    -------
    ends : (e, 2) int64 array
    lengths : (e,) float64 array, in the unit of the points.

    Examples
    --------
    >>> import numpy as np
    >>> from pointchart.mesh.connectivity import half_edges
    >>> edge_lengths(np.array([[0.0, 0, 0], [3, 0, 0], [3, 4, 0]]), half_edges(np.array([[0, 1, 2]]), 3))[1]
    array([3., 4., 5.])
    """
    kept = edges.twins < np.arange(len(edges.twins))
    ends = np.column_stack([edges.origins[kept], edges.targets[kept]])
    return ends, np.asarray(np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1))


def area_vectors(points: Points, triangles: Triangles) -> Floats:
    """Return the vector of each triangle that is normal to it and as long as its area, (m, 3).

    Examples
    --------
    >>> import numpy as np
    >>> area_vectors(np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
    array([[0., 0., 1.]])
    """
    a, b, c = points[triangles[:, 0]], points[triangles[:, 1]], points[triangles[:, 2]]
    return np.asarray(0.5 * np.cross(b - a, c - a))


def unit_normals(points: Points, triangles: Triangles) -> Points:
    """Return the unit normal of each triangle, (m, 3); zero where one is flat.

    Examples
    --------
    >>> import numpy as np
    >>> unit_normals(np.array([[0.0, 0, 0], [2, 0, 0], [0, 3, 0]]), np.array([[0, 1, 2], [0, 1, 1]]))
    array([[0., 0., 1.],
           [0., 0., 0.]])
    """
    vectors = area_vectors(points, triangles)
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1), 1e-300)[:, None])


def vertex_normals(points: Points, triangles: Triangles) -> Points:
    """Return the unit normal of each point, (n, 3): the mean of its triangles by area; zero where there is none.

    Examples
    --------
    >>> import numpy as np
    >>> corner = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> vertex_normals(corner, np.array([[0, 1, 2], [0, 3, 1]]))[1:].round(3)
    array([[0.   , 0.707, 0.707],
           [0.   , 0.   , 1.   ],
           [0.   , 1.   , 0.   ]])
    """
    vectors, total = area_vectors(points, triangles), np.empty_like(points)
    for k in range(3):
        total[:, k] = np.bincount(triangles.ravel(), np.repeat(vectors[:, k], 3), len(points))
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return np.asarray(total / np.where(length > 0.0, length, 1.0))


def heights(points: Points, triangles: Triangles, offsets: Floats) -> Floats:
    """Measure offsets from the points, (n, 3), along the normals of the mesh there, (n,), positive on their side.

    Examples
    --------
    >>> import numpy as np
    >>> flat = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    >>> heights(flat, np.array([[0, 1, 2]]), np.array([[5.0, 5, 2], [0, 0, -1], [1, 0, 0]]))
    array([ 2., -1.,  0.])
    """
    return np.asarray(np.einsum("ij,ij->i", offsets, vertex_normals(points, triangles)))


def areas(points: Points, triangles: Triangles) -> Floats:
    """Measure the area of each triangle, (m,), in the unit of the points squared.

    Examples
    --------
    >>> import numpy as np
    >>> areas(np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
    array([1.])
    """
    return of_each(triangles, measure_areas, points)


def plane_areas(uv: UV, triangles: Triangles) -> Floats:
    """Measure the area of each triangle in the plane, (m,), negative for those that turn clockwise.

    Examples
    --------
    >>> import numpy as np
    >>> plane_areas(np.array([[0.0, 0], [2, 0], [0, 1]]), np.array([[0, 1, 2], [0, 2, 1]]))
    array([ 1., -1.])
    """
    return of_each(triangles, measure_plane_areas, uv)


def dihedral_angles(points: Points, triangles: Triangles, edges: HalfEdges) -> Floats:
    """Measure by how much the surface turns at each inner edge: 0 where it is flat, pi where it folds back, in radians.

    Examples
    --------
    >>> import numpy as np
    >>> corner = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, -1]])
    >>> from pointchart.mesh.connectivity import half_edges
    >>> faces = np.array([[0, 1, 2], [1, 0, 3]])
    >>> np.rad2deg(dihedral_angles(corner, faces, half_edges(faces, 4))).round(6)
    array([90.])
    """
    inner = np.flatnonzero(edges.twins > np.arange(len(edges.twins)))
    vectors = area_vectors(points, triangles)
    one, other = vectors[inner // 3], vectors[edges.twins[inner] // 3]
    return np.asarray(np.arctan2(np.linalg.norm(np.cross(one, other), axis=1), np.einsum("ij,ij->i", one, other)))


def radius_ratios(points: Points, triangles: Triangles) -> Floats:
    """Measure the shape of each triangle: twice the inradius over the circumradius, 1 if equilateral, 0 if flat.

    Examples
    --------
    >>> import numpy as np
    >>> radius_ratios(np.array([[0.0, 0, 0], [1, 0, 0], [0.5, 0.75**0.5, 0]]), np.array([[0, 1, 2]])).round(12)
    array([1.])
    """
    return of_each(triangles, measure_shapes, points)


def smallest_angles(points: Points, triangles: Triangles) -> Floats:
    """Measure the smallest angle of each triangle, in degrees, (m,).

    Examples
    --------
    >>> import numpy as np
    >>> smallest_angles(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]])).round(9)
    array([45.])
    """
    corner = points[triangles]
    least = np.full(len(triangles), np.pi)
    for k in range(3):
        a, b = corner[:, (k + 1) % 3] - corner[:, k], corner[:, (k + 2) % 3] - corner[:, k]
        least = np.minimum(least, np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ij,ij->i", a, b)))
    return np.asarray(np.rad2deg(least))


def of_each(triangles: Triangles, measure: Callable[..., None], places: Floats) -> Floats:
    """Measure triangles by a kernel that writes one number for each, on every core."""
    measured = np.empty(len(triangles))
    over_ranges(lambda first, last: measure(places, triangles, first, last, measured), len(triangles))
    return measured
