"""Kernels over ranges of points, on every core that the process may use, or on fewer."""

import math
import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from pathlib import Path
from typing import Self

# Rows of a range: a choice. Few enough that all cores end together, many enough that to hand one out costs nothing.
CHUNK, LEAST_CHUNK = 8192, 1024
FEWEST = 8  # blocks: for less than 16,384 rows of a matrix, to wake another thread costs more than it saves
_given: ContextVar[int | None] = ContextVar("_given", default=None)


def n_threads() -> int:
    """Return the number of threads: as given to `on_threads`, or that of the cores that this process may use."""
    return _given.get() or usable_cores()


@contextmanager
def on_threads(n: int | None) -> Iterator[None]:
    """Run the body on `n` threads, those of the linear algebra included; None for the cores that may be used.

    >>> with on_threads(3):
    ...     n_threads()
    3
    """
    from threadpoolctl import threadpool_limits

    before = _given.set(n)
    try:
        with threadpool_limits(n_threads()):
            yield
    finally:
        _given.reset(before)


@cache
def usable_cores() -> int:
    """Return the number of cores that this process may use, by its affinity and by the quota of its control group."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return max(1, math.ceil(min(cores, core_quota())))


def core_quota(groups: Path = Path("/sys/fs/cgroup"), membership: Path = Path("/proc/self/cgroup")) -> float:
    """Return how many cores' time the control groups of this process (version 2) give it; infinity without a quota."""
    line = membership.read_text() if membership.exists() else ""
    group = groups / line.partition("0::/")[2].strip()
    quota = math.inf
    for limit in (folder / "cpu.max" for folder in (group, *group.parents)):
        allowed, period = limit.read_text().split() if limit.exists() else ("max", "")
        if allowed != "max":
            quota = min(quota, int(allowed) / int(period))
    return quota


def over_ranges(kernel: Callable[[int, int], object], n: int) -> None:
    """Call `kernel(first, last)` for ranges that cover 0..n; the kernel must release the interpreter's lock.

    >>> seen = []
    >>> over_ranges(lambda first, last: seen.append((first, last)), 3)
    >>> seen
    [(0, 3)]
    """
    chunk = min(CHUNK, max(LEAST_CHUNK, math.ceil(n / (2 * n_threads()))))
    ranges = [(first, min(first + chunk, n)) for first in range(0, n, chunk)]
    if len(ranges) < 2:
        for first, last in ranges:
            kernel(first, last)
        return
    pool = ThreadPoolExecutor(n_threads())
    try:
        for done in [pool.submit(kernel, first, last) for first, last in ranges]:
            done.result()
    finally:
        # After an interrupt nothing new begins, and the few ranges under way end before their arrays can go.
        pool.shutdown(cancel_futures=True)


class Team:
    """Threads that stay for many short calls; to be used as a context.

    >>> seen = []
    >>> with Team() as team:
    ...     team(3, 5, lambda first, last: seen.append((first, last)))
    >>> seen
    [(0, 3)]
    """

    def __init__(self) -> None:
        self._size = n_threads()
        self._pool = ThreadPoolExecutor(self._size)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._pool.shutdown(cancel_futures=True)

    def __call__(self, n: int, block: int, kernel: Callable[..., object], *arguments: object) -> None:
        """Call `kernel(*arguments, first, last)` for a range a thread, which together cover 0..n.

        Ranges are of whole blocks, and of `FEWEST` at least where there are several: another thread has to be woken.
        """
        share = max(-(-n // (block * self._size)), FEWEST) * block
        calls = [self._pool.submit(kernel, *arguments, i, min(i + share, n)) for i in range(share, n, share)]
        kernel(*arguments, 0, min(share, n))
        for call in calls:
            call.result()
