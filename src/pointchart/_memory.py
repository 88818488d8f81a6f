"""Whether a run fits into memory, told before it starts, and how much it took."""

import sys
from pathlib import Path

from .errors import InputError

BYTES_A_POINT = 900  # at the peak of a whole run, over the scan itself: 790 at a million points, 623 at ten millions
FEW = 1_000_000  # points that are not worth asking for


def check_room(n_points: int) -> None:
    """Check that there is memory for a run on that many points, where the system tells how much is free.

    Raises
    ------
    InputError
        Saying how much is needed and how much there is.

    Examples
    --------
    >>> check_room(1000)
    """
    need = n_points * BYTES_A_POINT
    free = free_bytes() if n_points > FEW else None
    if free is not None and need > free:
        raise InputError(
            f"{n_points} points need about {need / 1e9:.1f} GB of memory, and {free / 1e9:.1f} GB are free; close "
            "other programs, thin the scan or cut it into parts"
        )


def peak_memory_mb() -> int | None:
    """Return the largest resident memory of this process so far, in MiB; None where the system does not tell."""
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return int(peak // (1024 * 1024 if sys.platform == "darwin" else 1024))


def free_bytes() -> int | None:
    """Return how much memory this process may still take: what the machine and its group of processes have left.

    None where the system does not tell.
    """
    left = [room for room in (_free_of_machine(), _free_of_group()) if room is not None]
    return min(left, default=None)


def _free_of_machine() -> int | None:
    try:
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
    except OSError:
        return None
    found = [line.split() for line in lines if line.startswith("MemAvailable:")]
    return 1024 * int(found[0][1]) if found else None


def _free_of_group(groups: Path = Path("/sys/fs/cgroup"), membership: Path = Path("/proc/self/cgroup")) -> int | None:
    """Return what the control groups of this process (version 2) leave it; None without a limit."""
    line = membership.read_text() if membership.exists() else ""
    group = groups / line.partition("0::/")[2].strip()
    left = []
    for folder in (group, *group.parents):
        limit = folder / "memory.max"
        if limit.exists() and (most := limit.read_text().strip()).isdigit():
            left.append(max(int(most) - int((folder / "memory.current").read_text()), 0))
    return min(left, default=None)
