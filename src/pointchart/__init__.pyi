"""The public names, each with the module that it is imported from when it is first asked for: the one list of them."""

from .boundary import (
    BoundaryScores as BoundaryScores,
    Candidate as Candidate,
    FoundBoundary as FoundBoundary,
    angular_gaps as angular_gaps,
    anticlockwise as anticlockwise,
    boundary_scores as boundary_scores,
    centripetal_steps as centripetal_steps,
    chord_length_on_circle as chord_length_on_circle,
    chord_length_steps as chord_length_steps,
    find_boundary as find_boundary,
    hull_test as hull_test,
    on_circle as on_circle,
    on_polygon as on_polygon,
    on_square as on_square,
    order_by_halves as order_by_halves,
    quarter_places as quarter_places,
    sharpest_places as sharpest_places,
    uniform_steps as uniform_steps,
)
from .proof.certificate import Certificate as Certificate, certify as certify
from .chart.rule import Chart as Chart
from .chart.free_boundary import uv_free_boundary as uv_free_boundary
from .chart.low_stretch import uv_low_stretch as uv_low_stretch
from .chart.of_points import uv_of_points as uv_of_points
from .chart.on_mesh import uv_on_mesh as uv_on_mesh
from .clock import StageClock as StageClock
from .points.parts import largest_component as largest_component
from .mesh.crease_swaps import (
    swap_to_least_curvature as swap_to_least_curvature,
    swap_to_least_gaussian_curvature as swap_to_least_gaussian_curvature,
    swap_to_least_mean_curvature as swap_to_least_mean_curvature,
    swap_to_least_turn as swap_to_least_turn,
)
from .chart.free_boundary import Flattened as Flattened, minimize_dirichlet as minimize_dirichlet
from .errors import (
    FormatError as FormatError,
    InputError as InputError,
    PointchartError as PointchartError,
    SolveError as SolveError,
)
from .surface import (
    BSplineSurface as BSplineSurface,
    fit_bspline as fit_bspline,
    fit_radial as fit_radial,
    interpolate_clough_tocher as interpolate_clough_tocher,
)
from .gaps.rules import (
    bridge_gaps as bridge_gaps,
    leave_gaps_open as leave_gaps_open,
    refuse_second_boundary as refuse_second_boundary,
)
from .proof.intersections import self_intersections as self_intersections
from .io import (
    Scan as Scan,
    read_loop as read_loop,
    read_scan as read_scan,
    write_curves as write_curves,
    write_loop as write_loop,
    write_mesh as write_mesh,
    write_uv as write_uv,
)
from .agreement.links import Links as Links, link_stars as link_stars
from .map.weights import trusted as trusted
from .mesh.connectivity import one_rings as one_rings
from .solve.algebraic_multigrid import multigrid as multigrid
from .points.neighborhoods import Neighborhoods as Neighborhoods
from .points.neighbors import ball as ball, nearest as nearest, spacing as spacing
from .map.convex_combination import Parameterization as Parameterization, parameterize as parameterize
from .heights.height_field import Keep as Keep, reconstruct_heights as reconstruct_heights
from .pipeline import Reconstruction as Reconstruction, reconstruct as reconstruct
from .map.scan_parameters import parameterize_scan as parameterize_scan
from .points.cloud import Cloud as Cloud, prepare as prepare
from .mesh.quality import radius_ratios as radius_ratios
from .mesh.distortion import (
    area_distortions as area_distortions,
    conformal_distortions as conformal_distortions,
    l2_stretch as l2_stretch,
    least_distance as least_distance,
    linf_stretch as linf_stretch,
    stretches as stretches,
    vertex_stretches as vertex_stretches,
)
from .mesh.recover import Recovered as Recovered, recover_links as recover_links
from .mesh.relocate import (
    Relocated as Relocated,
    mesh_energy as mesh_energy,
    relocate_points as relocate_points,
    suspect_points as suspect_points,
)
from .map.protrusions import parameterize_open as parameterize_open
from .solve.systems import Solution as Solution, solve_fixed as solve_fixed
from .solve.krylov import bicgstab as bicgstab, conjugate_gradient as conjugate_gradient
from .solve.factors import cholesky as cholesky, direct as direct
from .points.stars import delaunay_star as delaunay_star, nearest_star as nearest_star
from .points.planes import normals as normals, smooth as smooth
from .cad import (
    read_cad as read_cad,
    read_surface_json as read_surface_json,
    write_cad as write_cad,
    write_surface_json as write_surface_json,
)
from .surface.surfacing import SurfacedScan as SurfacedScan, fit_scan as fit_scan
from .boundary.bounded import Survey as Survey, survey_scan as survey_scan
from .mesh.delaunay_swaps import keep_edges as keep_edges, swap_to_delaunay as swap_to_delaunay
from .mesh.swap_rule import Swapped as Swapped, Swaps as Swaps
from .mesh.planar_delaunay import triangulate as triangulate
from .points.surroundings import Vicinity as Vicinity, explore as explore
from .map.weights import (
    mean_value as mean_value,
    reciprocal_distance as reciprocal_distance,
    shape_preserving as shape_preserving,
    uniform as uniform,
)
