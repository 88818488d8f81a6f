"""What is worth a word about a boundary, its gaps and a mesh."""

from ..mesh.spanning import SPANNING
from ..pipeline import Reconstruction
from ..points.places import place_of
from ..proof.intersection_places import SelfIntersections
from ..typing import Points
from .checks import counted
from .record import Note

SLOTS = 0.15  # of the area, from which on slots are worth a word: uneven laser scans have up to 0.1 without any


def boundary_notes(result: Reconstruction, points: Points, *, found: bool) -> list[Note]:
    """Say what the boundary is and what was bridged; `points` are those of the vertices."""
    notes = [Note(_boundary(result, found=found))]
    gaps = [bridge for bridge in result.evidence.bridges if bridge.is_gap]
    doubts = [bridge for bridge in result.evidence.bridges if not bridge.is_gap]
    if gaps:
        done = _what_became(len(gaps), result.certificate.holes)
        widest = f"the largest {gaps[0].rim_in_spacings:.0f} spacings round"
        notes.append(Note(f"{counted(len(gaps), 'gap')} of the scan, {done}, {widest}"))
    if doubts:
        first = doubts[0].points[0]
        notes.append(
            Note(
                f"look at {counted(len(doubts), 'place')} that the mesh spans by edges of over four spacings although "
                f"the scan has no gap there, the largest at vertex {first} {place_of(points, first)}"
            )
        )
    return notes


def intersection_notes(found: SelfIntersections) -> list[Note]:
    """Say where a mesh passes through itself; nothing if it does not."""
    n = len(found.places)
    if n == 0:
        return []
    first = place_of(found.places, 0)
    return [Note(f"look at {counted(n, 'place')} where the mesh passes through itself, the first at {first}")]


def slot_notes(n_spanning: int, share: float) -> list[Note]:
    """Say that triangles span slots, if many do; see `spanning_triangles`."""
    if share <= SLOTS:
        return []
    return [
        Note(
            f"look at {n_spanning} triangles with edges of over {SPANNING:g} spacings, {share:.0%} of the area: the "
            "mesh may close narrow slots of the scan"
        )
    ]


def _boundary(result: Reconstruction, *, found: bool) -> str:
    text = f"boundary of {len(result.loop)} points, {'found' if found else 'as given'}"
    failed, n = len(result.evidence.failures), len(result.evidence.candidates)
    if not failed:
        return text
    return text + f", loop {failed + 1} of {n} by its scores: no mesh stood with {failed} before it"


def _what_became(n_gaps: int, n_open: int) -> str:
    if n_open == 0:
        return "bridged"
    rest = " and the others, which touch the boundary or another gap, bridged" if n_open < n_gaps else ""
    return f"{n_open} left open{rest}"
