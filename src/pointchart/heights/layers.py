"""Points over one another: trees over ground, roofs beside streets."""

import numpy as np
from scipy.spatial import cKDTree

from ..errors import InputError, Remedy
from ..typing import Points

# Steps to the nearest point in the plane that rise over this many spacings lead from one layer to another: slopes of 76
# degrees, which of ground only cliffs have.
STEEP = 4.0
LEAST = 0.1  # of all steps, from which on layers are no cliffs: in a wood or a town it is a third, on a slope none
_SAMPLE = 20_000  # points whose nearest one is looked at


def layered_share(points: Points) -> float:
    """Return the share of points whose nearest one in the plane lies in another layer, in [0, 1].

    Examples
    --------
    >>> ground = np.stack(np.meshgrid(np.arange(20.0), np.arange(20.0), [0.0]), axis=-1).reshape(-1, 3)
    >>> layered_share(ground), layered_share(np.concatenate([ground, ground + [0.1, 0, 30]]))
    (0.0, 1.0)
    """
    tree = cKDTree(points[:, :2])
    sample = points[:: max(1, len(points) // _SAMPLE)]
    distances, nearest = tree.query(sample[:, :2], k=2)
    spacing = np.sqrt(np.prod(np.ptp(points[:, :2], axis=0)) / len(points))
    rises = np.abs(points[nearest[:, 1], 2] - points[nearest[:, 0], 2])
    return float(np.mean(rises > STEEP * np.maximum(spacing, distances[:, 1])))


def check_one_layer(points: Points, classes: str) -> None:
    """Check that points of several classes do not stand over one another.

    Parameters
    ----------
    points : (n, 3) array
        Heights along z.
    classes : str
        The classes with their numbers, for the message.

    Raises
    ------
    InputError
    """
    share = layered_share(points)
    if share > LEAST:
        raise InputError(
            f"the scan holds points of classes {classes} over one another: {share:.0%} of its points have the nearest "
            f"one in the plane over {STEEP:.0f} spacings higher or lower",
            remedies=[Remedy.choose_classes, Remedy.take_heights],
        )
