"""What a scanner does to a surface: noise, uneven density, no order."""

import numpy as np

from pointchart.errors import InputError
from pointchart.shapes.planar import ragged_delaunay
from pointchart.shapes.shape import Shape


def add_noise(shape: Shape, *, sigma_in_spacings: float = 0.25, seed: int = 0) -> Shape:
    """Move every point by normal noise, the same in all directions.

    Parameters
    ----------
    shape : Shape
    sigma_in_spacings : float
        Standard deviation of each coordinate, as a multiple of `shape.spacing`.
    seed : int
        Of the noise.

    Returns
    -------
    Shape
        The same triangles and parameters.

    Examples
    --------
    >>> from pointchart.shapes import grid
    >>> bool((add_noise(grid(3, 3), sigma_in_spacings=0).points == grid(3, 3).points).all())
    True
    """
    noise = np.random.default_rng(seed).normal(size=shape.points.shape)
    return Shape(shape.points + sigma_in_spacings * shape.spacing * noise, shape.triangles, shape.uv)


def thin(shape: Shape, *, ratio: float = 8.0, seed: int = 0) -> Shape:
    """Drop points at random so that the density falls by a ratio across the shape.

    A point is kept with probability ratio^(-w), where w runs from 0 to 1 along the first parameter. The rest is
    triangulated anew in the parameters, so the truth is as good as they are conformal, and stays a disc.

    Parameters
    ----------
    shape : Shape
        A disc.
    ratio : float
        Largest density over the least, at least 1.
    seed : int
        Of the choice.

    Returns
    -------
    Shape
        Fewer points, in the same order.

    Raises
    ------
    InputError
        When the ratio is less than 1, or fewer than 3 points are left.

    Examples
    --------
    >>> from pointchart.shapes import grid
    >>> len(thin(grid(5, 4), ratio=1).points)
    20
    """
    if not ratio >= 1:
        raise InputError(f"a density ratio of {ratio} would need more points, not fewer; take at least 1")
    u = shape.uv[:, 0]
    keep = np.random.default_rng(seed).random(len(u)) < ratio ** (-(u - u.min()) / np.ptp(u))
    if keep.sum() < 3:
        raise InputError(f"thinning by {ratio} leaves {keep.sum()} of {len(u)} points; take a smaller ratio")
    return Shape(shape.points[keep], ragged_delaunay(shape.uv[keep], limit=4.0), shape.uv[keep])


def shuffle(shape: Shape, *, seed: int = 0) -> Shape:
    """Renumber the points at random.

    Parameters
    ----------
    shape : Shape
    seed : int
        Of the numbering.

    Returns
    -------
    Shape
        The same surface; the triangles follow their points.

    Examples
    --------
    >>> from pointchart.shapes import grid
    >>> mixed = shuffle(grid(3, 3))
    >>> sorted(mixed.uv.tolist()) == sorted(grid(3, 3).uv.tolist())
    True
    """
    order = np.random.default_rng(seed).permutation(len(shape.points))
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return Shape(shape.points[order], place[shape.triangles], shape.uv[order])
