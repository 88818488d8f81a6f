"""Output files: checked before a run, written beside the target and renamed, so that no half file is ever left."""

import os
import secrets
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from ..errors import FormatError, InputError
from .source import AnyPath

_temporaries: set[Path] = set()


def check_output(path: AnyPath, *, suffixes: Sequence[str], inputs: Iterable[AnyPath] = ()) -> Path:
    """Check before a long run that its result can be written.

    Parameters
    ----------
    path
        The file that is to be written; it may exist.
    suffixes
        Suffixes that are allowed, as `.ply`.
    inputs
        Files that the run reads, which the output must not replace.

    Returns
    -------
    The path.

    Raises
    ------
    FormatError
        The suffix is not allowed, or the folder is missing or cannot be written to.
    InputError
        The output is one of the inputs, also by way of a link.
    """
    check_suffix(path, suffixes)
    target = Path(path)
    folder = _resolved(target).parent
    if not folder.exists():
        raise FormatError(f"{path}: the folder {folder} does not exist; create it first")
    if not folder.is_dir():
        raise FormatError(f"{path}: {folder} is a file and not a folder; choose another output")
    if target.is_dir():
        raise FormatError(f"{path}: this is a folder; name a file in it")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise FormatError(f"{path}: there is no permission to write to the folder {folder}; choose another output")
    if target.exists() and not os.access(target, os.W_OK):
        raise FormatError(f"{path}: the file exists and is read-only; remove it or choose another output")
    for source in inputs:
        is_same = target.exists() and Path(source).exists() and target.samefile(source)
        if is_same or _resolved(target) == _resolved(Path(source)):
            raise InputError(f"{path}: the output is also {source}, which would be lost; choose another output")
    return target


def check_suffix(path: AnyPath, suffixes: Iterable[str]) -> str:
    """Return the suffix of a file that is to be written, in lower case, if it is one of those that can be.

    >>> check_suffix("mesh.PLY", [".obj", ".ply"])
    '.ply'
    """
    suffix = Path(path).suffix
    if suffix.lower() not in suffixes:
        known = ", ".join(suffixes)
        raise FormatError(f"{path}: the suffix '{suffix}' cannot be written here; choose one of {known}")
    return suffix.lower()


@contextmanager
def replacing(path: AnyPath) -> Iterator[Path]:
    """Give a temporary path beside `path`, and rename it onto `path` when the block has ended well.

    A block that raises, Ctrl-C included, leaves the old file as it was and no temporary file.

    Parameters
    ----------
    path
        The file to write. A link is followed, so that it stays a link.

    Yields
    ------
    A hidden path in the same folder with the same suffix; the block must create that file.

    Raises
    ------
    FormatError
        The system refuses: the disk is full, or the folder is missing or read-only.

    Examples
    --------
    >>> import tempfile
    >>> target = Path(tempfile.mkdtemp()) / "a.txt"
    >>> with replacing(target) as temporary:
    ...     _ = temporary.write_text("whole")
    >>> target.read_text(), temporary.exists()
    ('whole', False)
    """
    target = _resolved(path)
    temporary = target.with_name(f".{target.stem}.{secrets.token_hex(4)}{target.suffix}")
    _temporaries.add(temporary)
    try:
        yield temporary
        os.replace(temporary, target)
    except OSError as error:
        reason = error.strerror or str(error)
        raise FormatError(f"{path}: it cannot be written ({reason}); free the disk or choose another output") from error
    finally:
        _remove(temporary)


def remove_temporaries() -> None:
    """Remove what blocks of `replacing` have begun: for a process that ends in the middle of one."""
    for temporary in list(_temporaries):
        _remove(temporary)


def _remove(temporary: Path) -> None:
    with suppress(OSError):
        temporary.unlink(missing_ok=True)
    _temporaries.discard(temporary)


def _resolved(path: AnyPath) -> Path:
    return Path(os.path.realpath(path))
