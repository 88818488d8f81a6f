"""A laser line scanner, simulated on parametric surfaces."""

from collections.abc import Callable
from math import ceil
from typing import TypeAlias

import numpy as np

from pointchart.errors import InputError
from pointchart.shapes.planar import ragged_delaunay
from pointchart.shapes.sculpted_face import sculpted_face
from pointchart.shapes.shape import Shape
from pointchart.typing import UV, Floats, Points

Surface: TypeAlias = Callable[[Floats, Floats], Points]


def laser_scan(
    surface: Surface,
    *,
    lines: int = 120,
    anisotropy: float = 1.3,
    jitter: float = 0.2,
    unevenness: float = 1.5,
    noise: float = 0.03,
    ragged: float = 1.0,
    view: tuple[float, float, float] = (0.0, 0.0, 1.0),
    seed: int = 0,
) -> Shape:
    """Scan a parametric surface line by line.

    Lines of constant t stand one line spacing apart on average; along each the points keep their distance in space.
    The field of view is a rounded rectangle. The true mesh is the Delaunay triangulation of the parameters, each
    stretched to its mean arc length, inside the ragged outline of the scan.

    Parameters
    ----------
    surface : callable
        (s, t) -> points, arrays (...) in the unit square to (..., 3); orientation: s to the right, t upwards, seen
        from the outside.
    lines : int
        Scan lines, at least 4.
    anisotropy : float
        Distance of the lines over that of the points along a line, in the middle of the field of view.
    jitter : float
        Largest displacement of a point along its line, in its spacings; less than 0.5.
    unevenness : float
        Distance of the points along a line at the corners, over that in the middle.
    noise : float
        Standard deviation of the range, in line spacings.
    ragged : float
        Largest displacement of the ends of a line, in its spacings.
    view : (3,) float
        Direction of the range; need not be a unit vector.
    seed : int
        Of jitter, ragged ends and noise.

    Returns
    -------
    Shape
        Points in the order of the scan; `uv` are the arc lengths, (along the line, across the lines).

    Raises
    ------
    InputError
        When an option is out of range.

    Examples
    --------
    >>> import numpy as np
    >>> def plane(s, t):
    ...     return np.stack([s, t, 0 * s], axis=-1)
    >>> scan = laser_scan(plane, lines=10, noise=0)
    >>> len(np.unique(scan.points[:, 1])), float(abs(scan.points[:, 2]).max())
    (10, 0.0)
    """
    if lines < 4 or anisotropy <= 0 or not 0 <= jitter < 0.5 or unevenness < 1:
        raise InputError(
            f"a scan of {lines} lines, anisotropy {anisotropy}, jitter {jitter} and unevenness {unevenness} is out of "
            "range; take at least 4, more than 0, 0 to 0.5 and at least 1"
        )
    rng = np.random.default_rng(seed)
    s, t = np.linspace(0, 1, 401), np.linspace(0, 1, 101)
    coarse = surface(*np.meshgrid(s[::4], t))
    across = _running_length(coarse.swapaxes(0, 1)).mean(axis=0)
    along = np.interp(s, s[::4], _running_length(coarse).mean(axis=0))
    gap = across[-1] / lines
    line_t = np.interp((np.arange(lines) + 0.5) * gap, across, t)
    steps = _running_steps(surface(*np.meshgrid(s, line_t)), s, line_t, unevenness) * anisotropy / gap
    st = _place_points(steps, s, line_t, jitter=jitter, ragged=ragged, rng=rng)
    points = surface(st[:, 0], st[:, 1])
    points += gap * noise * rng.normal(size=(len(points), 1)) * (np.array(view) / np.linalg.norm(view))
    uv = np.c_[np.interp(st[:, 0], s, along), np.interp(st[:, 1], t, across)]
    # Neighbours on the next line are as far as the anisotropy says.
    return Shape(points, ragged_delaunay(uv, limit=max(3.0, 2.0 * anisotropy)), uv)


def sculpture(n: int = 20_000) -> Shape:
    """Sample the sculpted face evenly, without noise.

    Parameters
    ----------
    n : int
        Points in all, to within a few per cent; at least 500.

    Returns
    -------
    Shape
        A smooth disc with overhangs: no height field.

    Raises
    ------
    InputError
        With fewer than 500 points.

    Examples
    --------
    >>> face = sculpture(1000)
    >>> bool(900 < len(face.points) < 1100)
    True
    """
    if n < 500:
        raise InputError(f"{n} points do not show the features of the face; take at least 500")
    # The face is nearly as wide as high; the rounded corners of the field of view are missing.
    lines = round((n / 0.926) ** 0.5)
    return laser_scan(sculpted_face, lines=lines, anisotropy=1.0, jitter=0.0, unevenness=1.0, noise=0.0, ragged=0.0)


def demo_scan(*, seed: int = 0) -> Shape:
    """Scan the sculpted face with a laser line scanner: the scan of `pointchart demo`.

    Parameters
    ----------
    seed : int
        Of the scanner's errors.

    Returns
    -------
    Shape
        About 20,000 points.

    Examples
    --------
    >>> round(len(demo_scan().points), -3)
    20000
    """
    return laser_scan(sculpted_face, lines=137, seed=seed)


def _running_length(points: Points) -> Floats:
    """Measure the length of polylines (rows, columns, 3) up to each column."""
    step = np.linalg.norm(np.diff(points, axis=1), axis=2)
    return np.pad(np.cumsum(step, axis=1), ((0, 0), (1, 0)))


def _running_steps(points: Points, s: Floats, line_t: Floats, unevenness: float) -> Floats:
    """Measure the lines as `_running_length`, lengths counting for less towards the corners."""
    middle = (s[1:] + s[:-1]) / 2
    far = ((2 * middle - 1) ** 2 + (2 * line_t[:, None] - 1) ** 2) / 2
    step = np.diff(_running_length(points), axis=1) * unevenness**-far
    return np.pad(np.cumsum(step, axis=1), ((0, 0), (1, 0)))


def _place_points(
    steps: Floats, s: Floats, line_t: Floats, *, jitter: float, ragged: float, rng: np.random.Generator
) -> UV:
    """Put a point on each line wherever its running number of steps passes a whole number."""
    reach = 0.5 * (1 - (2 * line_t - 1) ** 4) ** 0.25
    placed = []
    for j, t in enumerate(line_t.tolist()):
        start, end = np.interp([0.5 - reach[j], 0.5 + reach[j]], s, steps[j]) + ragged * rng.random(2) * [1, -1]
        phase = rng.random()
        step = np.arange(ceil(start - phase), end - phase) + phase
        step += jitter * rng.uniform(-1, 1, len(step))
        placed.append(np.c_[np.interp(step, steps[j], s), np.full(len(step), t)])
    return np.concatenate(placed)
