"""The parts that a scan falls into."""

import numpy as np
from numpy.typing import ArrayLike

from .._kernels.points.forest import join_parts
from ..errors import InputError, Remedy
from ..typing import Floats, Indices, Points
from .cloud import prepare
from .neighborhoods import Neighborhoods
from .neighbors import median_distances, nearest_rows
from .surroundings import NEAREST

APART = 10.0  # spacings: at 5 no scan of the evaluation falls apart yet


def label_parts(points: Points, around: Neighborhoods, spacing: Floats) -> Indices:
    """Label the parts that links of up to ten spacings, of the denser end, join; the largest is 0, (n,).

    Examples
    --------
    >>> points = np.array([[0.0, 0, 0], [0, 1, 0], [19, 0, 0], [19, 1, 0], [19, 2, 0]])
    >>> label_parts(points, nearest_rows(points, 4), np.ones(5))
    array([1, 1, 0, 0, 0])
    """
    part = np.empty(around.n_points, np.int32)
    join_parts(points, around.indptr, around.indices, spacing, APART, part)
    sizes = np.bincount(part)
    seeds = np.flatnonzero(sizes)
    rank = np.empty(len(sizes), np.int64)
    rank[seeds[np.argsort(-sizes[seeds], kind="stable")]] = np.arange(len(seeds))
    return np.asarray(rank[part])


def check_one_piece(points: Points, around: Neighborhoods, spacing: Floats) -> None:
    """Check that the points are in one part.

    Raises
    ------
    InputError
        Saying how many parts there are and how large, with a point of each.
    """
    labels = label_parts(points, around, spacing)
    sizes = np.bincount(labels)
    if len(sizes) > 1:
        shown = " and ".join(str(size) for size in sizes[:4]) + (" ..." if len(sizes) > 4 else "")
        raise InputError(
            f"the points fall into {len(sizes)} separate parts, of {shown} points (some of them: {{seeds}}), but a "
            "patch is in one piece",
            remedies=(Remedy.take_the_largest_part, Remedy.take_one_part),
            seeds=np.unique(labels, return_index=True)[1],
        )


def largest_component(points: ArrayLike) -> Indices:
    """Find the rows of the largest part of a scan: strays and other sheets are left out.

    Parameters
    ----------
    points : (N, 3) array
        In any unit and at any offset.

    Returns
    -------
    (k,) int64 array, ascending.

    Raises
    ------
    InputError
        If the points are no surface; see `prepare`.

    Examples
    --------
    >>> from pointchart import shapes
    >>> points = shapes.grid(12, 9).points
    >>> len(largest_component(np.concatenate([points, points[:50] + [0, 0, 100]])))
    108
    """
    cloud = prepare(points)
    around = nearest_rows(cloud.points, NEAREST)
    labels = label_parts(cloud.points, around, median_distances(cloud.points, around))
    return np.flatnonzero(labels[cloud.places] == 0)
