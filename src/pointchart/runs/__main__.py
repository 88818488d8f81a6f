"""The process of a run: reads one from stdin, executes it, writes what happens to stdout; see `process`."""

import os
import pickle
import sys
import traceback
from typing import Any, BinaryIO

from .interruptible import ending_quietly, interruptibly


def main() -> None:
    """Execute the run that a `RunProcess` hands over."""
    events = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever else is printed is no event
    with ending_quietly():
        interruptibly(lambda: _serve(sys.stdin.buffer, events))


def _serve(source: BinaryIO, events: BinaryIO) -> None:
    from ..clock import StageClock
    from ..errors import NO_MEMORY, PointchartError, SolveError
    from .usual_shares import share_over

    def tell(event: Any) -> None:
        pickle.dump(event, events)
        events.flush()

    run, folder = pickle.load(source)
    if folder is not None:
        os.chdir(folder)
    try:
        tell(run.execute(StageClock(lambda name: tell((name, share_over(name))))))
    except PointchartError as error:
        tell(error)
    except MemoryError:
        tell(SolveError(NO_MEMORY))
    except Exception:
        traceback.print_exc()
        raise SystemExit(1) from None


if __name__ == "__main__":
    main()
