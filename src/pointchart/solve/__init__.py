"""Sparse linear systems with fixed unknowns; knows no geometry."""
