"""The symmetric Dirichlet energy of a map, its derivatives, and Newton's steps to less of it."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ..mesh.quality import area_vectors
from ..plane.vectors import cross
from ..solve.factors import Direct
from ..solve.systems import Solution
from ..typing import UV, Floats, Indices, Points, Triangles

ANCHOR = 1e-4  # holds place and turn, which the energy leaves free; small against the stiffness of a surface of area 1
LEAST_HEIGHT = 1e-6  # of a triangle over its first edge, in lengths of that edge


@dataclass(frozen=True, slots=True, eq=False)
class FlatTriangles:
    """The triangles of a surface of area 1, each laid flat.

    `gradients` (m, 3, 2) are those of the hat functions of the corners, `areas` (m,) sum to 1, and `size` is the root
    of the area that the surface has.
    """

    triangles: Triangles
    gradients: Floats
    areas: Floats
    size: float

    @classmethod
    def of(cls, points: Points, triangles: Triangles) -> "FlatTriangles":
        """Lay the triangles of a mesh flat."""
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
        determinants = cross(jacobians[:, 0], jacobians[:, 1])
        squares = self.areas * (jacobians * jacobians).sum(axis=(1, 2))
        if not (determinants > 0.0).all():
            return float(squares.sum()), float("inf")
        with np.errstate(over="ignore"):
            return float(squares.sum()), float((squares / determinants / determinants).sum())

    def energy(self, uv: UV) -> float:
        """Return the energy of the map and of its inverse, together."""
        return sum(self.parts(uv))

    def fitted(self, uv: UV) -> UV:
        """Scale parameters to their least energy: that of the map and that of its inverse are then equal."""
        forth, back = self.parts(uv)
        return uv * (back / forth) ** 0.25 if np.isfinite(back) else uv

    def as_large(self, uv: UV) -> UV:
        """Scale parameters to the area of the surface, in the unit of its points, about their middle."""
        e1, e2 = (uv[self.triangles[:, k]] - uv[self.triangles[:, 0]] for k in (1, 2))
        scale = self.size / float(np.sqrt(0.5 * np.abs(cross(e1, e2)).sum()))
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
class NewtonSystem:
    """Where the 36 second derivatives of each triangle go in the sparse matrix of all parameters, 2 for each point."""

    unknowns: Indices
    entries: Indices
    columns: Indices
    indptr: Indices
    diagonal: Indices
    anchor: Floats
    solver: Direct

    @classmethod
    def of(cls, triangles: Triangles, surface: FlatTriangles) -> "NewtonSystem":
        """Find the places of the second derivatives, once for all steps."""
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

    def newton_step(self, surface: FlatTriangles, uv: UV) -> tuple[UV, float, Solution]:
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
