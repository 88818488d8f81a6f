"""The splines of discs, of fifth powers of distances: their systems, solved in blocks."""

from math import pi

import numpy as np
from threadpoolctl import threadpool_limits

from .._parallel import over_ranges
from ..errors import SolveError
from ..solve.krylov import ONE_THREAD
from ..typing import Floats, Indices, Points

BLOCK = 64  # discs whose matrices are held at once: some megabytes
LARGEST_MISS = 1e-8  # of the extent of the points of a disc


def solve_splines(points: Points, members: Indices, centers: Floats, smoothing: float) -> Floats:
    """Solve for the coefficients of the spline of each disc, (d, k + 6, 3)."""
    n_discs, k = members.shape
    # The transform of r^5 is -450 pi / w^7, so a wave of frequency w is halved by this multiple of the bending.
    multiple = 450.0 * pi * (smoothing / (2.0 * pi)) ** 7
    coefficients, miss = np.empty((n_discs, k + 6, 3)), np.empty((n_discs, k))

    def solve(first: int, last: int) -> None:
        for start in range(first, last, BLOCK):
            block = slice(start, min(start + BLOCK, last))
            coefficients[block], miss[block] = _solve_block(points[members[block]], centers[block], multiple)

    # The matrices are too small for threads of the linear algebra to pay: the discs have theirs.
    with ONE_THREAD, threadpool_limits(1):
        over_ranges(solve, n_discs)
    if not miss.max() <= LARGEST_MISS:
        raise _missed(miss, members, centers)
    return coefficients


def _missed(miss: Floats, members: Indices, centers: Floats) -> SolveError:
    """Name a point that the surface misses most, and the closest two parameters of such discs."""
    worst = np.argsort(-miss.max(axis=1), kind="stable")[:BLOCK]
    worst = worst[miss[worst].max(axis=1) > LARGEST_MISS]
    gaps = np.linalg.norm(centers[worst, :, None] - centers[worst, None], axis=3)
    gaps[:, np.arange(centers.shape[1]), np.arange(centers.shape[1])] = np.inf
    d, i, j = np.unravel_index(np.argmin(gaps), gaps.shape)
    return SolveError(
        f"the surface misses point {{missed}} by {miss.max():.2g} of the extent of its disc, because the parameters of "
        f"points {{close}} are only {gaps[d, i, j]:.2g} spacings apart; separate them, or use some smoothing",
        missed=members.flat[np.argmax(miss)],
        close=members[worst[d], [i, j]],
    )


def _solve_block(near: Floats, centers: Floats, multiple: float) -> tuple[Floats, Floats]:
    """Return the coefficients of a few discs, and how far they miss their system, over the extent of the points."""
    count, k, _ = centers.shape
    matrix, right = np.zeros((count, k + 6, k + 6)), np.zeros((count, k + 6, 3))
    difference = centers[:, :, None] - centers[:, None]
    # Minus r^5 is positive on what quadratics leave (Wendland 2005, chapter 8), so the multiple adds to it.
    matrix[:, :k, :k] = multiple * np.eye(k) - np.einsum("...x,...x", difference, difference) ** 2.5
    matrix[:, :k, k:] = quadratics(centers)
    matrix[:, k:, :k] = matrix[:, :k, k:].swapaxes(1, 2)
    middle = near.mean(axis=1)
    right[:, :k] = near - middle[:, None]
    try:
        solution = np.linalg.solve(matrix, right)
    except np.linalg.LinAlgError:
        return np.zeros_like(right), np.full((count, k), np.inf)
    extent = np.abs(right).max(axis=(1, 2))[:, None]
    miss = np.linalg.norm(right - matrix @ solution, axis=2)[:, :k] / np.where(extent > 0.0, extent, 1.0)
    solution[:, k] += middle
    solution[:, :k] *= -1.0
    return solution, miss


def quadratics(places: Floats) -> Floats:
    """Return 1, u, v, u^2, u v and v^2 at places, (..., 6)."""
    u, v = places[..., 0], places[..., 1]
    return np.stack([np.ones_like(u), u, v, u * u, u * v, v * v], axis=-1)
