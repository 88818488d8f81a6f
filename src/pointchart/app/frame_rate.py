"""Whether a browser keeps pace while its camera moves."""

import asyncio
import time
from collections import deque
from collections.abc import Callable
from itertools import pairwise
from statistics import median

LATEST = 7  # moves that are looked at; pauses of the hand among them hardly change the median of the waits between
FAST, SLOW = 0.04, 0.06  # median waits, in seconds, up to which a browser keeps pace, and above which it does not
GAIN = 0.5  # share of the waits that is left where less is drawn, above which it was not the drawing that took long
TRIALS = 3  # times that less is drawn to see whether it helps
REST = 1.0  # seconds without a move after which the camera rests; longer than slow frames


class Pace:
    """Tells when the camera of a browser that draws slowly begins to move, and when it rests.

    A browser tells of a move once a frame, but only while the hand moves: a hand may be slow where the browser is not.
    So a browser that has been fast is taken for fast, and waits for the hand's if they are as long with less to draw;
    after some trials it stays at that.

    Parameters
    ----------
    tell : callable
        Called with whether less should be drawn.
    """

    def __init__(self, tell: Callable[[bool], object]) -> None:
        self._tell = tell
        self._latest: deque[float] = deque(maxlen=LATEST)
        self._is_slow, self._is_sure, self._n_trials = False, False, 0
        self._before = 0.0  # median wait that has told that it is slow
        self._rest: asyncio.TimerHandle | None = None

    async def moved(self) -> None:
        """Take note of a move now."""
        if not self.note(time.monotonic()):
            return
        if self._rest is None:
            self._tell(True)
        else:
            self._rest.cancel()
        self._rest = asyncio.get_running_loop().call_later(REST, self._end)

    def note(self, now: float) -> bool:
        """Take note of a move at a time in seconds, and return whether the browser is slow.

        Examples
        --------
        >>> slow, fast = Pace(print), Pace(print)
        >>> [slow.note(0.3 * frame) for frame in range(10)].index(True)
        6
        >>> any(fast.note(0.02 * frame if frame < 9 else 0.3 * frame) for frame in range(99))
        False
        """
        self._latest.append(now)
        if len(self._latest) == LATEST and not self._is_sure:
            self._judge(median(after - before for before, after in pairwise(self._latest)))
        return self._is_slow

    def _judge(self, wait: float) -> None:
        if self._is_slow:
            self._is_slow = wait <= GAIN * self._before
            self._is_sure = self._is_slow or self._n_trials == TRIALS
            self._latest.clear()
        elif wait > SLOW:
            self._is_slow, self._before, self._n_trials = True, wait, self._n_trials + 1
            self._latest.clear()
        elif wait < FAST:
            self._is_sure = True

    def _end(self) -> None:
        self._rest = None
        self._tell(False)
