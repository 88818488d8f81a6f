"""Whether a mesh may stand: which of its bridges lie over gaps of the scan, and what becomes of those."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..boundary import Candidate, perimeter
from ..errors import Remedy, SolveError
from ..typing import Floats, Indices, Loop, Points, Triangles
from .bridges import Bridge, BridgedPatch

SECOND_BOUNDARY = 0.25  # a gap with this share of the boundary's length may as well be the boundary
SECOND_SPACINGS = 24.0  # but a shorter one is a gap of the sampling, however short the boundary is
SURELY_SECOND = 0.45  # unless it has this share of the boundary's length, and LEAST_SPACINGS
LEAST_SPACINGS = 12.0  # under this, a bridge is a matter of sampling
SURE = 0.75  # share of its length along boundary points that a loop needs to be a second boundary without a bridge
TORN_SPACINGS = 24.0  # rim of a bridge on a clear surface without a gap, from which on the surface is no disc
TORN_IN_ALL = 60.0  # rims together of all clear bridges from LEAST_SPACINGS on
MESSY_SPACINGS = 36.0  # the same where stars dispute their links: close sheets are meshed wrongly there, on a disc too
MESSY_SHARE = 0.4  # or TORN_SPACINGS, with this share of the boundary's length
CLEAR = 0.05  # disputed links a point up to which a surface is clear


@dataclass(frozen=True, slots=True, eq=False)
class BoundaryAndGaps:
    """The boundary of a mesh, the gaps that it bridges, and whether one of them may be the boundary.

    Attributes
    ----------
    points : (n, 3) float64
    spacing : (n,) float64
    loop : (b,) int64
        The boundary.
    length : float
        Length of the boundary, in the unit of the points.
    gaps : list of BridgedPatch
        The longest rim first.
    others : list of Candidate
        Further loops that were found.
    second_boundary : tuple of (c,) int64 array and float, or None
        The points and the length of the longest gap or loop that may as well be the boundary.
    """

    points: Points
    spacing: Floats
    loop: Loop
    length: float
    gaps: list[BridgedPatch]
    others: list[Candidate]
    second_boundary: tuple[Loop, float] | None

    @property
    def is_outgrown(self) -> bool:
        """Whether the second boundary is longer than the boundary, which then is likely a false one."""
        return self.second_boundary is not None and self.second_boundary[1] > self.length

    def patches(self, gaps: Sequence[BridgedPatch], triangles: Triangles) -> list[Indices]:
        """Return the triangles of each gap: its bridge, then those with all corners on the loop around it."""
        found = []
        for gap in gaps:
            loop, is_round = loop_round(gap, self.others), np.zeros(len(self.points), np.bool_)
            is_round[gap.points if loop is None else loop] = True
            fringe = np.setdiff1d(np.flatnonzero(is_round[triangles].all(axis=1)), gap.triangles)
            found.append(np.concatenate([gap.triangles, fringe]))
        return found


def compare_gaps(
    points: Points, spacing: Floats, loop: Loop, gaps: list[BridgedPatch], others: list[Candidate]
) -> BoundaryAndGaps:
    """Look for a second boundary among the gaps of a mesh and the other loops of its scan.

    A gap may be one if it is a quarter as long as the boundary and 24 spacings long, or 0.45 of it and 12. A loop that
    no long edges bridge may be one if it is 0.45 of it, 24 spacings long, and three quarters of it score as boundary:
    between close sheets, the mesh closes it by short edges.

    Parameters
    ----------
    points, spacing, loop, gaps, others
        See `BoundaryAndGaps`.

    Returns
    -------
    BoundaryAndGaps

    Examples
    --------
    >>> square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> found = compare_gaps(square, np.ones(4), np.arange(4), [], [])
    >>> found.length, found.second_boundary
    (4.0, None)
    """
    whole, seconds = perimeter(points, loop), []
    bridged = [loop_round(gap, others) for gap in gaps]
    for gap, around in zip(gaps, bridged, strict=True):
        share, size = gap.rim_length / whole, gap.rim_in_spacings
        if share >= SECOND_BOUNDARY and size >= (LEAST_SPACINGS if share >= SURELY_SECOND else SECOND_SPACINGS):
            known = (gap.points, gap.rim_length)
            seconds.append(known if around is None else (around, perimeter(points, around)))
    for other in others:
        length = perimeter(points, other.loop)
        size = length / float(np.median(spacing[other.loop]))
        is_long = length >= SURELY_SECOND * whole and size >= SECOND_SPACINGS
        if is_long and other.share >= SURE and not any(around is other.loop for around in bridged):
            seconds.append((other.loop, length))
    return BoundaryAndGaps(
        points, spacing, loop, whole, gaps, others, max(seconds, key=lambda second: second[1], default=None)
    )


def loop_round(gap: Bridge, others: Sequence[Candidate]) -> Loop | None:
    """Return the loop on which most corners of a gap's bridge lie, or None if there is none."""
    shares = [np.isin(gap.points, other.loop).mean() for other in others]
    return others[int(np.argmax(shares))].loop if shares and max(shares) > 0.5 else None


