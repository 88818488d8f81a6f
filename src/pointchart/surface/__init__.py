"""Smooth surfaces over the parameters."""

from .bspline import BSplineSurface
from .clough_tocher import CloughTocherSurface, interpolate_clough_tocher
from .derivatives import Surface, closest_parameters, curvatures, evaluate, normals
from .deviation import Deviation, deviation_table, measure_deviation
from .fit_level import Fit, Level
from .loss import huber, squares
from .normal_equations import least_squares
from .radial import RadialSurface, fit_radial
from .tessellation import tessellate
from .to_tolerance import fit_bspline

__all__ = [
    "BSplineSurface",
    "CloughTocherSurface",
    "Deviation",
    "Fit",
    "Level",
    "RadialSurface",
    "Surface",
    "closest_parameters",
    "curvatures",
    "deviation_table",
    "evaluate",
    "fit_bspline",
    "fit_radial",
    "huber",
    "interpolate_clough_tocher",
    "least_squares",
    "measure_deviation",
    "normals",
    "squares",
    "tessellate",
]
