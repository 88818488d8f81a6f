"""A run beside the main thread, which stays free to hear Ctrl-C while a kernel computes."""

import gc
import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Thread

at_interrupt: list[Callable[[], object]] = []  # what else has to end where the process ends at once


def interruptibly(run: Callable[[], None]) -> None:
    """Run in a thread of its own, and raise here what it raises.

    Raises
    ------
    KeyboardInterrupt
        At once, when it comes: the run goes on until the process ends, but its temporary files are gone.
    """
    raised: list[BaseException] = []

    def call() -> None:
        try:
            run()
        except BaseException as reason:
            raised.append(reason)

    thread = Thread(target=call, daemon=True)
    thread.start()
    try:
        thread.join()
    except KeyboardInterrupt:
        from ..io.output import remove_temporaries

        for end in at_interrupt:
            end()
        remove_temporaries()
        raise
    if raised:
        raise raised[0]


@contextmanager
def ending_quietly() -> Iterator[None]:
    """End this process without a word where Ctrl-C or another signal to end comes in the body: 128 and its number."""
    status = 130

    def end(number: int, _: object) -> None:
        nonlocal status
        status = 128 + number
        raise KeyboardInterrupt

    # What is imported stays: to look for garbage in it again and again, at the end as well, is a fifth of a short run.
    gc.set_threshold(100_000)
    try:
        for name in ("SIGTERM", "SIGHUP"):
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) == signal.SIG_DFL:  # nohup has the latter ignored
                signal.signal(number, end)
        yield
    except KeyboardInterrupt:
        # Not by way of Python's end, which waits for the thread that still computes.
        sys.stderr.flush()
        os._exit(status)
    finally:
        gc.freeze()
