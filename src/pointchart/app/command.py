"""Controls of the page as the command line that they amount to."""

import os
import shlex
import subprocess
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from ..map.weights import WeightScheme
from .one_neighborhood import Connect

Rules = Callable[[str, str, str, str], tuple[Connect, WeightScheme]]


@dataclass(frozen=True, slots=True)
class Option:
    """An option of a command.

    Attributes
    ----------
    flag : str
        As `--domain`.
    help : str
    choices : tuple of str
        Its words, if not any will do.
    default : str
        Empty if the library chooses.
    is_switch : bool
        Whether it is given without a word.
    """

    flag: str
    help: str
    choices: tuple[str, ...] = ()
    default: str = ""
    is_switch: bool = False


@dataclass(frozen=True, slots=True)
class Commands:
    """What the page knows of the command line.

    Attributes
    ----------
    options : mapping of str to sequence of Option
        The options of each command.
    rules : callable
        ``rules(neighbors, k, radius, weights)``, words all, gives the functions that they name.
    """

    options: Mapping[str, Sequence[Option]]
    rules: Rules

    def option(self, command: str, flag: str) -> Option | None:
        """Return an option of a command, None if it has no such option."""
        return next((option for option in self.options[command] if option.flag == flag), None)


def given_words(values: Mapping[Option, str | bool]) -> list[str]:
    """Return the words of the options that differ from their defaults.

    Examples
    --------
    >>> domain, k = Option("--domain", "", ("circle", "square"), "circle"), Option("-k", "")
    >>> robust = Option("--robust", "", is_switch=True)
    >>> given_words({domain: "square", k: " ", robust: True})
    ['--domain', 'square', '--robust']
    """
    words = []
    for option, value in values.items():
        text = "" if isinstance(value, bool) else value.strip()
        if option.is_switch:
            words += [option.flag] if value else []
        elif text not in ("", option.default):
            words += [option.flag, text]
    return words


def shell_line(words: Sequence[str]) -> str:
    """Write words as a line for the shell of this system.

    Examples
    --------
    >>> shell_line(["pointchart", "mesh", "my scan.ply"])
    "pointchart mesh 'my scan.ply'"
    """
    return subprocess.list2cmdline(words) if os.name == "nt" else shlex.join(words)
