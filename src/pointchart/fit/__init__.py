"""Smooth surfaces over the parameters."""

from .bspline import BSplineSurface
from .surface import Surface, curvatures, evaluate, normals

__all__ = ["BSplineSurface", "Surface", "curvatures", "evaluate", "normals"]
