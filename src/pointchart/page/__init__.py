"""The page of a run: one file that opens offline, with the mesh and its parameters to turn, zoom and point at."""

from .page import Page, lay_out, writing_page

__all__ = ["Page", "lay_out", "writing_page"]
