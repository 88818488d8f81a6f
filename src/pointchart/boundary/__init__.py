"""The boundary of a patch: detect its points, put them in order, lay them out on a convex domain."""

from ..agreement.agreed_surface import AgreedSurface, collect_agreed, patchwork
from .by_halves import order_by_halves
from .corners import places_of, quarter_places, sharpest_places
from .find import Candidate, FoundBoundary, find_boundary
from .layout import chord_length_on_circle, is_same_loop, on_circle, on_polygon, on_square, reversed_loop
from .loops import rims, tightened
from .order import check_order
from .orientation import anticlockwise
from .scores import BoundaryScores, angular_gaps, boundary_scores, hull_test
from .steps import centripetal_steps, chord_length_steps, perimeter, step_lengths, uniform_steps

__all__ = [
    "AgreedSurface",
    "BoundaryScores",
    "Candidate",
    "FoundBoundary",
    "angular_gaps",
    "anticlockwise",
    "boundary_scores",
    "centripetal_steps",
    "check_order",
    "chord_length_on_circle",
    "chord_length_steps",
    "collect_agreed",
    "find_boundary",
    "hull_test",
    "is_same_loop",
    "on_circle",
    "on_polygon",
    "on_square",
    "order_by_halves",
    "patchwork",
    "perimeter",
    "places_of",
    "quarter_places",
    "reversed_loop",
    "rims",
    "sharpest_places",
    "step_lengths",
    "tightened",
    "uniform_steps",
]
