"""The plane over which a surface is a height field, as axes in space."""

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError
from ..typing import UV, Floats, Points


def axes_over(normal: ArrayLike) -> Floats:
    """Return the axes of a plane and its unit normal as rows of a rotation, (3, 3); those of z are x and y.

    Parameters
    ----------
    normal : (3,) array
        Towards the side that is looked at.

    Raises
    ------
    InputError
        If it is no direction.

    Examples
    --------
    >>> axes_over([0, 0, 2])
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    up = np.asarray(normal, dtype=np.float64)
    length = np.linalg.norm(up) if up.shape == (3,) else 0.0
    if not 0.0 < length < np.inf:
        raise InputError(f"the normal of the plane is {up.tolist()}; three finite numbers are needed, not all zero")
    up = up / length
    # The axis that is farthest from the normal, taken into the plane: x for z.
    along = np.eye(3)[np.argmin(np.abs(up))]
    u = along - up * (along @ up)
    u /= np.linalg.norm(u)
    return np.array([u, np.cross(up, u), up])


def fitted_normal(points: Points) -> Floats:
    """Return the normal of the plane of least squares, (3,), upwards.

    Examples
    --------
    >>> fitted_normal(np.array([[0.0, 0, 0], [9, 0, 0], [0, 9, 0], [9, 9, 0.0]]))
    array([0., 0., 1.])
    """
    centered = points - points.mean(axis=0)
    normal = np.linalg.eigh(centered.T @ centered)[1][:, 0]
    return np.asarray(np.where(normal[2] < 0.0, -1.0, 1.0) * normal + 0.0)


def projected(points: Points, axes: Floats) -> tuple[UV, Floats]:
    """Return the coordinates of points in the plane, (n, 2), and their heights over it, (n,).

    Over x and y they are the coordinates themselves, to the last digit.
    """
    if np.array_equal(axes, np.eye(3)):
        return points[:, :2].copy(), points[:, 2].copy()
    turned = points @ axes.T
    return np.ascontiguousarray(turned[:, :2]), turned[:, 2]
