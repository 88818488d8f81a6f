"""What a run came to, as a record that text, JSON, page and app render."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import PointchartError


@dataclass(frozen=True, slots=True)
class Check:
    """A thing that was checked or measured.

    Attributes
    ----------
    name : str
    passed : bool or None
        None for what was measured only.
    detail : str
        The fault of what has not passed, or the measure.
    """

    name: str
    passed: bool | None
    detail: str = ""

    @property
    def text(self) -> str:
        """The check in words, with its fault if it has one.

        >>> Check("one part", True).text, Check("one part", False, "there are 2").text
        ('one part', 'one part: there are 2')
        >>> Check("longest edge", None, "1.5 local spacings").text
        'longest edge 1.5 local spacings'
        """
        if self.passed is None:
            return f"{self.name} {self.detail}"
        return self.name if self.passed else f"{self.name}: {self.detail}"


@dataclass(frozen=True, slots=True)
class Note:
    """A sentence on a run.

    Attributes
    ----------
    text : str
    is_minor : bool
        Whether it is one of a list that may be cut short, the largest first.
    size : float
        By which minor notes are ranked.
    """

    text: str
    is_minor: bool = False
    size: float = 0.0


@dataclass(frozen=True, slots=True)
class Stage:
    """A stage of a run and its seconds."""

    name: str
    seconds: float


@dataclass(frozen=True, slots=True)
class WrittenFile:
    """A file that a run wrote.

    Attributes
    ----------
    path : Path
    role : str
        The option that names it, as `out` or `html`.
    holds : str
        What is in it; may be empty where its name says all.
    is_told : bool
        Whether the text of the report has a line on it.
    """

    path: Path
    role: str
    holds: str = ""
    is_told: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class RunReport:
    """What a run came to.

    Attributes
    ----------
    command : str
    checks : tuple of Check
    notes : tuple of Note
    stages : tuple of Stage
    files : tuple of WrittenFile
    facts : dict
        Plain data for JSON.
    failure : PointchartError or None
        Why the run ended as a failure although there is something to tell.
    """

    command: str
    checks: tuple[Check, ...] = ()
    notes: tuple[Note, ...] = ()
    stages: tuple[Stage, ...] = ()
    files: tuple[WrittenFile, ...] = ()
    facts: dict[str, Any] = field(default_factory=dict)
    failure: PointchartError | None = None
