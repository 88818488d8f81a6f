"""A sculpted face with overhangs, made of formulas."""

import numpy as np

from pointchart.typing import Floats, Points

# Each feature pushes the head by a Gaussian: its place (x, y), its radii, and its push (x, y, z); the eyes are at
# y = 0.14, the mouth at y = -0.52. Those off the middle come in pairs.
FEATURES = {
    "nose ridge": (0, 0.08, 0.085, 0.25, 0, 0, 0.14),
    "nose tip": (0, -0.11, 0.13, 0.12, 0, -0.20, 0.17),
    "nostril": (0.135, -0.165, 0.07, 0.08, 0.035, -0.06, 0.09),
    "inner brow": (0.17, 0.38, 0.12, 0.085, 0, -0.04, 0.065),
    "brow": (0.38, 0.40, 0.16, 0.085, 0, -0.05, 0.075),
    "outer brow": (0.56, 0.32, 0.09, 0.09, 0, -0.03, 0.04),
    "eye socket": (0.31, 0.15, 0.23, 0.17, 0, 0.02, -0.13),
    "eyeball": (0.31, 0.14, 0.17, 0.12, 0, 0, 0.135),
    "upper lid": (0.30, 0.235, 0.15, 0.042, 0, -0.015, 0.05),
    "corner of the lid": (0.43, 0.185, 0.07, 0.05, 0, -0.01, 0.03),
    "lower lid": (0.31, 0.045, 0.14, 0.04, 0, 0, 0.03),
    "pupil": (0.31, 0.14, 0.045, 0.045, 0, 0, -0.04),
    "cheekbone": (0.47, -0.14, 0.2, 0.17, 0.03, 0.02, 0.07),
    "hollow cheek": (0.38, -0.45, 0.14, 0.18, 0, 0, -0.04),
    "upper lip": (0.085, -0.435, 0.11, 0.06, 0, 0, 0.06),
    "lower lip": (0, -0.62, 0.16, 0.075, 0, 0, 0.065),
    "mouth": (0, -0.52, 0.24, 0.055, 0, 0, -0.04),
    "corner of the mouth": (0.25, -0.515, 0.06, 0.06, 0, 0.01, -0.04),
    "philtrum": (0, -0.35, 0.04, 0.07, 0, 0, -0.025),
    "groove of the chin": (0, -0.75, 0.20, 0.07, 0, 0, -0.03),
    "chin": (0, -0.91, 0.25, 0.15, 0, -0.04, 0.10),
}


def sculpted_face(s: Floats, t: Floats) -> Points:
    """Evaluate a face framed by locks of hair: no height field.

    The nose hangs over the lip, the hair stands steeply over the forehead, and the sides turn away by more than a right
    angle.

    Parameters
    ----------
    s, t : (...) float64
        From 0 to 1: s across the face, from its right cheek to its left one; t from the neck up to the hair.

    Returns
    -------
    (..., 3) float64
        The face looks along z, and y is up; it is about 2.1 wide and 2.6 high.

    Examples
    --------
    It is symmetric:

    >>> import numpy as np
    >>> left, right = sculpted_face(np.array([0.3, 0.7]), np.array([0.5, 0.5]))
    >>> bool(np.allclose(left * [-1, 1, 1], right))
    True
    """
    across, up = 2 * s - 1, 2 * t - 1
    turn, tilt = np.radians(105) * across, np.radians(74) * up
    x, y = 1.22 * across, 1.2 * up
    head = _head(turn, tilt, up)
    for center_x, center_y, radius_x, radius_y, *push in FEATURES.values():
        bump_y = np.exp(-(((y - center_y) / radius_y) ** 2))
        for side in (1, -1) if center_x else (1,):
            bump = bump_y * np.exp(-(((side * x - center_x) / radius_x) ** 2))
            head += bump[..., None] * (np.array(push) * [side, 1, 1])
    return head + _hair(x, y, turn, tilt)


def _head(turn: Floats, tilt: Floats, up: Floats) -> Points:
    girth = np.cos(tilt) ** 0.6
    jaw = 1 - 0.14 * np.exp(-(((up + 1) / 0.5) ** 2))
    return np.stack([0.84 * girth * jaw * np.sin(turn), 1.22 * np.sin(tilt), 0.85 * girth * np.cos(turn)], axis=-1)


def _hair(x: Floats, y: Floats, turn: Floats, tilt: Floats) -> Points:
    """Raise locks outside an oval, and push their edge over it."""
    oval_x, oval_y = x / 0.80, (y + 0.08) / 0.88
    radius, angle = np.hypot(oval_x, oval_y), np.arctan2(oval_x, oval_y)
    above_jaw = _step((y + 0.45) / 0.10)
    lock = np.cos(16 * angle - 9 * (radius - 1) * np.tanh(3 * angle))
    rise = above_jaw * _step((radius - 0.995) / 0.03) * (0.20 + 0.04 * lock)
    lean = above_jaw * np.exp(-(((radius - 1.07) / 0.11) ** 2)) * (0.21 + 0.02 * lock)
    outward = np.stack([np.sin(turn) * np.cos(tilt), np.sin(tilt), np.cos(turn) * np.cos(tilt)], axis=-1)
    inward = np.stack([-np.sin(angle), -np.cos(angle), np.zeros_like(angle)], axis=-1)
    hair: Points = rise[..., None] * outward + lean[..., None] * inward
    return hair


def _step(x: Floats) -> Floats:
    rise: Floats = (1 + np.tanh(x / 2)) / 2
    return rise
