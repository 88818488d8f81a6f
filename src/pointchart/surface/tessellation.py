"""Triangle meshes of trimmed surfaces, for display and for export."""

from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from .._kernels.surface.constrain import constrain
from ..errors import InputError
from ..mesh.connectivity import editable_mesh
from ..mesh.delaunay_swaps import swap_to_delaunay
from ..mesh.planar_delaunay import coinciding, triangulate
from ..plane.crossings import is_simple
from ..plane.polygons import check_polygon, check_senses, sides_at, signed_area
from ..typing import UV, Floats, Indices, Mask, Points, Triangles
from .derivatives import Surface

PROBES = 24  # in each direction, at which the stretch of the surface is measured
CLEARANCE = 0.71  # in spacings: no point as far as this from the ends of a side is in the circle over the side
FRAME = 256  # points around all others
OUTSIDE = 10_000  # points around the loops, so that few triangles meet in each; at many the triangulation is slow
MOST_CUTS = 20_000  # of loops that are very long for their area, and one more for each ten points inside


def tessellate(surface: Surface, loops: Sequence[ArrayLike], n: int) -> tuple[Points, Triangles, UV]:
    """Triangulate the part of a surface inside a loop and outside others.

    Staggered rows of points fill the parameter plane, u and v being scaled so that rows are as far apart in space as
    their points, up to the square root of two. Sides of the loops are cut into pieces no longer than that spacing; the
    mesh is the constrained Delaunay triangulation of these points, so it has every piece as an edge, however ragged the
    loops are. Loops much finer than the spacing make thin triangles along them.

    Parameters
    ----------
    surface : Surface
    loops : sequence of (b, 2) arrays
        Simple polygons in the parameter plane, not closed: the outer one, anticlockwise, then holes, clockwise.
    n : int
        Points to put inside, about; fewer where that would cut very long loops into more than 20 000 pieces.

    Returns
    -------
    points : (k, 3) float64 array, in the unit of the surface; the loops with their cut sides come first.
    triangles : (m, 3) int64 array, every one exactly anticlockwise in uv.
    uv : (k, 2) float64 array.

    Raises
    ------
    InputError
        If a loop crosses or touches itself or another one, runs the wrong way or lies at the wrong place, or `n` is
        less than 1.

    References
    ----------
    Sloan 1993, A fast algorithm for generating constrained Delaunay triangulations. Anglada 1997, An improved
    incremental algorithm for constructing restricted Delaunay triangulations.

    Examples
    --------
    >>> from pointchart.surface import BSplineSurface
    >>> corners = np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    >>> square = BSplineSurface(1, np.array([0.0, 0, 1, 1]), np.array([0.0, 0, 1, 1]), corners)
    >>> points, triangles, uv = tessellate(square, [np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])], 1)
    >>> points[:, :2].tolist() == uv.tolist(), len(triangles)
    (True, 2)
    """
    if n < 1:
        raise InputError(f"{n} points cannot fill a surface; ask for at least 1")
    polygons = [check_polygon(f"loop {k}", loop) for k, loop in enumerate(loops)]
    area = _check_loops(polygons)
    scale = _scale(surface, polygons[0])
    polygons = [polygon * scale for polygon in polygons]
    # Thin spikes would otherwise have far more points on them than are asked for.
    least = sum(_lengths(polygon).sum() for polygon in polygons) / (MOST_CUTS + n / 10)
    spacing = float(max(np.sqrt(2.0 / np.sqrt(3.0) * area * scale.prod() / n), least))
    cut = [_cut(polygon, _pieces(polygon, spacing)) for polygon in polygons]
    grid = np.concatenate([_staggered(cut, spacing), _outside(cut, spacing)])
    try:
        plane, triangles = _triangulate_inside(cut, grid)
    except InputError:
        # Rounding may move a cut off its side and across one that is as near: such loops stay whole.
        plane, triangles = _triangulate_inside(polygons, grid)
    uv = plane / scale
    return surface.derivatives(uv), triangles, uv


