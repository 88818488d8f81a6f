"""From where a figure looks at a scan; the same place for its cloud, its mesh and its surface."""

import numpy as np

from ..errors import InputError
from ..picture import rotation
from ..quality import area_vectors
from ..scene import OBLIQUE
from ..typing import Floats, Points, Triangles

AXES = {"x": 0, "y": 1, "z": 2}
FACING = 0.8  # cosine to the line of sight from which on an axis cannot be upwards in the figure
ONE_SIDED = 0.05  # share of the area of a mesh that has to face one way to tell its outside
BULGING = 0.15  # correlation of height and squared distance from the middle that tells the outside of a cloud


def camera(
    points: Points,
    triangles: Triangles | None = None,
    *,
    view: tuple[float, float] | None = None,
    up: str | None = None,
) -> Floats:
    """Choose the directions that are to the right, upwards and towards us in a figure.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array, optional
        They tell the outside; otherwise it is where the cloud bulges to, and above for level ones.
    view : (float, float), optional
        By how many degrees we walk around the scan, anticlockwise seen from above, and look down on it. (0, 0) looks
        along y where z is upwards, against z where y is. By default we look at the outside of the mean plane, turned
        and tilted a little.
    up : str, optional
        The axis of the file that is upwards, "x", "y" or "z"; by default z, or y where the mean plane faces along z.

    Returns
    -------
    (3, 3) float64 array, its rows are unit vectors.

    Raises
    ------
    InputError
        If there is no such axis, or the angles are not finite.

    Examples
    --------
    >>> flat = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    >>> camera(flat, view=(0, 90), up="z").round(9) + 0.0
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    if up is not None and up not in AXES:
        raise InputError(f"the axis upwards is '{up}'; it has to be one of {', '.join(AXES)}")
    if view is not None and not np.isfinite(view).all():
        raise InputError(f"the view is {view[0]:g}, {view[1]:g}; two finite angles in degrees are needed")
    normal = _outside(points, triangles)
    # An axis that is asked for cannot be upwards where we look along it; then the next one is.
    names = [name for name in (up, "z", "y") if name is not None]
    upwards = next(name for name in names if abs(normal[AXES[name]]) <= FACING)
    if view is None:
        across = np.cross(np.eye(3)[AXES[upwards]], normal)
        across /= np.linalg.norm(across)
        return np.asarray(OBLIQUE @ np.stack([across, np.cross(normal, across), normal]))
    above = np.eye(3)[AXES[up or upwards]]
    right = np.eye(3)[1 if above[0] else 0]
    return np.asarray(rotation(-view[0], view[1]) @ np.stack([right, above, np.cross(right, above)]))


def _outside(points: Points, triangles: Triangles | None) -> Floats:
    """Return the normal of the mean plane, on the outside."""
    centred = points - points.mean(axis=0)
    centred /= np.abs(centred).max() or 1.0
    normal = np.linalg.eigh(centred.T @ centred)[1][:, 0]
    if triangles is not None:
        vectors = area_vectors(points, triangles)
        facing = float(vectors.sum(axis=0) @ normal)
        if abs(facing) > ONE_SIDED * np.linalg.norm(vectors, axis=1).sum():
            return normal if facing > 0.0 else -normal
    height = centred @ normal
    off = (centred**2).sum(axis=1) - height**2
    spread = float(height.std() * off.std())
    bulge = -float(np.mean(height * (off - off.mean())))
    side = bulge if abs(bulge) > BULGING * spread else normal[np.argmax(np.abs(normal))]
    return normal if side > 0.0 else -normal
