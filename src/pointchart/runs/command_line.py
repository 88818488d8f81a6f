"""A run as the command line that amounts to it."""

import os
import shlex
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .options import Option, options_of, values_of

if TYPE_CHECKING:
    from .commands import Run
    from .view_run import ViewRun


def words_of(run: "Run | ViewRun") -> list[str]:
    """Return the words behind ``pointchart``: the command, arguments, what has to be given, then what is no default.

    Examples
    --------
    >>> from pointchart.runs.figure_run import FigureLook, FigureRun
    >>> look = FigureLook(view="-30,20", edges=False)
    >>> words_of(FigureRun(kind="mesh", source=Path("m.ply"), out=Path("m.pdf"), look=look))
    ['figure', 'mesh', 'm.ply', '-o', 'm.pdf', '--no-edges', '--view=-30,20']
    """
    options, values = options_of(type(run)), values_of(run)
    words = [run.command, *(_text(values[option.name]) for option in options if not option.flags)]
    for option in sorted(options, key=lambda option: not option.is_required):
        value = values[option.name]
        if option.flags and value is not None and value != option.default:
            words += _option_words(option, value)
    return words


def shell_line(words: Sequence[str]) -> str:
    """Write words as a line for the shell of this system.

    Examples
    --------
    >>> shell_line(["pointchart", "mesh", "my scan.ply"])
    "pointchart mesh 'my scan.ply'"
    """
    return subprocess.list2cmdline(words) if os.name == "nt" else shlex.join(words)


def command_line(run: "Run | ViewRun") -> str:
    """Return the line for the shell of this system that repeats a run."""
    return shell_line(["pointchart", *words_of(run)])


def _option_words(option: Option, value: Any) -> list[str]:
    flag, text = option.flags[-1], _text(value)
    if option.is_switch:
        yes, _, no = flag.partition("/")
        return [yes if value else no]
    # A word that begins as a flag does is none where it hangs on one.
    return [f"{flag}={text}"] if text.startswith("-") else [flag, text]


def _text(value: Any) -> str:
    if isinstance(value, Path):
        return f".{os.sep}{value}" if str(value).startswith("-") else str(value)
    if isinstance(value, float):
        return repr(value).removesuffix(".0")
    return str(value)
