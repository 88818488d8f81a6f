"""Whether a mesh may stand: which of its bridges lie over gaps of the scan, and what becomes of those."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .bridges import Bridge
from .errors import SolveError
from .typing import Indices, Loop, Points, Triangles

SECOND_BOUNDARY = 0.25  # a gap with this share of the boundary's length may as well be the boundary
SECOND_SPACINGS = 24.0  # but a shorter one is a gap of the sampling, however short the boundary is
TORN_SPACINGS = 24.0  # rim of a bridge on a clear surface without a gap, from which on the surface is no disc
MESSY_SPACINGS = 60.0  # the same where stars dispute their links: close sheets are meshed wrongly there, on a disc too
MESSY_SHARE = 0.4  # or with this share of the boundary's length
CLEAR = 0.05  # disputed links a point up to which a surface is clear


@dataclass(frozen=True, slots=True, eq=False)
class Rims:
    """The boundary of a mesh and the gaps that it bridges.

    Attributes
    ----------
    points : (n, 3) float64
    loop : (b,) int64
        The boundary.
    gaps : list of Bridge
        The longest rim first.
    others : list of (b,) int64
        Further loops that were found.
    """

    points: Points
    loop: Loop
    gaps: list[Bridge]
    others: list[Loop]

    @property
    def length(self) -> float:
        """Length of the boundary, in the unit of the points."""
        return perimeter(self.points, self.loop)

    @property
    def second_boundaries(self) -> list[Bridge]:
        """The gaps that may as well be the boundary: a quarter as long or more, and no matter of sampling."""
        least = SECOND_BOUNDARY * self.length
        return [gap for gap in self.gaps if gap.rim_length >= least and gap.rim_in_spacings >= SECOND_SPACINGS]

    def loop_round(self, gap: Bridge) -> Loop | None:
        """Return the loop found on which most corners of a gap's bridge lie, or None if there is none."""
        shares = [np.isin(gap.points, loop).mean() for loop in self.others]
        return self.others[int(np.argmax(shares))] if shares and max(shares) > 0.5 else None

    def patches(self, gaps: Sequence[Bridge], triangles: Triangles) -> list[Indices]:
        """Return the triangles of each gap: its bridge, then those with all corners on the loop around it."""
        found = []
        for gap in gaps:
            loop, is_round = self.loop_round(gap), np.zeros(len(self.points), np.bool_)
            is_round[gap.points if loop is None else loop] = True
            fringe = np.setdiff1d(np.flatnonzero(is_round[triangles].all(axis=1)), gap.triangles)
            found.append(np.concatenate([gap.triangles, fringe]))
        return found


GapRule = Callable[[Rims], list[Bridge]]


def refuse_second_boundary(rims: Rims) -> list[Bridge]:
    """Bridge all gaps, but refuse a surface with a second boundary: the rule if the boundary was found.

    Raises
    ------
    SolveError
        Naming both loops.
    """
    if not rims.second_boundaries:
        return []
    gap = rims.second_boundaries[0]
    found = rims.loop_round(gap)
    second, length = (gap.points, gap.rim_length) if found is None else (found, perimeter(rims.points, found))
    raise SolveError(
        f"the surface has a second boundary, so it is no disc: besides the loop of {len(rims.loop)} points, "
        f"{rims.length:.4g} long, through point {{here}} at {place_of(rims.points, rims.loop[0])}, there is one of "
        f"{len(second)} points, {length:.4g} long, through point {{there}} at "
        f"{place_of(rims.points, second[0])}; bridge it (--holes bridge), leave it open (--holes open), say which "
        "is the outer one (--outer x,y,z), or give the boundary (--boundary)",
        here=rims.loop[0],
        there=second[0],
    )


def bridge_gaps(rims: Rims) -> list[Bridge]:
    """Bridge all gaps: the rule if the boundary was given."""
    return []


def leave_gaps_open(rims: Rims) -> list[Bridge]:
    """Leave all gaps open: the mesh is a disc with a hole for each."""
    return rims.gaps


def check_torn(rims: Rims, bridges: Sequence[Bridge], disputed: Indices, *, is_given: bool) -> None:
    """Check that a mesh is nowhere torn: that it bridges no large place where the scan has no gap.

    Parameters
    ----------
    rims : Rims
    bridges : sequence of Bridge
    disputed : (n,) int array
        Disputed links of each point: where sheets are close, some bridges are bad places of a disc.
    is_given : bool
        Whether the boundary was given, which speaks for a disc: then only a bridge with a quarter of its length counts.

    Raises
    ------
    SolveError
    """
    length = rims.length
    for bridge in bridges:
        is_clear = disputed[bridge.points].mean() <= CLEAR or bridge.rim_length >= MESSY_SHARE * length
        if bridge.is_gap or bridge.rim_in_spacings < (TORN_SPACINGS if is_clear else MESSY_SPACINGS):
            continue
        if is_given and bridge.rim_length < SECOND_BOUNDARY * length:
            continue
        raise SolveError(
            f"the surface is no disc: {len(bridge.points)} points round point {{there}} at "
            f"{place_of(rims.points, bridge.points[0])} are joined by edges of over four spacings, "
            f"{bridge.rim_in_spacings:.0f} spacings round, although the scan has no gap there, as on a handle, "
            "a twist, a part so long that its map collapses, or with a false boundary; cut the scan there, or give "
            "the boundary",
            there=bridge.points[0],
        )


def perimeter(points: Points, loop: Loop) -> float:
    """Return the length of a closed loop, in the unit of the points.

    Examples
    --------
    >>> perimeter(np.array([[0.0, 0, 0], [3, 0, 0], [3, 4, 0]]), np.array([0, 1, 2]))
    12.0
    """
    return float(np.linalg.norm(points[np.roll(loop, -1)] - points[loop], axis=1).sum())


def place_of(points: Points, index: int) -> str:
    """Write where a point is.

    Examples
    --------
    >>> place_of(np.array([[0.5, -2.0, 1e6]]), 0)
    '(0.5, -2, 1e+06)'
    """
    return "(" + ", ".join(f"{x:.6g}" for x in points[index]) + ")"