def _check_loops(polygons: list[UV]) -> float:
    """Return the area inside the loops, or say what is wrong with them."""
    if not polygons:
        raise InputError("there are no loops; give the outer one at least")
    for k, polygon in enumerate(polygons):
        if signed_area(polygon) == 0.0 or not is_simple(polygon):
            raise InputError(f"loop {k} of {len(polygon)} corners crosses or touches itself; give a simple polygon")
    areas = check_senses(polygons)
    if areas.sum() <= 0.0:
        raise InputError(f"{len(areas) - 1} holes are together as large as loop 0; they lie side by side inside it")
    return float(areas.sum())


def _scale(surface: Surface, outer: UV) -> Floats:
    """Return 1 and the mean stretch in v over that in u, to the nearest power of two: so no digit is lost."""
    low, high = outer.min(axis=0), outer.max(axis=0)
    probes = np.stack(np.meshgrid(*np.linspace(low, high, PROBES).T), axis=-1).reshape(-1, 2)
    slopes = [np.linalg.norm(surface.derivatives(probes, *order), axis=1) for order in ((1, 0), (0, 1))]
    # Some surfaces have no value outside their points.
    in_u, in_v = (slope[np.isfinite(slope)].sum() for slope in slopes)
    if in_u <= 0.0 or in_v <= 0.0:
        return np.ones(2)
    return np.array([1.0, 2.0 ** np.clip(np.rint(np.log2(in_v / in_u)), -64, 64)])


def _lengths(polygon: UV) -> Floats:
    return np.asarray(np.linalg.norm(sides_at(polygon)[1], axis=1))


def _pieces(polygon: UV, spacing: float) -> Indices:
    # A side that rounding makes longer than so many spacings is not cut once more.
    return np.asarray(np.maximum(np.ceil(_lengths(polygon) / spacing - 1e-9), 1.0), np.int64)


def _cut(polygon: UV, pieces: Indices) -> UV:
    """Cut each side of a polygon into equal pieces; its corners stay as they are."""
    side, step = _counted(pieces)
    along = sides_at(polygon)[1][side]
    return np.asarray(polygon[side] + (step / pieces[side])[:, None] * along)


def _staggered(polygons: list[UV], spacing: float) -> UV:
    """Fill what an odd number of loops is around with an equilateral grid that keeps clear of all of them."""
    starts = np.concatenate(polygons)
    rise = np.sqrt(0.75) * spacing  # the height of an equilateral triangle
    low = starts.min(axis=0)
    side, row = _rows_crossed((starts[:, 1] - low[1]) / rise, (_ends(polygons)[:, 1] - low[1]) / rise)
    (x, y), (dx, dy) = starts[side].T, (_ends(polygons) - starts)[side].T
    at = (x + (low[1] + row * rise - y) / dy * dx - low[0]) / spacing - 0.5 * (row % 2)
    # A row is inside between its first and second crossing, its third and fourth, and so on.
    order = np.lexsort((at, row))
    first, last = np.ceil(at[order[::2]]).astype(np.int64), np.floor(at[order[1::2]]).astype(np.int64)
    which, step = _counted(np.maximum(last - first + 1, 0))
    row = row[order[::2]][which]
    grid = low + np.column_stack([(first[which] + step + 0.5 * (row % 2)) * spacing, row * rise])
    distance, _ = cKDTree(starts).query(grid, distance_upper_bound=CLEARANCE * spacing)
    return np.asarray(grid[np.isinf(distance)])


def _outside(polygons: list[UV], spacing: float) -> UV:
    """Fill the outside of the loops with a grid that is no finer than that inside."""
    low, high = polygons[0].min(axis=0), polygons[0].max(axis=0)
    low, high = low - 0.25 * (high - low), high + 0.25 * (high - low)
    coarse = max(spacing, float(np.sqrt((high - low).prod() / OUTSIDE)))
    return _staggered([*polygons, np.array([low, [high[0], low[1]], high, [low[0], high[1]]])], coarse)


def _rows_crossed(start: Floats, end: Floats) -> tuple[Indices, Indices]:
    """Return the pairs of a side and a row, a whole number, that it crosses or ends on from below."""
    first, last = np.ceil(np.minimum(start, end)).astype(np.int64), np.ceil(np.maximum(start, end)).astype(np.int64)
    side, step = _counted(last - first)
    return side, first[side] + step


