"""Where a mesh passes through itself."""

from itertools import chain, product
from typing import TypeAlias

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike

from .._check import check_points, check_triangles
from .._kernels.proof.triangle_meetings import find_meetings
from .._parallel import over_ranges
from ..points.morton import morton_order
from ..typing import Floats, Indices, Points, Triangles

Vector: TypeAlias = list[int]


def self_intersections(points: ArrayLike, triangles: ArrayLike) -> Indices:
    """Find the pairs of triangles without a common corner that have a place in common, if only a point.

    Floating point decides where it can be trusted, whole numbers elsewhere, so the answer is exact; a pair that takes
    whole numbers, as where triangles touch or overlap in one plane, takes a tenth of a millisecond. Pairs with a common
    corner are left out, as are pairs of which neither has an area.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array

    Returns
    -------
    (k, 2) int64 array
        The lesser triangle first, in order.

    Raises
    ------
    InputError
        If triangles name points that are not there.

    References
    ----------
    Shewchuk 1997, Adaptive precision floating-point arithmetic and fast robust geometric predicates, section 4.3.

    Examples
    --------
    >>> upright = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [9, 9, 0]]
    >>> self_intersections(upright, [[3, 4, 5], [0, 1, 2]]).tolist()
    [[0, 1]]
    """
    cloud = check_points(points)
    faces = check_triangles(triangles, len(cloud))
    if len(faces) == 0:
        return np.empty((0, 2), np.int64)
    # A power of two changes no sign, and keeps products from overflow.
    scaled = np.ldexp(cloud, -int(np.frexp(np.abs(cloud).max())[1]))
    order = morton_order(scaled[faces[:, 0]])
    ordered = faces[order]
    boxes = box_tree(*(scaled[corners] for corners in ordered.T))
    parts: dict[int, Indices] = {}

    def find(first: int, last: int) -> None:
        found = np.empty((last - first, 3), np.int64)
        count = find_meetings(scaled, ordered, boxes, first, last, found)
        if count > len(found):
            found = np.empty((count, 3), np.int64)
            find_meetings(scaled, ordered, boxes, first, last, found)
        parts[first] = found[:count].copy()

    over_ranges(find, len(faces))
    found = np.concatenate([parts[first] for first in sorted(parts)])
    meets = [bool(sure) or _meet(cloud[ordered[t]], cloud[ordered[u]]) for t, u, sure in found.tolist()]
    pairs = np.sort(order[found[meets, :2]], axis=1)
    return pairs[np.lexsort(pairs.T[::-1])]


def places_of(points: Points, triangles: Triangles, pairs: Indices) -> Points:
    """Gather pairs of triangles that meet into places: pairs are at one place if they have a corner in common.

    Returns
    -------
    (p, 3) float64 array
        The middle of the first pair of each place, the place of most pairs first.

    Examples
    --------
    >>> points = np.array([[0.0, 0, 0], [3, 0, 0], [0, 3, 0], [1, 1, -3], [1, 1, 3], [7, 1, 0]])
    >>> places_of(points, np.array([[0, 1, 2], [3, 4, 5]]), np.array([[0, 1]]))
    array([[2., 1., 0.]])
    """
    corners = triangles[pairs].reshape(-1, 6)
    links = sp.coo_array(
        (np.ones(5 * len(pairs)), (np.repeat(corners[:, 0], 5), corners[:, 1:].ravel())), shape=(len(points),) * 2
    )
    parts = sp.csgraph.connected_components(links, directed=False)[1]
    _, first, n_pairs = np.unique(parts[corners[:, 0]], return_index=True, return_counts=True)
    return np.asarray(points[corners[first[np.argsort(-n_pairs, kind="stable")]]].mean(axis=1))


def box_tree(a: Points, b: Points, c: Points) -> Floats:
    """Return the boxes of triangles abc in spatial order and, above them, of each two neighbours, up to the root at 1.

    A box is its least corner and its largest one.
    """
    leaves = 1 << (len(a) - 1).bit_length()
    boxes = np.tile(np.repeat([np.inf, -np.inf], 3), (2 * leaves, 1))
    boxes[leaves : leaves + len(a), :3] = np.minimum(np.minimum(a, b), c)
    boxes[leaves : leaves + len(a), 3:] = np.maximum(np.maximum(a, b), c)
    while leaves > 1:
        left, right = boxes[leaves : 2 * leaves : 2], boxes[leaves + 1 : 2 * leaves : 2]
        boxes[leaves // 2 : leaves, :3] = np.minimum(left[:, :3], right[:, :3])
        boxes[leaves // 2 : leaves, 3:] = np.maximum(left[:, 3:], right[:, 3:])
        leaves //= 2
    return boxes


def _meet(one: Points, other: Points) -> bool:
    """Tell exactly whether two triangles have a place in common, unless neither has an area.

    Triangles that are apart are so along the normal of one, the normal to an edge of each or, in a common plane, the
    normal to an edge.
    """
    ratios = [[x.as_integer_ratio() for x in corner] for corner in [*one.tolist(), *other.tolist()]]
    scale = max(denominator for corner in ratios for _, denominator in corner)
    corners = [[n * (scale // d) for n, d in corner] for corner in ratios]
    sides = [[_minus(corners[k + (j + 1) % 3], corners[k + j]) for j in range(3)] for k in (0, 3)]
    normals = [_cross(first, second) for first, second, _ in sides]
    flat = next((normal for normal in normals if any(normal)), None)
    if flat is None:
        return False
    axes = chain(
        normals,
        (_cross(a, b) for a, b in product(*sides)),
        (_cross(flat, a) for a in chain(*sides)),
    )
    return not any(_part(corners, axis) for axis in axes)


def _minus(a: Vector, b: Vector) -> Vector:
    return [x - y for x, y in zip(a, b, strict=True)]


def _cross(a: Vector, b: Vector) -> Vector:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _part(corners: list[Vector], axis: Vector) -> bool:
    """Tell whether the first three corners lie wholly before or behind the others along an axis."""
    place = [sum(x * y for x, y in zip(corner, axis, strict=True)) for corner in corners]
    return max(place[:3]) < min(place[3:]) or max(place[3:]) < min(place[:3])
