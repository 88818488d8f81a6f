"""The command ``pointchart``, and ``python -m pointchart``."""

import gc
import os
import signal
import sys


def main() -> None:
    """Run the command line; Ctrl-C, or another signal to end, ends it quietly from the first import on."""
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
        from .cli import main as run
        from .cli.aside import aside

        aside(run)
    except KeyboardInterrupt:
        # Not by way of Python's end, which waits for the thread that still computes.
        sys.stderr.flush()
        os._exit(status)
    finally:
        gc.freeze()


if __name__ == "__main__":
    main()