def _counted(counts: Indices) -> tuple[Indices, Indices]:
    """Return the number of each group as often as it counts, and numbers from 0 on within each."""
    group = np.repeat(np.arange(len(counts)), counts)
    return group, np.arange(len(group)) - np.repeat(np.cumsum(counts) - counts, counts)


def _ends(polygons: list[UV]) -> UV:
    """Return where the side ends that begins at each corner."""
    return np.concatenate([np.roll(polygon, -1, axis=0) for polygon in polygons])


def _triangulate_inside(polygons: list[UV], grid: UV) -> tuple[UV, Triangles]:
    """Triangulate loops and grid with all sides of the loops as edges; return the points and the triangles inside."""
    plane = np.concatenate([*polygons, grid, _frame(np.concatenate([*polygons, grid]))])
    doubled = coinciding(plane)
    if len(doubled):
        raise _meeting(polygons, *doubled[:2].tolist())
    draft = editable_mesh(plane, triangulate(plane, np.arange(len(plane) - FRAME, len(plane))), journal=2)
    ahead = _ahead(polygons, len(plane))
    one, other = constrain(draft, ahead)
    if one >= 0:
        raise _meeting(polygons, one, other)
    triangles = draft.corners.reshape(-1, 3)
    is_inside = _inside(polygons, draft.corners, draft.twins, ahead)
    used, corners = np.unique(triangles[is_inside], return_inverse=True)
    # The sides are the boundary now, which swaps leave alone.
    flat = np.column_stack([plane[used], np.zeros(len(used))])
    return plane[used], swap_to_delaunay(flat, corners.reshape(-1, 3)).triangles


def _ahead(polygons: list[UV], n_points: int) -> Indices:
    """Return the next point of the loop of each point, -1 for those on none; the loops come first."""
    ahead, start = np.full(n_points, -1, np.int64), 0
    for polygon in polygons:
        ahead[start : start + len(polygon)] = start + (np.arange(len(polygon)) + 1) % len(polygon)
        start += len(polygon)
    return ahead


def _meeting(polygons: list[UV], one: int, other: int) -> InputError:
    first, second = sorted((_loop_of(polygons, one), _loop_of(polygons, other)))
    return InputError(f"loops {first} and {second} cross or touch each other; draw them apart")


def _loop_of(polygons: list[UV], point: int) -> int:
    """Return the number of the loop that a point is on."""
    return int(np.searchsorted(np.cumsum([len(polygon) for polygon in polygons]), point, side="right"))


def _frame(plane: UV) -> UV:
    """Return an ellipse of points around all others."""
    low, high = plane.min(axis=0), plane.max(axis=0)
    turn = np.arange(FRAME) * 2.0 * np.pi / FRAME
    return np.asarray((low + high) / 2.0 + 0.75 * (high - low) * np.column_stack([np.cos(turn), np.sin(turn)]))


def _inside(polygons: list[UV], corners: Indices, twins: Indices, ahead: Indices) -> Mask:
    """Tell for each triangle whether it is in the part that every loop has on its left."""
    is_side = ahead[corners] == np.roll(corners.reshape(-1, 3), -1, axis=1).ravel()
    sides = np.flatnonzero(is_side)
    is_side[twins[sides]] = True
    inner = np.flatnonzero(~is_side & (twins > np.arange(len(twins))))
    n_triangles = len(twins) // 3
    pairs = sp.coo_array((np.ones(len(inner)), (inner // 3, twins[inner] // 3)), shape=(n_triangles,) * 2)
    part = sp.csgraph.connected_components(pairs, directed=False)[1]
    within = part[sides[corners[sides] == 0][0] // 3]
    astray = sides[part[sides // 3] != within]
    if len(astray):
        loop = _loop_of(polygons, corners[astray].min())
        raise InputError(f"loop {loop} lies outside loop 0 or in another hole; holes lie side by side inside loop 0")
    return np.asarray(part == within)
