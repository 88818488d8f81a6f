"""The functions of the library that the words of options name."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import boundary
from ..chart.free_boundary import uv_free_boundary
from ..chart.low_stretch import uv_low_stretch
from ..chart.of_points import uv_of_points
from ..chart.on_mesh import uv_on_mesh
from ..chart.rule import ChartRule
from ..errors import OptionError
from ..gaps.rules import GapRule, bridge_gaps, leave_gaps_open
from ..heights.projection import fitted_normal
from ..map import weights
from ..map.scan_parameters import Connect, LayoutRule
from ..map.weights import WeightScheme
from ..mesh import crease_swaps, delaunay_swaps
from ..mesh.swap_rule import SwapRule
from ..points import neighbors, stars, surroundings
from ..points.neighborhoods import Neighborhoods
from ..typing import UV, Floats, Indices, Loop, Points
from .option_values import Chart, Domain, Holes, Neighbors, Spacing, SurfaceDomain, Swap, Weighting
from .options import options_of, values_of

if TYPE_CHECKING:
    from .mesh_run import MeshRun

# What each word of an option stands for; whoever adds a word adds it here and to the words themselves.
WEIGHTS: dict[Weighting, WeightScheme] = {
    Weighting.mean_value: weights.mean_value,
    Weighting.shape_preserving: weights.shape_preserving,
    Weighting.reciprocal: weights.reciprocal_distance,
    Weighting.uniform: weights.uniform,
}
# How steps along the boundary are laid out on the domain.
STEPS: dict[Spacing, Callable[[Points, Loop], Floats]] = {
    Spacing.chord: boundary.chord_length_steps,
    Spacing.uniform: boundary.uniform_steps,
    Spacing.centripetal: boundary.centripetal_steps,
}
# Without a word the library decides, by whether the boundary was given.
GAPS: dict[Holes, GapRule] = {Holes.bridge: bridge_gaps, Holes.open: leave_gaps_open}
SWAPS: dict[Swap, SwapRule] = {
    Swap.delaunay: delaunay_swaps.swap_to_delaunay,
    Swap.normals: crease_swaps.swap_to_least_turn,
    Swap.mean_curvature: crease_swaps.swap_to_least_mean_curvature,
    Swap.gaussian_curvature: crease_swaps.swap_to_least_gaussian_curvature,
    Swap.curvature: crease_swaps.swap_to_least_curvature,
    Swap.none: delaunay_swaps.keep_edges,
}
# All but the last are one-to-one, and certified to be.
CHARTS: dict[Chart, ChartRule] = {
    Chart.mesh: uv_on_mesh,
    Chart.low_stretch: uv_low_stretch,
    Chart.free: uv_free_boundary,
    Chart.paper: uv_of_points,
}


def connect_rule(kind: Neighbors | None, k: int | None, radius: float | None) -> Connect | None:
    """Return the function that finds neighbourhoods as asked for; None leaves the choice to the library."""
    if kind is None and k is None and radius is None:
        return None
    if radius is not None and not 0.0 < radius < float("inf"):
        raise OptionError(
            f"--radius is {radius:g}; it has to be positive and finite, some 2 to 4 times the spacing of the points"
        )
    if kind is Neighbors.ball:
        if k is not None or radius is None:
            raise OptionError("--neighbors ball needs --radius and no -k")
        return partial(neighbors.ball, radius=radius)
    if radius is not None and k is not None:
        raise OptionError("-k and --radius exclude each other: candidates are the k nearest or those in a ball")
    around: Callable[[Points], Neighborhoods] = (
        partial(neighbors.nearest, k=surroundings.NEAREST if k is None else k)
        if radius is None
        else partial(neighbors.ball, radius=radius)
    )
    if kind is Neighbors.nearest:
        if radius is not None:
            raise OptionError("--neighbors nearest takes -k and no --radius; for a ball say --neighbors ball")
        return around
    return lambda points: stars.delaunay_star(points, around(points))


def weights_rule(weighting: Weighting | None, kind: Neighbors | None) -> WeightScheme | None:
    """Return the weights asked for; unordered neighbours get reciprocal distances, if nothing is said."""
    if weighting is not None:
        return WEIGHTS[weighting]
    return weights.reciprocal_distance if kind in (Neighbors.ball, Neighbors.nearest) else None


def corner_names(domain: Domain | SurfaceDomain, corners: str | None) -> list[int] | None:
    """Return the boundary points named for the corners of the square, if any are."""
    if corners is None:
        return None
    if domain not in (Domain.square, SurfaceDomain.square):
        raise OptionError("--corners needs --domain square")
    words = corners.split(",")
    if len(words) != 4 or not all(word.strip().isdigit() for word in words):
        raise OptionError(f"--corners is '{corners}'; four boundary points are needed, such as 12,480,971,1500")
    return [int(word) for word in words]


def column_names(columns: str | None) -> tuple[str, str, str] | None:
    """Return the columns of x, y, z by name or number, if they are given."""
    if columns is None:
        return None
    words = [word.strip() for word in columns.split(",")]
    if len(words) != 3 or "" in words or len(set(words)) != 3:
        raise OptionError(
            f"--columns is '{columns}'; three different columns are needed, such as 2,3,4 or east,north,up"
        )
    return words[0], words[1], words[2]


def class_numbers(classes: str | None) -> list[int] | None:
    """Return the classes of points to take, if not all are."""
    if classes is None:
        return None
    words = classes.split(",")
    if not all(word.strip().isdigit() for word in words):
        raise OptionError(f"--classes is '{classes}'; whole numbers are needed, such as 2 or 2,6")
    return [int(word) for word in words]


def plane_normal(run: MeshRun) -> Callable[[Points], Floats] | None:
    """Return the function that gives the normal of the plane asked for, of points; None if none is asked for."""
    text = run.mesh.plane
    if text is None:
        if run.mesh.keep is not None:
            raise OptionError("--keep needs --plane: it says which of several points at one place of a plane stays")
        return None
    idle = ("outer", "boundary", "domain", "corners", "spacing", "swap", "uv", "neighbors", "k", "radius", "weights")
    values = values_of(run)
    for option in options_of(type(run)):
        if option.name in idle and values[option.name] != option.default:
            raise OptionError(
                f"--plane and {option.flags[0]} exclude each other: the plane gives boundary and parameters"
            )
    if text == "fit":
        return fitted_normal
    try:
        normal = np.eye(3)[["yz", "xz", "xy"].index(text)] if text in ("xy", "xz", "yz") else _direction(text)
    except ValueError:
        raise OptionError(f"--plane is '{text}'; xy, xz, yz, fit or a normal is needed, such as 0,0.1,1") from None
    return lambda points: normal


def _direction(text: str) -> Floats:
    direction = np.array([float(word) for word in text.split(",")]).reshape(3)
    if not np.isfinite(direction).all() or not direction.any():
        raise ValueError
    return direction


def layout_rule(domain: Domain, spacing: Spacing, corners: Indices | None) -> LayoutRule:
    """Return the function that lays the boundary out as asked for."""
    steps = STEPS[spacing]
    if domain not in (Domain.square, SurfaceDomain.square):
        return lambda points, loop: boundary.on_circle(steps(points, loop))

    def square(points: Points, loop: Loop) -> UV:
        places = boundary.sharpest_places(points, loop) if corners is None else boundary.places_of(corners, loop)
        return boundary.on_square(steps(points, loop), places)

    return square


def outer_place(text: str | None, boundary: Path | None = None) -> Floats | None:
    """Return the place that the boundary passes nearest to, unless it is given."""
    if text is None:
        return None
    if boundary is not None:
        raise OptionError("--boundary and --outer exclude each other: either says which loop the boundary is")
    try:
        place = np.array([float(word) for word in text.split(",")]).reshape(3)
    except ValueError:
        place = np.full(3, np.nan)
    if not np.isfinite(place).all():
        raise OptionError(f"--outer is '{text}'; a place is needed, such as 0.5,-12,3.25")
    return place


def amount(option: str, text: str, *, positive: bool = False, below: float = np.inf) -> Callable[[float], float]:
    """Read a number, or a percentage; return the function that gives the amount of a whole."""
    word = text.strip().removesuffix("%")
    is_share = word != text.strip()
    try:
        value = float(word) / (100.0 if is_share else 1.0)
    except ValueError:
        raise OptionError(f"{option} is '{text}'; a number is needed, or one with %, such as 0.1%") from None
    if not 0.0 <= value < below or (positive and value == 0.0):
        least, most = "above 0" if positive else "at least 0", "finite" if below == np.inf else f"below {below:.0%}"
        raise OptionError(f"{option} is '{text}'; it has to be {least} and {most}")
    return lambda whole: value * whole if is_share else value


def fairness_weight(text: str) -> float | None:
    """Return the weight of the thin plate energy; None leaves the choice to the library."""
    try:
        weight = None if text == "auto" else float(text)
    except ValueError:
        weight = np.nan
    if weight is not None and not 0.0 <= weight < np.inf:
        raise OptionError(f"--fairness is '{text}'; auto is needed, or a finite number from 0, such as 1e-5")
    return weight


def view_angles(text: str | None) -> tuple[float, float] | None:
    """Return how far to walk around a scan and to look down on it, in degrees, if it is given."""
    try:
        turn, tilt = (0.0, 0.0) if text is None else (float(word) for word in text.split(","))
        if not (abs(turn) <= 360.0 and abs(tilt) <= 90.0):
            raise ValueError
    except ValueError:
        raise OptionError(
            f"--view is '{text}'; two angles in degrees are needed, such as 30,20, the second from -90 to 90"
        ) from None
    return None if text is None else (turn, tilt)
