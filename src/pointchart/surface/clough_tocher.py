"""Clough-Tocher surfaces: smooth piecewise cubics on the triangles of the parameter plane."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike

from .._check import check_points, check_triangles, check_uv
from .._kernels.surface import clough_tocher_element as kernels
from .._parallel import over_ranges
from ..errors import InputError, name_some
from ..mesh.connectivity import HalfEdges, boundary_loops, half_edges
from ..mesh.planar_delaunay import coinciding
from ..mesh.quality import edge_lengths
from ..plane.exact_signs import orientation_signs
from ..points.morton import morton_order
from ..proof.certificate import certify
from ..proof.intersections import box_tree
from ..typing import UV, Floats, Indices, Points, Triangles

# The error falls by 2 + sqrt(3) a step, so this many steps take it below rounding.
STEPS = 30
RIDGE = 1e-13  # of the trace of a block, which rounding wrongs by a thousandth of that
ROUNDING = 2.0**-50  # of the largest parameter: a place off all triangles by eight roundings is still on one


@dataclass(frozen=True, slots=True, eq=False)
class CloughTocherSurface:
    """A surface through points, with a continuous tangent plane: three cubics on each triangle of the parameters.

    Attributes
    ----------
    points : (n, 3) float64
        In the unit of the scan.
    uv : (n, 2) float64
    triangles : (m, 3) int64
        Anticlockwise in uv, in spatial order.
    gradients : (n, 2, 3) float64
        Derivatives in u and in v at the points.
    crossings : (m, 3) float64
        Where the line through the barycentres of two neighbours meets the side from each corner to the next, as the
        share of that corner.
    boxes : (b, 6) float64
        The tree of boxes around the triangles.

    References
    ----------
    Farin 1986, Triangular Bernstein-Bezier patches, section 5.
    """

    points: Points
    uv: UV
    triangles: Triangles
    gradients: Floats
    crossings: Floats
    boxes: Floats

    @property
    def domain(self) -> Floats:
        """The least and the largest parameters: ((u, v), (u, v))."""
        return np.array([self.uv.min(axis=0), self.uv.max(axis=0)])

    def derivatives(self, uv: UV, du: int = 0, dv: int = 0) -> Points:
        """Return the derivative of order `du` in u and `dv` in v at each parameter pair, (n, 3); (0, 0): the points.

        Second derivatives jump where cubics meet, third ones are constant on each, and higher ones are 0. Off the
        triangles, by more than rounding, there is no surface: nan.
        """
        places = np.ascontiguousarray(uv, dtype=np.float64)
        out, slack = np.empty((len(places), 3)), ROUNDING * np.abs(self.uv).max()
        mesh, element = (self.uv, self.triangles, self.boxes, slack), (self.points, self.gradients, self.crossings)
        orders = (du, dv) if du + dv <= 3 else (3, 0)
        over_ranges(lambda first, last: kernels.evaluate(*mesh, *element, places, *orders, first, last, out), len(out))
        return out if du + dv <= 3 else 0.0 * out


def interpolate_clough_tocher(
    points: ArrayLike, uv: ArrayLike, triangles: ArrayLike, *, gradients: ArrayLike | None = None
) -> CloughTocherSurface:
    r"""Lay a surface with a continuous tangent plane through points, on a mesh of their parameters.

    Where no gradients are given, those are taken that bend the cubics along the edges least:

    .. math:: \sum_{ij} \int_0^{L_{ij}} \| s''_{ij}(t) \|^2 \, dt \to \min

    So linear maps are reproduced, and the error falls with the square of the edge lengths. With exact gradients
    quadratic maps are reproduced and the error falls with the third power. Each coordinate is a map of its own, so the
    surface moves with the points; it stays when the parameters are turned, moved or scaled, and with gradients given
    under any affine map of them.

    Parameters
    ----------
    points : (n, 3) array
    uv : (n, 2) array
        Distinct parameters.
    triangles : (m, 3) int array
        A disc, perhaps with holes, on all points; anticlockwise in uv and one-to-one.
    gradients : (n, 2, 3) array, optional
        Derivatives in u and in v at the points.

    Returns
    -------
    CloughTocherSurface

    Raises
    ------
    InputError
        If the mesh is no disc, or folds or overlaps in uv.

    References
    ----------
    Nielson 1983, A method for interpolating scattered data based upon a minimum norm network; Renka and Cline 1984, A
    triangle-based C1 interpolation method, section 3.

    Examples
    --------
    >>> uv = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5]])
    >>> fan = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    >>> tent = interpolate_clough_tocher(np.c_[2 * uv, [0, 0, 0, 0, 1]], uv, fan)
    >>> tent.derivatives(np.array([[0.5, 0.5], [1, 0], [2, 0]]))
    array([[ 1.,  1.,  1.],
           [ 2.,  0.,  0.],
           [nan, nan, nan]])
    """
    cloud = check_points(points)
    faces = check_triangles(triangles, len(cloud))
    plane = check_uv(uv, len(cloud))
    _check_map(cloud, plane, faces)
    faces = faces[morton_order(plane[faces].mean(axis=1))]
    edges = half_edges(faces, len(cloud))
    slopes = _least_bent(cloud, plane, edges) if gradients is None else _checked_gradients(gradients, len(cloud))
    flat = np.column_stack([plane, np.zeros(len(plane))])
    boxes = box_tree(*(flat[corners] for corners in faces.T))
    return CloughTocherSurface(cloud, plane, faces, slopes, _crossings(plane, faces, edges), boxes)


def _check_map(points: Points, uv: UV, triangles: Triangles) -> None:
    """Check that triangles cover a disc of the plane once, perhaps with holes."""
    holes = max(len(boundary_loops(half_edges(triangles, len(points)))) - 1, 0)
    certificate = certify(points, triangles, uv=uv, spacing=np.ones(len(points)), holes=holes)
    if certificate.coinciding_uv:
        raise InputError(
            "points {doubled} share their parameters with others, so the surface would be in two places at once; "
            "separate them or remove one of each",
            doubled=coinciding(uv),
        )
    if certificate.flat_or_folded_uv:
        folded = np.flatnonzero(orientation_signs(uv, triangles) <= 0)
        raise InputError(
            f"triangles {name_some(folded)} of {len(triangles)} are flat or clockwise in uv, so the surface would fold "
            "back; use parameters that map the mesh one-to-one, or turn the triangles round"
        )
    if not certificate.is_one_to_one:
        faults = "; ".join(certificate.faults) or f"{certificate.boundary_loops} boundary loops cross or overlap in uv"
        raise InputError(f"the mesh does not cover a part of the plane once: {faults}; give a disc that is one-to-one")


def _checked_gradients(gradients: ArrayLike, n_points: int) -> Floats:
    array = np.ascontiguousarray(gradients, dtype=np.float64)
    if array.shape != (n_points, 2, 3) or not np.isfinite(array).all():
        raise InputError(
            f"gradients have shape {array.shape} or are not finite; give ({n_points}, 2, 3): the derivatives in u and "
            "in v of each point"
        )
    return array


def _least_bent(points: Points, uv: UV, edges: HalfEdges) -> Floats:
    """Return the gradients of the least bent network of cubics along the edges, (n, 2, 3).

    With slopes p and q at the ends of an edge of length L, along which the points differ by d, the cubic bends by
    4 (p^2 + p q + q^2 - 3 d (p + q) + 3 d^2) / L^3. As p q lies between -(p^2 + q^2) / 2 and half that sum, the blocks
    of the points precondition the system to eigenvalues from 1/2 to 3/2, on any mesh.
    """
    ends, lengths = edge_lengths(uv, edges)
    steps = uv[ends[:, 1]] - uv[ends[:, 0]]
    weight = lengths[:, None] ** -1.5  # its square is the 1 / L^3 of the bend
    at_start, at_end = (_slopes(weight * steps, ends[:, side], len(points)) for side in (0, 1))
    network = at_start + at_end
    matrix = sp.csr_array(at_start.T @ at_start + at_end.T @ at_end + network.T @ network)
    right = 3.0 * (network.T @ (weight * (points[ends[:, 1]] - points[ends[:, 0]])))
    return _chebyshev(matrix, right, _inverse_blocks(steps / lengths[:, None], lengths, ends, len(points)))


def _slopes(steps: Floats, ends: Indices, n_points: int) -> sp.csr_array:
    """Return the matrix that takes gradients to slopes along steps at their ends."""
    columns = np.column_stack([2 * ends, 2 * ends + 1]).ravel()
    return sp.csr_array((steps.ravel(), columns, np.arange(0, steps.size + 1, 2)), shape=(len(steps), 2 * n_points))


def _inverse_blocks(directions: Floats, lengths: Floats, ends: Indices, n_points: int) -> Floats:
    """Invert the 2 x 2 blocks of the points, (n, 2, 2); a ridge leaves what no edge determines at 0."""
    corners, (x, y) = ends.T.ravel(), np.tile(directions, (2, 1)).T
    weight = np.tile(2.0 / lengths, 2)
    xx, xy, yy = (np.bincount(corners, weight * part, n_points) for part in (x * x, x * y, y * y))
    ridge = RIDGE * (xx + yy)
    xx, yy = xx + ridge, yy + ridge
    inverse = np.stack([yy, -xy, -xy, xx]) / (xx * yy - xy * xy)
    return np.asarray(inverse.T.reshape(-1, 2, 2))


def _chebyshev(matrix: sp.csr_array, right: Floats, blocks: Floats) -> Floats:
    """Solve a system whose eigenvalues lie from 1/2 to 3/2 after division by blocks, in a fixed number of steps.

    The answer depends linearly on the right side, which a Krylov method's does not.

    References
    ----------
    Saad 2003, Iterative methods for sparse linear systems, algorithm 12.1.
    """
    residual, shape = right.copy(), (len(blocks), 2, 3)
    solution, rho = np.zeros(shape), 0.5
    step = blocks @ residual.reshape(shape)
    for _ in range(STEPS):
        solution += step
        residual -= matrix @ step.reshape(right.shape)
        following = 1.0 / (4.0 - rho)  # middle 1 and half width 1/2 of the eigenvalues: sigma is 2
        step = following * rho * step + 4.0 * following * (blocks @ residual.reshape(shape))
        rho = following
    return solution


def _crossings(uv: UV, triangles: Triangles, edges: HalfEdges) -> Floats:
    """Return where the line through neighbouring barycentres meets each side, as the share of its first end, (m, 3).

    At the boundary it is the middle.
    """
    barycentres = uv[triangles].mean(axis=1)
    inner = np.flatnonzero(edges.twins > np.arange(len(edges.twins)))
    a, b, own = uv[edges.origins[inner]], uv[edges.targets[inner]], barycentres[inner // 3]
    line = barycentres[edges.twins[inner] // 3] - own
    total, part = _cross(b - a, line), _cross(b - own, line)
    share = np.full(len(edges.twins), 0.5)
    share[inner] = np.divide(part, total, out=np.full(len(inner), 0.5), where=total != 0.0)
    share[edges.twins[inner]] = 1.0 - share[inner]
    return share.reshape(-1, 3)


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
