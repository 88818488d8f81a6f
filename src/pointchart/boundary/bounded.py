"""What every reconstruction begins with: the scan prepared, its neighbourhoods and its boundary."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_loop, check_place, check_points
from .._memory import check_room
from ..agreement.agreed_surface import AgreedSurface, collect_agreed
from ..clock import StageClock
from ..errors import InputError, points_called
from ..points.cloud import Cloud, made_ready
from ..points.parts import check_one_piece
from ..points.surroundings import Vicinity, look_around
from ..typing import Loop, Points
from .find import Candidate, FoundBoundary, search_boundary
from .loops import tightened
from .order import check_order
from .orientation import anticlockwise
from .scores import BoundaryScores, score_points


@dataclass(frozen=True, slots=True, eq=False)
class Survey:
    """What is known of a scan before it is mapped.

    Attributes
    ----------
    scan : (N, 3) float64
        The points as given.
    cloud : Cloud
    vicinity : Vicinity
        Of the cloud's points.
    points : (n, 3) float64
        The cloud's points as the scan has them.
    loop : (b,) int64
        Boundary points of the cloud, anticlockwise.
    found : FoundBoundary or None
        How the boundary was found; None if it was given.
    """

    scan: Points
    cloud: Cloud
    vicinity: Vicinity
    points: Points
    loop: Loop
    found: FoundBoundary | None

    def trials(self, most: int) -> list["Survey"]:
        """Return the survey with each of the best candidates for the boundary; itself, if the boundary was given."""
        if self.found is None:
            return [self]
        turned = [self.found.beginning_with(k) for k in range(min(most, len(self.found.candidates)))]
        return [replace(self, loop=found.loop, found=found) for found in turned]

    @property
    def candidates(self) -> list[Candidate]:
        """The boundary and the other loops that were found, the best first; none if the boundary was given."""
        return self.found.candidates if self.found else []

    def score(self) -> BoundaryScores:
        """Return how much speaks for each point of the cloud lying on a boundary; measured now, if that was given."""
        if self.found is not None:
            return self.found.scores
        near, agreed = self.vicinity, self._agree().triangles
        return score_points(near.smoothed, near.around, near.star, agreed, near.spacing, near.sides)

    def draw_tight(self) -> AgreedSurface:
        """Return the triangles on which stars agree, drawn tight to the boundary; found now, if that was given."""
        if self.found is not None:
            return self.found.surface
        on_loop = np.zeros(len(self.cloud.points), np.bool_)
        on_loop[self.loop] = True
        return tightened(self.vicinity.smoothed, self._agree(), on_loop)

    def _agree(self) -> AgreedSurface:
        return collect_agreed(self.vicinity.smoothed, self.vicinity.star, self.vicinity.spacing)


def survey_scan(
    points: ArrayLike,
    loop: ArrayLike | None = None,
    *,
    outer: ArrayLike | None = None,
    clock: StageClock | None = None,
) -> Survey:
    """Prepare a scan, find its Delaunay stars and its boundary: what every reconstruction begins with.

    Parameters
    ----------
    points : (N, 3) array
        The scan, in any unit and at any offset. Repeated points are merged.
    loop : (b,) int array, optional
        Boundary rows in order, in either direction; found, if not given.
    outer : (3,) array, optional
        A place: of the loops found, the one that passes nearest to it is the boundary.
    clock : StageClock, optional

    Returns
    -------
    Survey

    Raises
    ------
    InputError
        If the points are no single patch or too many for the memory, or the boundary is at fault.

    Examples
    --------
    >>> from pointchart import shapes
    >>> sheet = shapes.grid(12, 9)
    >>> survey = survey_scan(sheet.points)
    >>> sorted(survey.cloud.rows[survey.loop]) == sorted(sheet.boundary)
    True
    """
    clock = clock or StageClock()
    with clock("prepare"):
        scan = check_points(points)
        check_room(len(scan))
        cloud = made_ready(scan)
        given = None if loop is None else check_loop(loop, len(scan))
        place = None if outer is None else check_place(outer)
        if given is not None and place is not None:
            raise InputError("both a boundary and a place of the boundary are given; give one of them")
        distinct = scan[cloud.rows]
    with points_called(cloud.rows):
        with clock("neighbours"):
            vicinity = look_around(cloud.points, cloud.keys)
        with clock("boundary"):
            if given is None:
                found = search_boundary(cloud.points, vicinity)
                if place is not None:
                    found = found.beginning_with(found.nearest_to(distinct, place))
                rim = found.loop
            else:
                check_one_piece(cloud.points, vicinity.around, vicinity.spacing)
                found, rim = None, check_loop(cloud.places[given], len(cloud.points))
                check_order(cloud.points, rim)
                rim = anticlockwise(cloud.points, rim)
    return Survey(scan, cloud, vicinity, distinct, rim, found)
