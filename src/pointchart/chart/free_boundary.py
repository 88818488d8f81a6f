"""The free-boundary map of a mesh: the least symmetric Dirichlet energy, without a flip and without an overlap."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike

from .._check import check_loop, check_points, check_triangles
from ..errors import InputError
from ..mesh.quality import area_vectors
from ..plane.exact_signs import is_simple, orientation_signs
from ..solve.systems import Direct, Solution
from ..typing import UV, Floats, Indices, Loop, Mask, Points, Triangles

MOST_STEPS = 100
LEAST_ENERGY = 4.0  # of an isometry
STEADY = 1e-3  # share of the energy over the least that the next step promises, under which it is not worth its solve
NEGLIGIBLE = 1e-10  # energy that is no distortion
CAUTION = 0.9  # of the way to where the first triangle goes flat
SUFFICIENT = 1e-4  # share of the promised decrease that a step has to keep, after Armijo
MOST_HALVINGS = 40
ANCHOR = 1e-4  # holds place and turn, which the energy leaves free; small against the stiffness of a surface of area 1
LEAST_HEIGHT = 1e-6  # of a triangle over its first edge, in lengths of that edge


@dataclass(frozen=True, slots=True, eq=False)
class Flattened:
    """A map of least distortion with a free boundary.

    Attributes
    ----------
    uv : (n, 2) float64
        Its triangles have the total area that the surface has, in the unit of the points.
    energies : tuple of float
        Of the start and after each step, falling; 4 for an isometry.
    solution : Solution
        The last step's linear system; `iterations` holds the number of steps.
    """

    uv: UV
    energies: tuple[float, ...]
    solution: Solution


def minimize_dirichlet(
    points: ArrayLike, triangles: ArrayLike, loop: ArrayLike, start: UV, *, most_steps: int = MOST_STEPS
) -> Flattened:
    r"""Move all parameters, those of the boundary too, to the least symmetric Dirichlet energy near a start.

    .. math:: E = \frac{1}{A} \sum_t A_t \left(\sigma_1^2 + \sigma_2^2 + \sigma_1^{-2} + \sigma_2^{-2}\right)

    with the singular values of the map from each triangle of the surface to the plane. Newton's method descends, with
    the negative curvature of each triangle taken out. No step reaches the place where a first triangle goes flat, and
    none is taken after which the boundary crosses itself: positive triangles inside a simple polygon are one-to-one.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
        A disc, anticlockwise.
    loop : (b,) int array
        Its boundary.
    start : (n, 2) array
        One-to-one, at any scale.
    most_steps : int

    Returns
    -------
    Flattened

    Raises
    ------
    InputError
        If a triangle of the start is flat or turned over, or its boundary crosses itself.

    References
    ----------
    Smith and Schaefer 2015, Bijective parameterization with free boundaries, sections 3 and 4. Smith, de Goes and Kim
    2019, Analytic eigensystems for isotropic distortion energies, section 4.

    Examples
    --------
    >>> bent = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 1]]
    >>> flat = minimize_dirichlet(bent, [[0, 1, 2], [0, 2, 3]], [0, 1, 2, 3], [[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> round(flat.energies[-1], 3)
    4.0
    """
    cloud = check_points(points)
    faces = check_triangles(triangles, len(cloud))
    rim = check_loop(loop, len(cloud))
    unused = np.setdiff1d(np.arange(len(cloud)), faces)
    if len(unused):
        raise InputError("points {unused} are in no triangle, so nothing places them; take them out", unused=unused)
    surface = _Surface.of(cloud, faces)
    uv = surface.fitted(_checked_start(start, len(cloud), faces, rim))
    system = _System.of(faces, surface)
    energies, solution = [surface.energy(uv)], Solution(uv, 0.0, (), "none", 0, 0)
    while len(energies) <= most_steps:
        step, slope, solution = system.newton_step(surface, uv)
        if not -0.5 * slope > STEADY * (energies[-1] - LEAST_ENERGY) + NEGLIGIBLE:
            break
        moved = _searched(surface, rim, uv, step, slope, energies[-1])
        if moved is None:
            break
        uv = moved
        energies.append(surface.energy(uv))
    placed = surface.as_large(uv)
    evidence = Solution(
        placed,
        solution.residual,
        (len(energies) - 1,),
        "projected_newton",
        solution.unknowns,
        solution.nonzeros,
    )
    return Flattened(placed, tuple(energies), evidence)


@dataclass(frozen=True, slots=True, eq=False)
class _Surface:
    """The triangles of a surface of area 1, each laid flat.

    `gradients` (m, 3, 2) are those of the hat functions of the corners, `areas` (m,) sum to 1, and `size` is the root
    of the area that the surface has.
    """

    triangles: Triangles
    gradients: Floats
    areas: Floats
    size: float

    @classmethod
    def of(cls, points: Points, triangles: Triangles) -> "_Surface":
        size = float(np.sqrt(np.linalg.norm(area_vectors(points, triangles), axis=1).sum()))
        corner = points[triangles] / size
        e1, e2 = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
        length = np.linalg.norm(e1, axis=1)
        along = np.einsum("ij,ij->i", e1, e2) / length
        # A triangle that is flat in space has no shape that a map could keep.
        height = np.maximum(np.linalg.norm(np.cross(e1, e2), axis=1) / length, LEAST_HEIGHT * length)
        gradients = np.zeros((len(triangles), 3, 2))
        gradients[:, 1, 0] = 1.0 / length
        gradients[:, 1, 1] = -along / (length * height)
        gradients[:, 2, 1] = 1.0 / height
        gradients[:, 0] = -gradients[:, 1] - gradients[:, 2]
        areas = length * height
        return cls(triangles, gradients, areas / areas.sum(), size)

    def jacobians(self, uv: UV) -> Floats:
        """Return the derivative of the map from each flat triangle to the plane, (m, 2, 2)."""
        corner, gradients = uv[self.triangles], self.gradients
        edges = (corner[:, k] - corner[:, 0] for k in (1, 2))
        return np.asarray(sum(e[:, :, None] * gradients[:, k, None, :] for k, e in enumerate(edges, 1)))

    def parts(self, uv: UV) -> tuple[float, float]:
        """Return the energy of the map and that of its inverse; infinite where a triangle is not positive."""
        jacobians = self.jacobians(uv)
        determinants = jacobians[:, 0, 0] * jacobians[:, 1, 1] - jacobians[:, 0, 1] * jacobians[:, 1, 0]
        squares = self.areas * (jacobians * jacobians).sum(axis=(1, 2))
        if not (determinants > 0.0).all():
            return float(squares.sum()), float("inf")
        with np.errstate(over="ignore"):
            return float(squares.sum()), float((squares / determinants / determinants).sum())

    def energy(self, uv: UV) -> float:
        return sum(self.parts(uv))

    def fitted(self, uv: UV) -> UV:
        """Scale parameters to their least energy: that of the map and that of its inverse are then equal."""
        forth, back = self.parts(uv)
        return uv * (back / forth) ** 0.25 if np.isfinite(back) else uv

    def as_large(self, uv: UV) -> UV:
        """Scale parameters to the area of the surface, in the unit of its points, about their middle."""
        e1, e2 = (uv[self.triangles[:, k]] - uv[self.triangles[:, 0]] for k in (1, 2))
        scale = self.size / float(np.sqrt(0.5 * np.abs(_cross(e1, e2)).sum()))
        return np.asarray((uv - uv.mean(axis=0)) * scale)

    def modes(self, uv: UV) -> tuple[Floats, Floats, Floats]:
        """Split each triangle's energy, as a function of its 6 parameters, into four directions.

        Returns
        -------
        directions : (m, 4, 6) array
            Both stretches, the turn, and the flip: the eigenvectors of the second derivative.
        curvatures : (m, 4) array
            Its eigenvalues, the negative ones as 0; only that of the turn can be.
        slopes : (m, 6) array
            First derivative.
        """
        (a, b), (c, d) = np.moveaxis(self.jacobians(uv), 0, -1)
        difference, total = np.arctan2(c + b, a - d), np.arctan2(c - b, a + d)
        left, right = (total + difference) / 2.0, (total - difference) / 2.0
        s1 = (np.hypot(a + d, c - b) + np.hypot(a - d, c + b)) / 2.0
        s2 = (a * d - b * c) / s1
        u1, u2 = _axes(left)
        g1, g2 = ((self.gradients @ axis[:, :, None])[:, :, 0] for axis in _axes(-right))
        first, second = _moved(u1, g1), _moved(u2, g2)
        across, back = _moved(u2, g1), _moved(u1, g2)
        turn, flip = (across - back) / np.sqrt(2.0), (across + back) / np.sqrt(2.0)
        p1, p2 = 2.0 * s1 - 2.0 * s1**-3, 2.0 * s2 - 2.0 * s2**-3
        of_flip = 2.0 + 2.0 * (s1 * s1 + s1 * s2 + s2 * s2) / (s1 * s2) ** 3
        of_turn = np.maximum((p1 + p2) / (s1 + s2), 0.0)
        curvatures = np.stack([2.0 + 6.0 * s1**-4, 2.0 + 6.0 * s2**-4, of_turn, of_flip], axis=1)
        slopes = p1[:, None] * first + p2[:, None] * second
        return np.stack([first, second, turn, flip], axis=1), curvatures, slopes


def _axes(angle: Floats) -> tuple[Floats, Floats]:
    """Return the axes of the plane turned by each angle."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=1), np.stack([-np.sin(angle), np.cos(angle)], axis=1)


def _moved(axis: Floats, weights: Floats) -> Floats:
    """Return the direction in which each corner of a triangle moves along an axis as its weight says, (m, 6)."""
    return np.asarray((weights[:, :, None] * axis[:, None, :]).reshape(len(axis), 6))


@dataclass(frozen=True, slots=True, eq=False)
class _System:
    """Where the 36 second derivatives of each triangle go in the sparse matrix of all parameters, 2 for each point."""

    unknowns: Indices
    entries: Indices
    columns: Indices
    indptr: Indices
    diagonal: Indices
    anchor: Floats
    solver: Direct

    @classmethod
    def of(cls, triangles: Triangles, surface: _Surface) -> "_System":
        size = 2 * (int(triangles.max()) + 1)
        unknowns = (2 * triangles[:, :, None] + np.arange(2)).reshape(-1, 6)
        keys = np.repeat(unknowns, 6, axis=1) * size + np.tile(unknowns, (1, 6))
        places, entries = np.unique(keys.ravel(), return_inverse=True)
        rows, columns = np.divmod(places, size)
        indptr = np.searchsorted(rows, np.arange(size + 1))
        anchor = np.asarray(
            np.bincount(unknowns.ravel(), np.repeat(ANCHOR / 3.0 * surface.areas, 6), size), dtype=np.float64
        )
        diagonal = np.flatnonzero(rows == columns)
        return cls(unknowns, entries, columns, indptr, diagonal, anchor, Direct())

    def newton_step(self, surface: _Surface, uv: UV) -> tuple[UV, float, Solution]:
        """Return the step, the slope of the energy along it, and how well its system was solved."""
        directions, curvatures, slopes = surface.modes(uv)
        weighted = directions * np.sqrt(curvatures * surface.areas[:, None])[:, :, None]
        second = (np.swapaxes(weighted, 1, 2) @ weighted).ravel()
        values = np.bincount(self.entries, second, len(self.columns)).astype(np.float64)
        values[self.diagonal] += self.anchor
        size = len(self.anchor)
        matrix = sp.csr_array((values, self.columns, self.indptr), shape=(size, size))
        pull = np.bincount(self.unknowns.ravel(), (surface.areas[:, None] * slopes).ravel(), size)
        downhill = -pull.astype(np.float64)
        step = self.solver(matrix, downhill[:, None])[0][:, 0]
        steepness = float(np.linalg.norm(downhill))
        residual = float(np.linalg.norm(downhill - matrix @ step)) / (steepness if steepness > 0.0 else 1.0)
        places = step.reshape(-1, 2)
        # Shifting all costs nothing, so the system hardly says how far: it would go anywhere, and digits with it.
        return (
            places - places.mean(axis=0),
            -float(downhill @ step),
            Solution(uv, residual, (), "direct", size, matrix.nnz),
        )


def _searched(surface: _Surface, loop: Loop, uv: UV, step: UV, slope: float, energy: float) -> UV | None:
    """Halve a step until it lowers the energy enough and keeps the map one-to-one; None if no step does."""
    length = min(1.0, CAUTION * first_flat(uv[surface.triangles], step[surface.triangles]))
    for _ in range(MOST_HALVINGS):
        moved = uv + length * step
        if surface.energy(moved) <= energy + SUFFICIENT * length * slope:
            # The digits that are handed back are those that have to pass.
            placed = surface.as_large(moved)
            if (orientation_signs(placed, surface.triangles) > 0).all() and is_simple(placed[loop]):
                return moved
        length /= 2.0
    return None


def first_flat(corners: Floats, steps: Floats) -> float:
    r"""Return how far positive triangles can move before the first one is flat; infinite if none ever is.

    The area of a moving triangle is a quadratic of the time; the least positive root counts.

    Parameters
    ----------
    corners, steps : (m, 3, 2) arrays

    References
    ----------
    Smith and Schaefer 2015, section 3.3.

    Examples
    --------
    >>> triangle, fall = np.array([[[0.0, 0], [1, 0], [0, 4]]]), np.array([[[0.0, 0], [0, 0], [0, -2]]])
    >>> first_flat(triangle, fall), first_flat(triangle, -fall)
    (2.0, inf)
    """
    (e1, e2), (f1, f2) = ((x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]) for x in (corners, steps))
    a, b, c = _cross(f1, f2), _cross(e1, f2) + _cross(f1, e2), _cross(e1, e2)
    discriminant = b * b - 4.0 * a * c
    # 2 c / (root - b) is the least positive root without cancellation, if there is one.
    divisor = np.sqrt(np.maximum(discriminant, 0.0)) - b
    is_reached = (discriminant >= 0.0) & (divisor > 0.0)
    return float((2.0 * c[is_reached] / divisor[is_reached]).min(initial=np.inf))


def _cross(x: Floats, y: Floats) -> Floats:
    return np.asarray(x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0])


def _checked_start(start: UV, n_points: int, triangles: Triangles, loop: Loop) -> UV:
    uv = np.asarray(start, dtype=np.float64)
    if uv.shape != (n_points, 2):
        raise InputError(f"the start has shape {uv.shape}; {n_points} points need ({n_points}, 2)")
    is_folded: Mask = orientation_signs(uv, triangles) <= 0
    if is_folded.any():
        raise InputError(
            f"{is_folded.sum()} triangles of the start are flat or turned over, the first at points {{corners}}, and "
            "the boundary can only be freed of a one-to-one map; start from the map of the mesh to a circle",
            corners=triangles[np.argmax(is_folded)],
        )
    if not is_simple(uv[loop]):
        raise InputError("the boundary of the start crosses itself; start from the map of the mesh to a circle")
    return uv
