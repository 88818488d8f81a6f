"""Where the compiled kernels are kept, so that a machine compiles them once, even where the package is read-only."""

import os
import stat
import sys
from collections.abc import Iterator


def choose_folder() -> None:
    """Let numba keep kernels among the temporary files where it can write into no folder of its own choice."""
    if any(map(_can_be_written, _choices_of_numba())):
        return
    os.environ["NUMBA_CACHE_DIR"] = _private_folder()
    if "numba" in sys.modules:
        sys.modules["numba"].config.reload_config()


def _choices_of_numba() -> Iterator[str]:
    if given := os.environ.get("NUMBA_CACHE_DIR"):
        yield given
    yield os.path.join(os.path.dirname(__file__), "_kernels", "mesh", "__pycache__")
    if sys.platform == "win32":
        yield os.environ.get("LOCALAPPDATA", "")
    elif sys.platform == "darwin":
        yield os.path.expanduser("~/Library/Caches/numba")
    else:
        yield os.path.join(os.environ.get("XDG_CACHE_HOME", os.path.expanduser("~/.cache")), "numba")


def _can_be_written(folder: str) -> bool:
    """Say whether files can be made in a folder, or in the nearest one above it where it is still to be made."""
    folder = os.path.abspath(folder)
    while not os.path.lexists(folder):
        folder = os.path.dirname(folder)
    return os.path.isdir(folder) and os.access(folder, os.W_OK | os.X_OK)


def _private_folder() -> str:
    """Return a folder that nobody else can write into, since what lies in it is run."""
    import tempfile
    from contextlib import suppress

    user = os.getuid() if hasattr(os, "getuid") else 0
    folder = os.path.join(tempfile.gettempdir(), f"pointchart-{user}")
    with suppress(FileExistsError):
        os.mkdir(folder, 0o700)
    found = os.lstat(folder)
    is_ours = stat.S_ISDIR(found.st_mode) and found.st_uid == user and stat.S_IMODE(found.st_mode) == 0o700
    return folder if is_ours else tempfile.mkdtemp(prefix="pointchart-")
