"""The time that stages take, and word of them to whoever listens."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager


class StageClock:
    """Time named stages one after the other.

    Parameters
    ----------
    announce : callable, optional
        Called with the name of each stage as it begins.

    Examples
    --------
    >>> clock = StageClock(print)
    >>> with clock("solve"):
    ...     pass
    solve
    >>> list(clock.seconds)
    ['solve']
    """

    def __init__(self, announce: Callable[[str], None] | None = None) -> None:
        self.seconds: dict[str, float] = {}
        self._announce = announce

    @contextmanager
    def __call__(self, name: str) -> Iterator[None]:
        """Time the body under `name`; stages that come again add up."""
        if self._announce is not None:
            self._announce(name)
        start = time.perf_counter()
        try:
            yield
        finally:
            self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - start
