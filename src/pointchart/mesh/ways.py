"""The ways from a scan with a boundary to a mesh, and which one is taken."""

from dataclasses import dataclass

from .._check import check_neighbors
from ..agreement.links import link_stars, tie_down
from ..boundary.bounded import Survey
from ..boundary.layout import chord_length_on_circle
from ..clock import StageClock
from ..map.scan_parameters import Connect, default_stars
from ..map.weights import WeightScheme, mean_value, trusted
from ..points.stars import star_and_sides
from ..solve.solver import Solver
from ..solve.systems import default_solver
from .delaunay_swaps import swap_to_delaunay
from .make import Meshed, mesh_by_agreement, mesh_by_links, mesh_once
from .swap_rule import Swaps


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """What is asked of a mesh.

    Attributes
    ----------
    swaps : Swaps
    connect : callable or None
        Neighbourhoods of the paper's methods, of points in the unit of the scan.
    weights : callable or None
        Weights for them, or for those of Delaunay stars.
    needs_map : bool
        Whether a map of all points is asked for.
    solver : callable or None
    """

    swaps: Swaps
    connect: Connect | None = None
    weights: WeightScheme | None = None
    needs_map: bool = False
    solver: Solver | None = None


def make_mesh(survey: Survey, way: Way, clock: StageClock) -> Meshed:
    """Mesh a scan: where stars agree without a map, by the links of its stars where they do not, or the paper's way."""
    is_by_links = way.connect is None and way.weights is None
    if is_by_links and way.swaps.from_delaunay and not way.needs_map:
        near = survey.vicinity
        with clock("assemble"):
            surface = survey.draw_tight()
        meshed = mesh_by_agreement(survey.cloud.points, survey.loop, surface, near.star, near.around, clock=clock)
        if meshed is not None:
            return meshed
    return _by_links(survey, way, clock) if is_by_links else _by_neighborhoods(survey, way, clock)


def _by_links(survey: Survey, way: Way, clock: StageClock) -> Meshed:
    points, rim, near = survey.cloud.points, survey.loop, survey.vicinity
    circle, solver = chord_length_on_circle(points, rim), way.solver or default_solver(len(points))
    with clock("neighbours"):
        links = tie_down(points, link_stars(near.star, also=star_and_sides(points, near.around)[0]), rim)
    if way.swaps.from_delaunay:
        return mesh_by_links(points, rim, circle, links, near.around, solver=solver, clock=clock)
    graph, scheme = links.neighborhoods, trusted(links)
    return mesh_once(points, rim, circle, graph, weights=scheme, swap=way.swaps, solver=solver, clock=clock)


def _by_neighborhoods(survey: Survey, way: Way, clock: StageClock) -> Meshed:
    points, rim = survey.cloud.points, survey.loop
    circle, solver = chord_length_on_circle(points, rim), way.solver or default_solver(len(points))
    with clock("neighbours"):
        neighborhoods = (way.connect or default_stars)(points * survey.cloud.scale)
    check_neighbors(neighborhoods.indices, neighborhoods.n_points, len(points))
    first = swap_to_delaunay if way.swaps.from_delaunay else way.swaps
    weights = way.weights or mean_value
    return mesh_once(points, rim, circle, neighborhoods, weights=weights, swap=first, solver=solver, clock=clock)
