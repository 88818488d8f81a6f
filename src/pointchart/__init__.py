"""From an unorganized point cloud of one surface patch to planar parameters and a certified disc mesh.

The names below are the public interface, in the order of the pipeline.
"""

from .boundary import (
    BoundaryScores,
    Candidate,
    FoundBoundary,
    angular_gaps,
    anticlockwise,
    boundary_scores,
    centripetal_steps,
    chord_length_on_circle,
    chord_length_steps,
    find_boundary,
    hull_test,
    on_circle,
    on_polygon,
    on_square,
    order_by_halves,
    quarter_places,
    sharpest_places,
    uniform_steps,
)
from .certify import Certificate, certify
from .chart import uv_free_boundary, uv_low_stretch, uv_of_points, uv_on_mesh
from .clock import StageClock
from .components import largest_component
from .curvature_swaps import (
    swap_to_least_curvature,
    swap_to_least_gaussian_curvature,
    swap_to_least_mean_curvature,
    swap_to_least_turn,
)
from .dirichlet import Flattened, minimize_dirichlet
from .errors import FormatError, InputError, PointchartError, SolveError
from .fit import BSplineSurface, fit_bspline, fit_radial, interpolate_clough_tocher
from .gaps import bridge_gaps, leave_gaps_open, refuse_second_boundary
from .intersections import self_intersections
from .io import Scan, read_loop, read_scan, write_curves, write_loop, write_mesh, write_uv
from .links import Links, link_stars, trusted
from .mesh import one_rings
from .neighbors import Neighborhoods, ball, nearest, spacing
from .parameterize import Parameterization, parameterize
from .pipeline import Reconstruction, parameterize_scan, reconstruct
from .prepare import Cloud, prepare
from .quality import (
    area_distortions,
    conformal_distortions,
    l2_stretch,
    least_distance,
    linf_stretch,
    radius_ratios,
    stretches,
    vertex_stretches,
)
from .recover import Recovered, recover_links
from .relocate import Relocated, mesh_energy, relocate_points, suspect_points
from .reopen import parameterize_open
from .solve import Solution, bicgstab, cholesky, conjugate_gradient, direct, multigrid, solve_fixed
from .stars import delaunay_star, nearest_star, normals, smooth
from .surface_io import read_cad, read_surface_json, write_cad, write_surface_json
from .surfacing import SurfacedScan, fit_scan
from .survey import Survey, survey_scan
from .swaps import Swapped, keep_edges, swap_to_delaunay
from .triangulate import triangulate
from .vicinity import Vicinity, explore
from .weights import mean_value, reciprocal_distance, shape_preserving, uniform

__all__ = [
    "BSplineSurface",
    "BoundaryScores",
    "Candidate",
    "Certificate",
    "Cloud",
    "Flattened",
    "FormatError",
    "FoundBoundary",
    "InputError",
    "Links",
    "Neighborhoods",
    "Parameterization",
    "PointchartError",
    "Reconstruction",
    "Recovered",
    "Relocated",
    "Scan",
    "Solution",
    "SolveError",
    "StageClock",
    "SurfacedScan",
    "Survey",
    "Swapped",
    "Vicinity",
    "angular_gaps",
    "anticlockwise",
    "area_distortions",
    "ball",
    "bicgstab",
    "boundary_scores",
    "bridge_gaps",
    "centripetal_steps",
    "certify",
    "cholesky",
    "chord_length_on_circle",
    "chord_length_steps",
    "conformal_distortions",
    "conjugate_gradient",
    "delaunay_star",
    "direct",
    "explore",
    "find_boundary",
    "fit_bspline",
    "fit_radial",
    "fit_scan",
    "hull_test",
    "interpolate_clough_tocher",
    "keep_edges",
    "l2_stretch",
    "largest_component",
    "least_distance",
    "leave_gaps_open",
    "linf_stretch",
    "link_stars",
    "mean_value",
    "mesh_energy",
    "minimize_dirichlet",
    "multigrid",
    "nearest",
    "nearest_star",
    "normals",
    "on_circle",
    "on_polygon",
    "on_square",
    "one_rings",
    "order_by_halves",
    "parameterize",
    "parameterize_open",
    "parameterize_scan",
    "prepare",
    "quarter_places",
    "radius_ratios",
    "read_cad",
    "read_loop",
    "read_scan",
    "read_surface_json",
    "reciprocal_distance",
    "reconstruct",
    "recover_links",
    "refuse_second_boundary",
    "relocate_points",
    "self_intersections",
    "shape_preserving",
    "sharpest_places",
    "smooth",
    "solve_fixed",
    "spacing",
    "stretches",
    "survey_scan",
    "suspect_points",
    "swap_to_delaunay",
    "swap_to_least_curvature",
    "swap_to_least_gaussian_curvature",
    "swap_to_least_mean_curvature",
    "swap_to_least_turn",
    "triangulate",
    "trusted",
    "uniform",
    "uniform_steps",
    "uv_free_boundary",
    "uv_low_stretch",
    "uv_of_points",
    "uv_on_mesh",
    "vertex_stretches",
    "write_cad",
    "write_curves",
    "write_loop",
    "write_mesh",
    "write_surface_json",
    "write_uv",
]
