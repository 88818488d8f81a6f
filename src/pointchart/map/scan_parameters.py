"""The paper's parameters of a scan, without a mesh."""

from collections.abc import Callable

from numpy.typing import ArrayLike

from .._check import check_neighbors
from ..boundary.bounded import Survey, survey_scan
from ..boundary.layout import chord_length_on_circle
from ..clock import StageClock
from ..errors import points_called
from ..plane.polygons import check_layout
from ..points.neighborhoods import Neighborhoods
from ..points.neighbors import nearest_rows
from ..points.stars import planar_stars
from ..points.surroundings import NEAREST
from ..solve.solver import Solver
from ..typing import UV, Loop, Points
from .convex_combination import Parameterization, map_points
from .weights import WeightScheme, mean_value

Connect = Callable[[Points], Neighborhoods]
LayoutRule = Callable[[Points, Loop], UV]


def parameterize_scan(
    points: ArrayLike,
    loop: ArrayLike | None = None,
    *,
    outer: ArrayLike | None = None,
    connect: Connect | None = None,
    weights: WeightScheme | None = None,
    layout: LayoutRule = chord_length_on_circle,
    solver: Solver | None = None,
    clock: StageClock | None = None,
) -> tuple[Survey, Parameterization]:
    """Give a scan the parameters of the paper, without a mesh.

    Takes what `reconstruct` takes; `connect` gives the Delaunay stars of the 20 nearest points, if not given.

    Returns
    -------
    Survey
    Parameterization
        In the order of ``survey.cloud``; ``cloud.rows`` are the rows of the scan.

    Examples
    --------
    >>> from pointchart import shapes
    >>> survey, mapped = parameterize_scan(shapes.grid(12, 9).points)
    >>> bool(np.linalg.norm(mapped.uv, axis=1).max() < 1.0 + 1e-12)
    True
    """
    clock = clock or StageClock()
    survey = survey_scan(points, loop, outer=outer, clock=clock)
    cloud, rim = survey.cloud.points, survey.loop
    boundary_uv = check_layout(layout(survey.scan, survey.cloud.rows[rim]), rim)
    with points_called(survey.cloud.rows):
        with clock("neighbours"):
            neighborhoods = (connect or default_stars)(cloud * survey.cloud.scale)
        with clock("map"):
            weights = weights or mean_value
            check_neighbors(neighborhoods.indices, neighborhoods.n_points, len(cloud))
            mapped = map_points(cloud, rim, boundary_uv, neighborhoods, weights=weights, solver=solver)
    return survey, mapped


def default_stars(points: Points) -> Neighborhoods:
    """Find the Delaunay stars of the paper's method 3 where nothing else is asked for."""
    return planar_stars(points, nearest_rows(points, NEAREST))
