"""Whether a given boundary is in order."""

import numpy as np

from ..errors import InputError
from ..points.neighbors import search
from ..typing import Loop, Points

NEARBY_STEPS = 16  # that each is compared with: some eight along the loop, as many on a part that runs beside it
CROSSING = 0.3  # true boundaries of real scans stay above 0.59, runs in the wrong direction fall below 0.16


def check_order(points: Points, loop: Loop) -> None:
    """Check that a loop does not run to and fro: that no two of its steps could be exchanged for much shorter ones.

    Steps ab and cd of a loop may be replaced by ac and bd, with the part between them reversed. Where that takes less
    than three tenths of the length, the loop runs past the same place twice.

    Parameters
    ----------
    points : (n, 3) array
    loop : (b,) int64 array

    Raises
    ------
    InputError
        Naming the two steps.

    Examples
    --------
    >>> angle = np.arange(36) * np.pi / 18
    >>> ring = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    >>> check_order(ring, np.arange(36))
    >>> check_order(ring, np.r_[0:9, 27:8:-1, 28:36])
    Traceback (most recent call last):
        ...
    pointchart.errors.InputError: the boundary crosses itself: ...
    """
    a, b = loop, np.roll(loop, -1)
    count = min(NEARBY_STEPS, len(loop))
    place = np.arange(len(loop))
    from scipy.spatial import cKDTree

    other = search(cKDTree(points[a]), points[a], count)[1]
    c, d = a[other], b[other]
    apart = np.linalg.norm(points[a][:, None] - points[c], axis=2) + np.linalg.norm(
        points[b][:, None] - points[d], axis=2
    )
    length = np.linalg.norm(points[b] - points[a], axis=1)
    ratio = apart / (length[:, None] + length[other])
    # A step and the next share a point, so exchanging them would undo the loop; first and last are such, too.
    ratio[(np.abs(other - place[:, None]) % (len(loop) - 1)) <= 1] = np.inf
    worst = np.unravel_index(np.argmin(ratio), ratio.shape)
    if ratio[worst] < CROSSING:
        raise InputError(
            "the boundary crosses itself: its step from point {a} to {b} runs beside that from {c} to {d}; "
            "put its points in order",
            a=a[worst[0]],
            b=b[worst[0]],
            c=c[worst],
            d=d[worst],
        )
