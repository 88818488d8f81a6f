"""Points that lie in lines: profiles of a scanner, contour lines."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from scipy.spatial import cKDTree

from ..errors import PointchartError, Remedy, SolveError
from ..typing import Points

# A point lies in a line if its six nearest do, but for a fifth of their spread across: of even points three in a
# thousand do by chance, of profiles with six times the density along, all.
NEAR, THIN = 6, 0.2
MOST = 0.5  # of all points, from which on they lie in lines: on scans of surfaces up to 0.12 do, at edges and seams
DENSE = 6.0  # times along lines than across: up to that meshes stand, so that there is another cause
_SAMPLE, _AROUND = 500, 80  # points looked at, and neighbours among which those of the next line are looked for


def density_along(points: Points) -> float | None:
    """Return how many times denser points are along lines than across; None if they do not lie in lines.

    Examples
    --------
    >>> x, y = np.meshgrid(np.arange(100.0), 8.0 * np.arange(9))
    >>> float(density_along(np.column_stack([x.ravel(), y.ravel(), np.zeros(900)])))
    8.0
    >>> density_along(np.column_stack([x.ravel(), y.ravel() / 8, np.zeros(900)]))
    """
    if len(points) <= _AROUND:
        return None
    sample = points[:: max(1, len(points) // _SAMPLE)]
    distances, nearest = cKDTree(points).query(sample, k=_AROUND)
    offsets = points[nearest] - sample[:, None]
    _, spreads, directions = np.linalg.svd(offsets[:, 1 : NEAR + 1], full_matrices=False)
    is_on_line = spreads[:, 1] < THIN * spreads[:, 0]
    if np.mean(is_on_line) < MOST:
        return None
    along = np.abs(np.einsum("nkd,nd->nk", offsets, directions[:, 0]))
    is_across = along < 0.5 * distances
    is_across[:, 0] = False
    has_next = is_on_line & is_across.any(axis=1)
    if not has_next.any():
        return float(_AROUND) / 2.0
    across = np.where(is_across, distances, np.inf).min(axis=1)
    return float(np.median(across[has_next] / distances[has_next, 1]))


@contextmanager
def lines_told(points: Points) -> Iterator[None]:
    """Name lines as the cause if the body fails on points that lie in lines."""
    try:
        yield
    except PointchartError:
        ratio = density_along(points)
        if ratio is None or ratio <= DENSE:
            raise
        raise SolveError(
            f"the points lie in lines, {ratio:.0f} times denser along them than across, which does not tell the "
            "surface between them; thin them along the lines to a quarter of that or less",
            remedies=[Remedy.take_heights],
        ) from None
