"""One loop after the other for the boundary, until a mesh is sound."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..agreement.links import disputed_links
from ..boundary.bounded import Survey
from ..boundary.find import Candidate
from ..errors import PointchartError, points_called
from ..mesh.make import Meshed
from ..mesh.swap_rule import Swapped, Swaps
from ..typing import Points
from .bridges import BridgedPatch, find_bridges
from .rules import BoundaryAndGaps, GapRule, check_torn, compare_gaps


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """A sound mesh: it bridges nothing but gaps of the scan.

    Attributes
    ----------
    candidates : list of Candidate
        The boundary, and the other loops that were found.
    meshed : Meshed
    bridges : list of BridgedPatch
        Over gaps, and where the mesh is in doubt; in the unit of the scan.
    around : BoundaryAndGaps
    opened : list of BridgedPatch
        Gaps that shall be open.
    failures : list of PointchartError
        Why better loops did not do, naming rows of the scan.
    """

    candidates: list[Candidate]
    meshed: Meshed
    bridges: list[BridgedPatch]
    around: BoundaryAndGaps
    opened: list[BridgedPatch]
    failures: list[PointchartError]


def first_sound(surveys: Sequence[Survey], rule: GapRule, mesh: Callable[[Survey], Meshed]) -> Trial:
    """Mesh a scan with one loop after the other, until the mesh bridges nothing but gaps.

    A false loop has to be bridged over the true one, which shows as a bridge where there is no gap, or as a gap longer
    than the loop: such a loop is passed over where the rule refuses it, not where the user has gaps bridged or left
    open.

    Parameters
    ----------
    surveys : sequence of Survey
        The same scan with several loops, the best first.
    rule : callable
        What becomes of gaps; see `refuse_second_boundary`.
    mesh : callable
        ``mesh(survey) -> Meshed``.

    Returns
    -------
    Trial

    Raises
    ------
    PointchartError
        If no mesh is sound, why the first is not; or what the rule says of a sound one.
    """
    failures: list[PointchartError] = []
    for survey in surveys:
        try:
            with points_called(survey.cloud.rows):
                trial = check_sound(survey, mesh(survey))
        except PointchartError as failure:
            failures.append(failure)
            continue
        try:
            with points_called(survey.cloud.rows):
                return replace(trial, opened=rule(trial.around), failures=failures)
        except PointchartError as refusal:
            if not trial.around.is_outgrown:
                raise
            failures.append(refusal)
    raise failures[0]


def check_sound(survey: Survey, meshed: Meshed) -> Trial:
    """Check that a mesh bridges nothing but gaps of the scan.

    Raises
    ------
    SolveError
        See `check_torn`.
    """
    points, spacing = survey.points, survey.cloud.scale * survey.vicinity.spacing
    bridges = find_bridges(points, meshed.swapped.triangles, spacing, lambda: survey.score().is_boundary)
    gaps = [bridge for bridge in bridges if bridge.is_gap]
    around = compare_gaps(points, spacing, survey.loop, gaps, survey.candidates[1:])
    if bridges:
        check_torn(around, bridges, disputed_links(survey.vicinity.star), is_given=survey.found is None)
    return Trial(survey.candidates, meshed, bridges, around, [], [])


def swap_on(trial: Trial, points: Points, swaps: Swaps) -> Trial:
    """Swap edges of a sound mesh on from the Delaunay mesh, but not at gaps that will be open; long edges may come.

    A swap that knows nothing of the triangles in a gap could make an edge that they have already, so those at its rim
    stay as they are too.

    Parameters
    ----------
    trial : Trial
    points : (n, 3) array
        In any unit.
    swaps : Swaps

    Returns
    -------
    Trial
        The same, if the rule has nothing to do after the Delaunay swaps.
    """
    if swaps.is_delaunay or not swaps.from_delaunay:
        return trial
    first = trial.meshed.swapped
    is_at_gap = np.zeros(len(points), bool)
    for patch in trial.around.patches(trial.opened, first.triangles):
        is_at_gap[first.triangles[patch]] = True
    is_kept = ~is_at_gap[first.triangles].any(axis=1)
    last = swaps.swap(points, first.triangles[is_kept])
    triangles = first.triangles.copy()
    triangles[is_kept] = last.triangles
    both = Swapped(triangles, first.n_swaps + last.n_swaps, first.is_settled and last.is_settled)
    return replace(trial, meshed=replace(trial.meshed, swapped=both))
