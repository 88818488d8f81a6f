"""The boundary of a scan, found and ordered without a user."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points
from ..agreement.agreed_surface import AgreedSurface, collect_agreed
from ..errors import InputError, Remedy
from ..points.parts import check_one_piece, strays
from ..points.surroundings import Vicinity, look_around
from ..typing import Floats, Loop, Mask, Points
from .loops import rims, tightened, without_slots
from .orientation import anticlockwise
from .scores import BoundaryScores, score_points
from .steps import step_lengths

MOST_STRAYS = 0.1  # of the points of a boundary: of sparse corners of laser scans 0.01 are taken for strays
LEAST_SHARE = 0.5  # of the length between boundary points: the boundaries found on 15 scans have 0.94 and more
# Of the boundary with slots: found ones have 0.94 and more, in noise of half a spacing 0.91.
SURE_SHARE = 0.8
SLOTTED = 1.25  # times as long a boundary: slots have a quarter of it, as long as a gap that may be a second boundary
SHORTEST = 12.0  # spacings along boundary points: a shorter loop is a gap that a neighbourhood spans


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """A loop that may be a boundary.

    Attributes
    ----------
    loop : (b,) int64
    length : float
        In the unit of the points.
    share : float
        Share of its length between points whose scores speak for a boundary, in [0, 1]: how far it can be trusted.
    """

    loop: Loop
    length: float
    share: float


@dataclass(frozen=True, slots=True, eq=False)
class FoundBoundary:
    """The boundary that was found, and what it was chosen from.

    Attributes
    ----------
    loop : (b,) int64
        Boundary points in order, anticlockwise.
    candidates : list of Candidate
        All loops that the scores support: that of the boundary first, then the others, the best first.
    scores : BoundaryScores
    surface : AgreedSurface
        The triangles on which stars agree, with the loops for rims.
    """

    loop: Loop
    candidates: list[Candidate]
    scores: BoundaryScores
    surface: AgreedSurface

    def nearest_to(self, points: Points, place: Floats) -> int:
        """Return which candidate passes nearest to a place, (3,)."""
        return int(np.argmin([np.linalg.norm(points[c.loop] - place, axis=1).min() for c in self.candidates]))

    def beginning_with(self, k: int) -> "FoundBoundary":
        """Return the same, with candidate k for the boundary."""
        chosen, others = self.candidates[k], self.candidates[:k] + self.candidates[k + 1 :]
        return replace(self, loop=chosen.loop, candidates=[chosen, *others])


def find_boundary(points: ArrayLike, *, vicinity: Vicinity | None = None) -> FoundBoundary:
    """Find the boundary loop of a scan.

    Triangles on which neighbouring stars agree form a surface, whose rims are loops in order: the boundary, gaps of the
    scan, and places where stars disagree. The boundary is the loop with the greatest length between points whose
    scores speak for a boundary.

    Parameters
    ----------
    points : (n, 3) array
        Distinct points.
    vicinity : Vicinity, optional
        If it has been explored already.

    Returns
    -------
    FoundBoundary

    Raises
    ------
    InputError
        If the points fall into several parts, or no loop is found, as on a closed surface.

    Examples
    --------
    >>> from pointchart import shapes
    >>> len(find_boundary(shapes.grid(12, 9).points).loop)
    38
    """
    cloud = check_points(points)
    return search_boundary(cloud, look_around(cloud) if vicinity is None else vicinity)


def search_boundary(cloud: Points, near: Vicinity) -> FoundBoundary:
    """Find the boundary as `find_boundary` does, of points that are known to be right."""
    check_one_piece(cloud, near.around, near.spacing)
    agreed = collect_agreed(near.smoothed, near.star, near.spacing)
    scores = score_points(near.smoothed, near.around, near.star, agreed.triangles, near.spacing, near.sides)
    is_boundary = scores.is_boundary
    surface, found = _with_loops(cloud, near, agreed, is_boundary)
    less = without_slots(near.smoothed, agreed, is_boundary, near)
    if less is not agreed:
        opened, slotted = _with_loops(cloud, near, less, is_boundary)
        if _longest(slotted) >= SLOTTED * _longest(found):
            surface, found = opened, slotted
    scale = float(np.median(near.spacing))
    good = [c for c in found if c.share >= LEAST_SHARE and c.share * c.length >= SHORTEST * scale]
    if not good:
        longest = max((c.share * c.length for c in found if c.share >= LEAST_SHARE), default=0.0)
        raise InputError(
            f"no boundary was found: no loop runs {SHORTEST:.0f} spacings along boundary points (the longest has "
            f"{longest / scale:.1f}), so these {len(cloud)} points are too few or lie on a closed surface; give the "
            "boundary, or cut the scan open"
        )
    good.sort(key=lambda c: -c.share * c.length)
    _check_no_strays(cloud, near, good[0])
    good = [replace(candidate, loop=anticlockwise(cloud, candidate.loop)) for candidate in good]
    return FoundBoundary(good[0].loop, good, scores, surface)


def _with_loops(
    cloud: Points, near: Vicinity, agreed: AgreedSurface, is_boundary: Mask
) -> tuple[AgreedSurface, list[Candidate]]:
    """Draw the rims of a surface tight, and measure them."""
    surface = tightened(near.smoothed, agreed, is_boundary)
    return surface, [measure(cloud, loop, is_boundary) for loop in rims(surface)]


def _longest(found: list[Candidate]) -> float:
    """Return the greatest length along boundary points of a loop that is sure to be one."""
    return max((c.share * c.length for c in found if c.share >= SURE_SHARE), default=0.0)


def _check_no_strays(cloud: Points, near: Vicinity, chosen: Candidate) -> None:
    """Check that the boundary does not run through strays, but for a few.

    Raises
    ------
    InputError
        Naming them.
    """
    is_stray = strays(cloud, near.around, near.spacing)
    if not is_stray.any():
        return
    n_on_loop = int(np.count_nonzero(is_stray[chosen.loop]))
    if n_on_loop < MOST_STRAYS * len(chosen.loop):
        return
    apart = float(np.median(near.spacing[is_stray]) / np.median(near.spacing))
    raise InputError(
        f"{np.count_nonzero(is_stray)} of the points are {apart:.0f} times as far apart as the others ({{strays}}), "
        f"and the boundary runs through {n_on_loop} of them: flying pixels or strays",
        remedies=(Remedy.take_the_largest_part, Remedy.give_the_boundary),
        strays=np.flatnonzero(is_stray),
    )


def measure(points: Points, loop: Loop, is_boundary: Mask) -> Candidate:
    """Measure the length of a loop and the share of it that runs between boundary points."""
    steps = step_lengths(points, loop)
    marked = is_boundary[loop] & is_boundary[np.roll(loop, -1)]
    return Candidate(loop, float(steps.sum()), float(steps[marked].sum() / steps.sum()))
