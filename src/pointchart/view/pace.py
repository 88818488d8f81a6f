"""Whether a browser keeps pace while its camera moves."""

import asyncio
import time
from collections import deque
from collections.abc import Callable
from itertools import pairwise

LATEST, PAUSES = 7, 2  # frames that are looked at, and how many of the waits between them may be the hand's
SLOW = 0.06  # seconds from one frame to the next from which on a browser is slow
REST = 1.0  # seconds without a move after which the camera rests; frames that are very slow must not take it


class Pace:
    """Tells when the camera of a browser that draws slowly begins to move, and when it rests.

    Parameters
    ----------
    tell : callable
        Called with whether less should be drawn.
    """

    def __init__(self, tell: Callable[[bool], object]) -> None:
        self._tell = tell
        self._latest: deque[float] = deque(maxlen=LATEST)
        self._is_slow = False
        self._rest: asyncio.TimerHandle | None = None

    async def moved(self, _: object) -> None:
        """Take note of a move; a browser tells of one a frame."""
        if not self.note(time.monotonic()):
            return
        if self._rest is None:
            self._tell(True)
        else:
            self._rest.cancel()
        self._rest = asyncio.get_running_loop().call_later(REST, self._end)

    def note(self, now: float) -> bool:
        """Take note of a move at a time in seconds, and return whether the browser is slow: it stays so once it is.

        Examples
        --------
        >>> slow, fast = Pace(print), Pace(print)
        >>> [slow.note(0.3 * frame) for frame in range(10)].index(True)
        6
        >>> any(fast.note(0.3 * (frame // 5) + 0.02 * frame) for frame in range(99))
        False
        """
        self._latest.append(now)
        if not self._is_slow and len(self._latest) == LATEST:
            waits = sorted(after - before for before, after in pairwise(self._latest))[:-PAUSES]
            self._is_slow = sum(waits) > SLOW * len(waits)
        return self._is_slow

    def _end(self) -> None:
        self._rest = None
        self._tell(False)
