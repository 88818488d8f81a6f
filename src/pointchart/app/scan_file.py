"""The file of the scan, which has to stay as it was read while its page is open."""

from pathlib import Path

from ..errors import InputError


class ScanFile:
    """A file as it is now.

    Parameters
    ----------
    path : Path
    """

    def __init__(self, path: Path) -> None:
        self._path, self._seen = path, _stamp(path)

    def check_unchanged(self) -> None:
        """Check that the file is as it was.

        Raises
        ------
        InputError
        """
        try:
            is_same = _stamp(self._path) == self._seen
        except OSError:
            is_same = False
        if not is_same:
            raise InputError(f"{self._path} has changed since this page was opened; start pointchart view again")


def _stamp(path: Path) -> tuple[int, int]:
    seen = path.stat()
    return seen.st_mtime_ns, seen.st_size
