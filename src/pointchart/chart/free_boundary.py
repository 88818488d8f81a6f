"""The free-boundary map of a mesh: the least symmetric Dirichlet energy, without a flip and without an overlap."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_loop, check_points, check_triangles
from ..errors import InputError
from ..map.convex_combination import Parameterization
from ..mesh.make import Meshed
from ..plane.exact_signs import is_simple, orientation_signs
from ..solve.systems import Solution, Solver
from ..typing import UV, Floats, Loop, Mask, Points, Triangles
from .dirichlet_energy import FlatTriangles, NewtonSystem, cross
from .low_stretch import uv_low_stretch
from .on_mesh import is_positive
from .rule import Chart

MOST_STEPS = 100  # of Newton's method, a cap: eight real scans take 4 to 43
LEAST_ENERGY = 4.0  # of an isometry
STEADY = 1e-3  # share of the energy over the least that the next step promises, under which it is not worth its solve
NEGLIGIBLE = 1e-10  # energy that is no distortion
CAUTION = 0.9  # of the way to where the first triangle goes flat
SUFFICIENT = 1e-4  # share of the promised decrease that a step has to keep, after Armijo
MOST_HALVINGS = 40  # to 1e-12 of the step, under which parameters hardly change in their digits


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


@partial(Chart, name="with a free boundary, in the unit of the scan")
def uv_free_boundary(
    points: Points, loop: Loop, boundary_uv: UV, meshed: Meshed, solver: Solver | None
) -> Parameterization:
    """Map the mesh with a free boundary and the least distortion of lengths, one-to-one: for texturing.

    Lengths, angles and areas are all kept as well as may be (symmetric Dirichlet energy), from the map of
    `uv_low_stretch`; a developable surface comes out isometric. The parameters have the area of the surface.

    Parameters
    ----------
    points, loop, boundary_uv, meshed, solver
        See `uv_on_mesh`; the domain and the solver serve for the start only.

    Returns
    -------
    Parameterization
        One-to-one; the start itself, where that is not.

    References
    ----------
    Smith and Schaefer 2015, Bijective parameterization with free boundaries.
    """
    triangles = meshed.swapped.triangles
    start = uv_low_stretch(points, loop, boundary_uv, meshed, solver)
    if not is_positive(start.uv, triangles):
        return start
    flattened = minimize_dirichlet(points, triangles, loop, start.uv)
    return Parameterization(flattened.uv, loop, flattened.solution)


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
    surface = FlatTriangles.of(cloud, faces)
    uv = surface.fitted(_checked_start(start, len(cloud), faces, rim))
    system = NewtonSystem.of(faces, surface)
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


def _searched(surface: FlatTriangles, loop: Loop, uv: UV, step: UV, slope: float, energy: float) -> UV | None:
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
    a, b, c = cross(f1, f2), cross(e1, f2) + cross(f1, e2), cross(e1, e2)
    discriminant = b * b - 4.0 * a * c
    # 2 c / (root - b) is the least positive root without cancellation, if there is one.
    divisor = np.sqrt(np.maximum(discriminant, 0.0)) - b
    is_reached = (discriminant >= 0.0) & (divisor > 0.0)
    return float((2.0 * c[is_reached] / divisor[is_reached]).min(initial=np.inf))


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
