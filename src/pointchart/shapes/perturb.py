"""What a scanner does to a surface: noise, uneven density, gaps, no order."""

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


def grade(shape: Shape, *, ratio: float = 10.0) -> Shape:
    """Make the density of a planar shape fall smoothly from one side to the other, by a conformal map.

    The Moebius transformation (z + a) / (1 + a z) maps the unit disc onto itself, and triangles to nearly similar ones.

    Parameters
    ----------
    shape : Shape
        In the unit disc of the plane z = 0.
    ratio : float
        Largest density (points per area) over the least on the disc, at least 1.

    Returns
    -------
    Shape
        The same triangles and parameters; densest at the right.

    Raises
    ------
    InputError
        When the ratio is less than 1.

    Examples
    --------
    >>> from pointchart.shapes import disc
    >>> right = grade(disc(1000), ratio=10).points[:, 0] > 0
    >>> bool(right.sum() > 600)
    True
    """
    if not ratio >= 1:
        raise InputError(f"a density ratio of {ratio} is out of range; take at least 1")
    # Lengths change by (1 + a) / (1 - a) and its inverse at the ends of the diameter.
    end = ratio**0.25
    a = (end - 1.0) / (end + 1.0)
    z = shape.points[:, 0] + 1j * shape.points[:, 1]
    moved = (z + a) / (1.0 + a * z)
    return Shape(np.c_[moved.real, moved.imag, shape.points[:, 2]], shape.triangles, shape.uv)


def pierce(shape: Shape, *, n_gaps: int = 3, radius_in_spacings: float = 4.0, seed: int = 0) -> Shape:
    """Take out the points in a few balls inside the surface: the gaps of a scan.

    Parameters
    ----------
    shape : Shape
    n_gaps : int
        At most; fewer where there is no room. Gaps keep two radii from each other and one from the boundary.
    radius_in_spacings : float
        As a multiple of the mean edge length at the middle of the gap.
    seed : int
        Of the places.

    Returns
    -------
    Shape
        Fewer points, in the same order, and a loop more for every gap.

    Examples
    --------
    >>> from pointchart.shapes import disc
    >>> len(pierce(disc(2000), n_gaps=3).loops)
    4
    """
    points, triangles = shape.points, shape.triangles
    ends = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    length = np.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1)
    spacing = np.bincount(ends.ravel(), np.repeat(length, 2)) / np.bincount(ends.ravel())
    radius = radius_in_spacings * spacing
    rim = np.concatenate(shape.loops) if shape.loops else np.empty(0, np.int64)
    gone, middles = np.zeros(len(points), np.bool_), list[int]()
    for i in np.random.default_rng(seed).permutation(len(points)).tolist():
        if len(middles) == n_gaps:
            break
        apart = np.linalg.norm(points[[*rim.tolist(), *middles]] - points[i], axis=1)
        room = np.r_[np.full(len(rim), 2.0 * radius[i]), 2.0 * (radius[i] + radius[middles])]
        if (apart > room).all():
            middles.append(i)
            gone |= np.linalg.norm(points - points[i], axis=1) < radius[i]
    kept = triangles[~gone[triangles].any(axis=1)]
    used = np.zeros(len(points), np.bool_)
    used[kept] = True
    place = np.cumsum(used) - 1
    return Shape(points[used], place[kept], shape.uv[used])