GapRule = Callable[[BoundaryAndGaps], list[BridgedPatch]]


def refuse_second_boundary(found: BoundaryAndGaps) -> list[BridgedPatch]:
    """Bridge all gaps, but refuse a surface with a second boundary: the rule if the boundary was found.

    Raises
    ------
    SolveError
        Naming both loops.
    """
    if found.second_boundary is None:
        return []
    second, length = found.second_boundary
    raise SolveError(
        f"the surface has a second boundary, so it is no disc: besides the loop of {len(found.loop)} points, "
        f"{found.length:.4g} long, through point {{here}} at {place_of(found.points, found.loop[0])}, there is one of "
        f"{len(second)} points, {length:.4g} long, through point {{there}} at "
        f"{place_of(found.points, second[0])}",
        remedies=(
            Remedy.bridge_gaps,
            Remedy.leave_gaps_open,
            Remedy.name_the_outer_loop,
            Remedy.give_the_boundary,
        ),
        here=found.loop[0],
        there=second[0],
    )


def bridge_gaps(found: BoundaryAndGaps) -> list[BridgedPatch]:
    """Bridge all gaps: the rule if the boundary was given."""
    return []


def leave_gaps_open(found: BoundaryAndGaps) -> list[BridgedPatch]:
    """Leave all gaps open: the mesh is a disc with a hole for each."""
    return found.gaps


def check_torn(found: BoundaryAndGaps, bridges: Sequence[Bridge], disputed: Indices, *, is_given: bool) -> None:
    """Check that a mesh is nowhere torn: that it bridges no large place where the scan has no gap.

    Parameters
    ----------
    found : BoundaryAndGaps
    bridges : sequence of Bridge
    disputed : (n,) int array
        Disputed links of each point: where sheets are close, some bridges are bad places of a disc.
    is_given : bool
        Whether the boundary was given, which speaks for a disc: then only a bridge with a quarter of its length counts.

    Raises
    ------
    SolveError
        If a bridge that lies over no gap is too long, or all of them together.
    """
    length = found.length
    doubtful = [bridge for bridge in bridges if not bridge.is_gap and bridge.rim_in_spacings >= LEAST_SPACINGS]
    clear = [bridge for bridge in doubtful if disputed[bridge.points].mean() <= CLEAR]
    is_torn_in_all = sum(bridge.rim_in_spacings for bridge in clear) >= TORN_IN_ALL
    torn = [bridge for bridge in clear if is_torn_in_all or bridge.rim_in_spacings >= TORN_SPACINGS]
    torn += [
        bridge
        for bridge in doubtful
        if bridge.rim_in_spacings >= MESSY_SPACINGS
        or (bridge.rim_in_spacings >= TORN_SPACINGS and bridge.rim_length >= MESSY_SHARE * length)
    ]
    least = SECOND_BOUNDARY * length if is_given else 0.0
    remedies = (Remedy.cut_the_scan,) if is_given else (Remedy.cut_the_scan, Remedy.give_the_boundary)
    for bridge in torn:
        if bridge.rim_length >= least:
            raise SolveError(
                f"the surface is no disc: {len(bridge.points)} points round point {{there}} at "
                f"{place_of(found.points, bridge.points[0])} are joined by edges of over four spacings, "
                f"{bridge.rim_in_spacings:.0f} spacings round, although the scan has no gap there, as on a handle, "
                f"a twist, a part so long that its map collapses, or with a false boundary",
                remedies=remedies,
                there=bridge.points[0],
            )


def place_of(points: Points, index: int) -> str:
    """Write where a point is.

    Examples
    --------
    >>> place_of(np.array([[0.5, -2.0, 1e6]]), 0)
    '(0.5, -2, 1000000)'
    """
    return "(" + ", ".join(f"{x:.9g}" for x in points[index]) + ")"
