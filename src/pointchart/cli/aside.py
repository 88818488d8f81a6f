"""A run beside the main thread, which stays free to hear Ctrl-C while a kernel computes."""

from collections.abc import Callable
from threading import Thread

at_interrupt: list[Callable[[], object]] = []  # what else has to end where the process ends at once


def aside(run: Callable[[], None]) -> None:
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
