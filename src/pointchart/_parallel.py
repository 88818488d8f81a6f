"""Kernels over ranges of points, on every core that the process may use."""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

CHUNK = 8192


def n_threads() -> int:
    """Return the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def over_ranges(kernel: Callable[[int, int], object], n: int) -> None:
    """Call `kernel(first, last)` for ranges that cover 0..n; the kernel must release the interpreter's lock.

    >>> seen = []
    >>> over_ranges(lambda first, last: seen.append((first, last)), 3)
    >>> seen
    [(0, 3)]
    """
    ranges = [(first, min(first + CHUNK, n)) for first in range(0, n, CHUNK)]
    pool = ThreadPoolExecutor(n_threads())
    try:
        for done in [pool.submit(kernel, first, last) for first, last in ranges]:
            done.result()
    finally:
        # After an interrupt nothing new begins, and the few ranges under way end before their arrays can go.
        pool.shutdown(cancel_futures=True)
