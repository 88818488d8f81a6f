"""Smooth curves through the polygons that trim a surface: few edges, which is what CAD programs like.

Between its corners a polygon is a smooth rim that was sampled, so a cubic spline runs through all its points. It is
interpolated and not approximated: no tolerance has to be chosen, and the error is O(h^4) in the spacing h of the
points instead of the O(h^2) of the polygon. Where a spline leaves the domain or meets another one, sides stay straight.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.interpolate import BSpline, CubicSpline, make_interp_spline

from ..errors import InputError, name_some
from ..plane.crossings import find_meetings
from ..plane.polygons import sides_at
from ..plane.vectors import cross
from ..surface import BSplineSurface, evaluate
from ..typing import UV, Floats, Indices, Mask, Points

CORNER = np.radians(40.0)  # a circle of 10 points or more has none
PIECES = 8  # a side of a polygon is looked at in at least so many straight pieces
_STRAIGHT = 1e-12  # of the extent: what rounding does to points on a line


class Edge(NamedTuple):
    """A curve in the parameter plane from a corner to the next one.

    Attributes
    ----------
    curve
        Of degree 1 to 3, with two components.
    at : (k + 1,) float64
        The parameters at which it passes the vertices first, first + 1, ... of its loop.
    first
    """

    curve: BSpline
    at: Floats
    first: int


def trim_edges(surface: BSplineSurface, loops: Sequence[UV]) -> list[list[Edge]]:
    """Return the edges of each loop, in order; a loop without corners is one edge.

    A corner is a vertex at which the polygon turns by more than `CORNER` in the plane or in space. Splines run over the
    distances in space.

    Raises
    ------
    InputError
        If sides of the polygons meet.

    Examples
    --------
    >>> knots, corners = np.array([0.0, 0, 1, 1]), np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    >>> border = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> angles = np.arange(24) * np.pi / 12.0
    >>> hole = 0.5 + 0.25 * np.column_stack([np.cos(angles), -np.sin(angles)])
    >>> [len(edges) for edges in trim_edges(BSplineSurface(1, knots, knots, corners), [border, hole])]
    [4, 1]
    """
    for i, wrong in enumerate(_offences(surface.domain, loops, straight_edges(surface, loops))):
        if len(wrong):
            raise InputError(f"loop {i} meets itself or another loop at its sides {name_some(wrong)}; untangle it")
    corners = [_corners(surface, loop) for loop in loops]
    while True:
        edges = [_edges(surface, loop, mask) for loop, mask in zip(loops, corners, strict=True)]
        offences = _offences(surface.domain, loops, edges)
        before = sum(mask.sum() for mask in corners)
        for mask, wrong in zip(corners, offences, strict=True):
            mask[wrong] = mask[(wrong + 1) % len(mask)] = True
        if sum(mask.sum() for mask in corners) == before:
            return edges


def straight_edges(surface: BSplineSurface, loops: Sequence[UV]) -> list[list[Edge]]:
    """Return the sides of each loop as they are, one edge a side."""
    return [_edges(surface, loop, np.ones(len(loop), np.bool_)) for loop in loops]


def _corners(surface: BSplineSurface, loop: UV) -> Mask:
    turns = np.zeros(len(loop), np.bool_)
    for places in (loop, evaluate(surface, loop)):
        before, after = sides_at(places)
        lengths = np.linalg.norm(after, axis=1) * np.linalg.norm(before, axis=1)
        turns |= (after * before).sum(axis=1) < np.cos(CORNER) * lengths
    return turns


def _edges(surface: BSplineSurface, loop: UV, corners: Mask) -> list[Edge]:
    """Return one edge from each corner to the next, or a closed one from vertex 0 if there is none."""
    starts = np.flatnonzero(corners) if corners.any() else np.zeros(1, np.int64)
    ends = np.append(starts[1:], starts[0] + len(loop))
    places = evaluate(surface, loop)
    edges = []
    for first, last in zip(starts.tolist(), ends.tolist(), strict=True):
        at = np.arange(first, last + 1) % len(loop)
        knots = _lengths(places[at], loop[at])
        edges.append(Edge(_spline(knots, loop[at], not corners.any()), knots, first))
    return edges


def _lengths(places: Points, uv: UV) -> Floats:
    """Return the lengths in space up to each place, ascending also where a surface is pinched or closes up."""
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    if not steps.any():
        steps = np.linalg.norm(np.diff(uv, axis=0), axis=1)
    return np.append(0.0, np.cumsum(np.maximum(steps, 1e-9 * steps.max())))


def _spline(knots: Floats, uv: UV, is_closed: bool) -> BSpline:
    """Interpolate, by a line where all lie on one; a closed curve has the same slope at both ends."""
    chord = uv[-1] - uv[0]
    off = np.abs(cross(chord, uv - uv[0])).max()
    if chord.any() and off <= _STRAIGHT * np.abs(uv).max() * np.abs(chord).max():
        return BSpline(knots[[0, 0, -1, -1]], uv[[0, -1]], 1)
    if is_closed:
        slope = CubicSpline(knots, uv, bc_type="periodic")(0.0, 1)
        return make_interp_spline(knots, uv, 3, bc_type=([(1, slope)], [(1, slope)]))
    return make_interp_spline(knots, uv, min(3, len(uv) - 1))


def _offences(domain: Floats, loops: Sequence[UV], edges: Sequence[Sequence[Edge]]) -> list[Indices]:
    """Return for each loop the sides whose curve leaves the domain or meets another curve."""
    extent = domain[1] - domain[0]
    length = sum(np.abs((np.roll(loop, -1, axis=0) - loop) / extent).sum() for loop in loops)
    step = length / (PIECES * sum(map(len, loops)))
    cut = [_cut(loop_edges, len(loop), extent, step) for loop_edges, loop in zip(edges, loops, strict=True)]
    starts = [(uv - domain[0]) / extent for uv, _ in cut]
    counts = [len(uv) for uv in starts]
    begins = np.cumsum([0, *counts])
    after = np.concatenate([begin + np.roll(np.arange(n), -1) for begin, n in zip(begins, counts, strict=False)])
    places = np.concatenate(starts)
    wrong = find_meetings(places, after) | ((places < -_STRAIGHT) | (places > 1.0 + _STRAIGHT)).any(axis=1)
    return [np.unique(sides[part]) for (_, sides), part in zip(cut, np.split(wrong, begins[1:-1]), strict=True)]


def _cut(edges: Sequence[Edge], n_sides: int, extent: Floats, step: float) -> tuple[UV, Indices]:
    """Return places along the edges, no farther apart than about a step, and the side of the polygon each is on."""
    places, sides = [], []
    for edge in edges:
        lengths = np.abs(np.diff(edge.curve(edge.at), axis=0) / extent).sum(axis=1)
        counts = np.maximum(PIECES, np.ceil(lengths / step)).astype(np.int64)
        side = np.repeat(np.arange(len(counts)), counts)
        share = (np.arange(len(side)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[side]
        places.append(edge.curve(edge.at[side] + share * np.diff(edge.at)[side]))
        sides.append((edge.first + side) % n_sides)
    return np.concatenate(places), np.concatenate(sides)
