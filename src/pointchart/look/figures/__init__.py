"""Figures for papers: one picture without a title, as wide as a column, as PNG, SVG or PDF."""

from .clouds import draw_cloud
from .meshes import draw_mesh, draw_plane
from .sheet import Sheet
from .surfaces import draw_deviation_map, draw_zebra

__all__ = [
    "Sheet",
    "draw_cloud",
    "draw_deviation_map",
    "draw_mesh",
    "draw_plane",
    "draw_zebra",
]
