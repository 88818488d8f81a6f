"""A simulated scan of a rabbit with two long ears, open below: for Figure 7, where the paper has Stanford's bunny."""

import numpy as np
from scipy.spatial import cKDTree

from pointchart.boundary import anticlockwise
from pointchart.typing import Floats, Loop, Points

# Ellipsoids that melt into one another: centre, radii, and the tilt of the vertical radius to the side, in degrees.
PARTS = (
    ((0.0, 0.0, -0.12), (0.50, 0.52, 0.60), 0.0),  # body
    ((0.0, 0.20, 0.30), (0.30, 0.30, 0.24), 0.0),  # chest
    ((0.0, 0.62, 0.34), (0.27, 0.25, 0.32), 0.0),  # head
    ((0.0, 0.52, 0.60), (0.12, 0.10, 0.12), 0.0),  # snout
    ((0.17, 1.14, 0.22), (0.105, 0.42, 0.065), 13.0),  # ears
    ((-0.17, 1.14, 0.22), (0.105, 0.42, 0.065), -13.0),
    ((0.26, -0.06, 0.44), (0.13, 0.13, 0.24), 0.0),  # paws
    ((-0.26, -0.06, 0.44), (0.13, 0.13, 0.24), 0.0),
    ((0.0, -0.02, -0.72), (0.17, 0.17, 0.15), 0.0),  # tail
)
SOFT = 0.03  # width of the seams
BASE = -0.30  # height of the cut
THROWN, SHELL = 1_500_000, 0.04  # points, of which those so near to the surface are moved onto it
ROOM = np.array([[-0.8, BASE, -1.1], [0.8, 1.8, 0.9]])


def rabbit(spacing: float = 0.016, *, seed: int = 0) -> tuple[Points, Loop]:
    """Scan the rabbit by points that are at least so far apart, and return them and the loop of its base."""
    rng = np.random.default_rng(seed)
    rim = _rim(spacing)
    thrown = rng.uniform(*ROOM, (THROWN, 3))
    thrown = thrown[np.abs(_height(thrown)) < SHELL]
    for _ in range(5):
        thrown = _onto_surface(thrown)
    inner = thrown[thrown[:, 1] > BASE]
    points = np.concatenate([rim, inner[rng.permutation(len(inner))]])
    points = points[_far_apart(points, spacing, len(rim))]
    return points, anticlockwise(points, np.arange(len(rim)))


def _height(places: Points) -> Floats:
    """Return about how far places are outside the rabbit, less than 0 inside."""
    near = []
    for center, radii, tilt in PARTS:
        off, angle = places - center, np.deg2rad(tilt)
        across = off[:, 0] * np.cos(angle) - off[:, 1] * np.sin(angle)
        along = off[:, 0] * np.sin(angle) + off[:, 1] * np.cos(angle)
        scaled = np.stack([across, along, off[:, 2]], axis=1) / radii
        length = np.linalg.norm(scaled, axis=1)
        near.append(length * (length - 1.0) / np.maximum(np.linalg.norm(scaled / radii, axis=1), 1e-9))
    return np.asarray(-SOFT * np.logaddexp.reduce(-np.array(near) / SOFT, axis=0))


def _onto_surface(places: Points) -> Points:
    """Take a step of Newton's method along the gradient."""
    step, height = 1e-5, _height(places)
    slope = np.stack([_height(places + step * axis) - height for axis in np.eye(3)], axis=1) / step
    return np.asarray(places - (height / (slope**2).sum(axis=1))[:, None] * slope)


def _rim(spacing: float) -> Points:
    """Return points around the base, as far apart as others are on average."""
    angles = np.linspace(0.0, 2.0 * np.pi, 4000, endpoint=False)
    ways = np.stack([np.sin(angles), 0.0 * angles, np.cos(angles)], axis=1)
    low, high = np.zeros(len(angles)), np.full(len(angles), 2.0)
    for _ in range(40):
        middle = (low + high) / 2.0
        is_inside = _height(middle[:, None] * ways + [0.0, BASE, 0.0]) < 0.0
        low, high = np.where(is_inside, middle, low), np.where(is_inside, high, middle)
    curve = low[:, None] * ways + [0.0, BASE, 0.0]
    curve = np.append(curve, curve[:1], axis=0)
    run = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1)))
    places = np.linspace(0.0, run[-1], round(run[-1] / (1.3 * spacing)), endpoint=False)
    return np.stack([np.interp(places, run, along) for along in curve.T], axis=1)


def _far_apart(points: Points, spacing: float, n_first: int) -> list[int]:
    """Choose points, the first ones in any case, that are no nearer to each other than the spacing."""
    near = cKDTree(points).query_ball_point(points, spacing)
    is_free, chosen = np.ones(len(points), bool), []
    for k, around in enumerate(near):
        if k < n_first or is_free[k]:
            chosen.append(k)
            is_free[around] = False
    return chosen
