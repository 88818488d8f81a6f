"""Surfaces that fold where the points, seen from above, are a plain height field."""

import numpy as np

from ..errors import Remedy, SolveError
from ..typing import Points
from .certificate import Certificate

# Folds a triangle: noise of half a spacing makes one in 50 on a scanned face, of a whole one on a sheet one in 26;
# contour lines and towns taken for surfaces in space have one in 16 to 22.
FOLDED = 1 / 24
# Deviations from the plane of least squares over those along its narrower side: a hemisphere has 0.5, hills have 0.1.
FLAT = 0.15


def check_not_folded(points: Points, proof: Certificate) -> None:
    """Check that a mesh does not fold all over where its points lie flat, as contour lines and roofs do.

    Raises
    ------
    SolveError
        Saying how often it folds.

    Examples
    --------
    >>> from pointchart import certify, shapes
    >>> sheet = shapes.grid(9, 9)
    >>> check_not_folded(sheet.points, certify(sheet.points, sheet.triangles))
    """
    if proof.folds <= FOLDED * proof.n_triangles:
        return
    centered = points - points.mean(axis=0)
    thin, narrow, _ = np.sqrt(np.maximum(np.linalg.eigvalsh(centered.T @ centered), 0.0))
    if thin > FLAT * narrow:
        return
    raise SolveError(
        f"the mesh folds back at {proof.folds} edges, one for every {proof.n_triangles / proof.folds:.0f} triangles, "
        "though the points lie flat: they are no sample of a surface in space",
        remedies=[Remedy.take_heights],
    )
