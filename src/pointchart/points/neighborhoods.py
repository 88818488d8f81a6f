"""Neighbourhoods as compressed rows: unordered, ordered round their centre, and those of Delaunay stars."""

from dataclasses import dataclass

import numpy as np

from .._kernels.unsigned import unsigned
from ..typing import Floats, Indices, Mask


@dataclass(frozen=True, slots=True, eq=False)
class Neighborhoods:
    """The neighbours of every point, row by row (compressed sparse rows).

    Attributes
    ----------
    indptr : (n + 1,) int64
        Point i has the neighbours ``indices[indptr[i]:indptr[i + 1]]``.
    indices : (nnz,) int32 or int64
        Neighbours; never the point itself, none twice in a row.
    """

    indptr: Indices
    indices: Indices

    @property
    def n_points(self) -> int:
        """Number of points."""
        return len(self.indptr) - 1

    @property
    def sizes(self) -> Indices:
        """Number of neighbours of each point, (n,)."""
        return np.diff(self.indptr)

    @property
    def table(self) -> tuple[Indices, Indices]:
        """`indptr` as uint64 and `indices` as uint32, as compiled loops take them; a copy of indices that are int64."""
        return unsigned(np.asarray(self.indptr, np.int64)), unsigned(np.asarray(self.indices, np.int32))

    @property
    def rows(self) -> Indices:
        """The centre of every neighbour, (nnz,)."""
        return np.repeat(np.arange(self.n_points), self.sizes)


@dataclass(frozen=True, slots=True, eq=False)
class Rings(Neighborhoods):
    """Neighbours in order round their centre, anticlockwise, as those along the edges of a mesh are.

    Attributes
    ----------
    is_open : (n,) bool
        Whether a ring has a gap, of at least pi in a star, as it has on the boundary: between its last neighbour and
        its first.
    """

    is_open: Mask


@dataclass(frozen=True, slots=True, eq=False)
class Stars(Rings):
    """Delaunay neighbours in the tangent plane of each point.

    Attributes
    ----------
    width : (n,) float64
        The largest radius of a circle through the centre and two neighbours that follow each other; infinite if the
        star is open.
    """

    width: Floats


@dataclass(frozen=True, slots=True, eq=False)
class PlanarStars(Stars):
    """Delaunay stars with the positions of the neighbours in the tangent plane of their centre.

    Attributes
    ----------
    local : (nnz, 2) float64
    """

    local: Floats


def from_pairs(rows: Indices, columns: Indices, n_points: int) -> Neighborhoods:
    """Gather (centre, neighbour) pairs, sorted by centre, into neighbourhoods."""
    indptr = np.zeros(n_points + 1, np.int64)
    np.cumsum(np.bincount(rows, minlength=n_points), out=indptr[1:])
    return Neighborhoods(indptr, np.ascontiguousarray(columns, dtype=np.int64))


def rectangular(found: Indices) -> Neighborhoods:
    """Make neighbourhoods of the same number of neighbours for each point, (n, k)."""
    n, k = found.shape
    return Neighborhoods(np.arange(0, n * k + 1, k), found.ravel())
