"""Whether a mesh may stand: which of its bridges lie over gaps of the scan, and what becomes of those."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .bridges import Bridge
from .errors import SolveError
from .typing import Indices, Loop, Points

SECOND_BOUNDARY = 0.25  # a gap with this share of the boundary's length may as well be the boundary
SECOND_SPACINGS = 24.0  # but a shorter one is a gap of the sampling, however short the boundary is
TORN_SPACINGS = 24.0  # rim of a bridge on a clear surface without a gap, from which on the surface is no disc
MESSY_SPACINGS = 60.0  # the same where stars dispute their links: close sheets are meshed wrongly there, on a disc too
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
    """

    points: Points
    loop: Loop
    gaps: list[Bridge]

    @property
    def length(self) -> float:
        """Length of the boundary, in the unit of the points."""
        return float(np.linalg.norm(self.points[np.roll(self.loop, -1)] - self.points[self.loop], axis=1).sum())

    @property
    def second_boundaries(self) -> list[Bridge]:
        """The gaps that may as well be the boundary: a quarter as long or more, and no matter of sampling."""
        least = SECOND_BOUNDARY * self.length
        return [gap for gap in self.gaps if gap.rim_length >= least and gap.rim_in_spacings >= SECOND_SPACINGS]


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
    second = rims.second_boundaries[0]
    raise SolveError(
        f"the surface has a second boundary, so it is no disc: besides the loop of {len(rims.loop)} points, "
        f"{rims.length:.4g} long, through point {{here}} at {_place(rims.points, rims.loop[0])}, there is a gap of "
        f"{len(second.points)} points, {second.rim_length:.4g} long, through point {{there}} at "
        f"{_place(rims.points, second.points[0])}; bridge it (--holes bridge), leave it open (--holes open), say which "
        "is the outer one (--outer x,y,z), or give the boundary (--boundary)",
        here=rims.loop[0],
        there=second.points[0],
    )


def bridge_gaps(rims: Rims) -> list[Bridge]:
    """Bridge all gaps: the rule if the boundary was given."""
    return []


def leave_gaps_open(rims: Rims) -> list[Bridge]:
    """Leave all gaps open: the mesh is a disc with a hole for each."""
    return rims.gaps


def check_torn(points: Points, bridges: Sequence[Bridge], disputed: Indices, *, least: float = 0.0) -> None:
    """Check that a mesh is nowhere torn: that it bridges no large place where the scan has no gap.

    Parameters
    ----------
    points : (n, 3) array
    bridges : sequence of Bridge
    disputed : (n,) int array
        Disputed links of each point: where sheets are close, some bridges are bad places of a disc.
    least : float
        Length of a rim that is to count, in the unit of the points.

    Raises
    ------
    SolveError
    """
    torn = [
        bridge
        for bridge in bridges
        if not bridge.is_gap
        and bridge.rim_length >= least
        and bridge.rim_in_spacings >= (TORN_SPACINGS if disputed[bridge.points].mean() <= CLEAR else MESSY_SPACINGS)
    ]
    if torn:
        worst = torn[0]
        raise SolveError(
            f"the surface is no disc: {len(worst.points)} points round point {{there}} at "
            f"{_place(points, worst.points[0])} are joined by edges of over four spacings, "
            f"{worst.rim_in_spacings:.0f} spacings round, although the scan has no gap there, as on a handle, a twist, "
            "a part so long that its map collapses, or with a false boundary; cut the scan there, or give the boundary",
            there=worst.points[0],
        )


def _place(points: Points, index: int) -> str:
    return "(" + ", ".join(f"{x:.6g}" for x in points[index]) + ")"
