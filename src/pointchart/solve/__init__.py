"""Sparse linear systems with fixed unknowns, their solvers, and what has to be reached; no coordinates."""
