"""The page of a run: one file that opens offline, with the mesh and its parameters to turn, zoom and point at."""

from .html_page import PAGE_SUFFIXES, HtmlPage, compose, writing_page

__all__ = ["PAGE_SUFFIXES", "HtmlPage", "compose", "writing_page"]
