"""From how far away the whole scan is seen, while a window changes its shape."""

import numpy as np

DISTANCE = 4.7  # from the middle of the scan, in a picture that is not narrow
SAME = 0.01  # share by which a distance may be off and still be the one that was set
SETTLING = 1.0  # seconds in which a browser may still tell of a distance that was set before


class Whole:
    """Keeps the whole scan in a picture until somebody comes nearer.

    Examples
    --------
    >>> whole = Whole()
    >>> whole.corrected(4.7, 0.5, now=0.0), whole.corrected(4.7, 0.25, now=0.1), whole.corrected(9.4, 0.25, now=0.2)
    (9.4, 18.8, 18.8)
    >>> whole.corrected(18.8, 0.25, now=0.3) is whole.corrected(7.0, 0.5, now=9.0) is None
    True
    """

    def __init__(self) -> None:
        self._set = [(DISTANCE, np.inf)]  # distances, each with the time until which a browser may still tell of it

    def corrected(self, away: float, aspect: float, now: float) -> float | None:
        """Return the distance that a camera should have instead of the one it has, None if it stays.

        Parameters
        ----------
        away : float
            From the middle of the scan.
        aspect : float
            Width of the picture over its height.
        now : float
            Time in seconds.
        """
        self._set = [(distance, end) for distance, end in self._set if now <= end]
        whole = whole_distance(aspect)
        if not any(abs(away - distance) < SAME * distance for distance, _ in self._set):
            return None
        if whole != self._set[-1][0]:
            self._set = [(distance, min(end, now + SETTLING)) for distance, end in self._set] + [(whole, np.inf)]
        return None if abs(away - whole) < SAME * whole else whole


def whole_distance(aspect: float) -> float:
    """Return from how far away the whole scan is seen: from farther where the picture is narrow.

    Examples
    --------
    >>> whole_distance(2.0), whole_distance(0.5)
    (4.7, 9.4)
    """
    return DISTANCE / min(1.0, aspect)
