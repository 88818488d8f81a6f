"""The command ``pointchart``, and ``python -m pointchart``."""

import gc
import os
import sys


def main() -> None:
    """Run the command line; Ctrl-C ends it quietly from the first import on."""
    # What is imported stays: to look for garbage in it again and again, at the end as well, is a fifth of a short run.
    gc.set_threshold(100_000)
    try:
        from .cli import main as run
        from .cli.aside import aside

        aside(run)
    except KeyboardInterrupt:
        # Not by way of Python's end, which waits for the thread that still computes.
        sys.stderr.flush()
        os._exit(130)
    finally:
        gc.freeze()


if __name__ == "__main__":
    main()
