"""Every error that pointchart raises on purpose; numpy is imported where one names points, not before."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from enum import StrEnum
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

NO_MEMORY = "not enough memory for this scan; thin it, or use a machine with more"  # said by programs, not raised


class Remedy(StrEnum):
    """What may help, in the words of the library; whoever has options for it says which."""

    bridge_gaps = "bridge it"
    leave_gaps_open = "leave it open"
    name_the_outer_loop = "say which is the outer one"
    give_the_boundary = "give the boundary"
    cut_the_scan = "cut the scan there"
    take_the_largest_part = "take the largest"
    take_one_part = "take them one by one"
    allow_control_points = "allow more control points"
    allow_deviation = "take a larger tolerance"
    take_the_best = "take the best that there is"
    choose_columns = "say which columns are x, y, z"
    leave_out_invalid = "leave such rows out"
    choose_classes = "choose classes"
    keep_one_a_place = "keep the highest or the lowest"
    take_heights = "for a height field take its projection"


def name_some(indices: ArrayLike, shown: int = 3) -> str:
    """Name a few indices and count the rest.

    >>> name_some([17, 40, 5, 8, 9])
    '17, 40, 5 and 2 more'
    >>> name_some([17])
    '17'
    """
    import numpy as np

    names = np.atleast_1d(np.asarray(indices))
    text = ", ".join(str(name) for name in names[:shown])
    return text + (f" and {len(names) - shown} more" if len(names) > shown else "")


class PointchartError(Exception):
    """A run that cannot go on; its message names the culprit, the number and the remedy.

    Parameters
    ----------
    message : str
        One sentence, or the first part of one whose last part lists the remedies; ``{name}`` stands for points that are
        given by that name.
    remedies : sequence of Remedy
        What may help.
    **points : int or (k,) int array
        Point indices that the message names.

    Examples
    --------
    >>> str(InputError("points {lost} are lost", lost=[3, 1]))
    'points 3, 1 are lost'
    >>> str(InputError("a gap is there", remedies=(Remedy.bridge_gaps, Remedy.leave_gaps_open)))
    'a gap is there; bridge it, or leave it open'
    """

    def __init__(self, message: str, *, remedies: Sequence[Remedy] = (), **points: ArrayLike) -> None:
        self.template, self.remedies, self.points = message, tuple(remedies), _arrays(points)
        super().__init__(self.worded(str))

    def worded(self, word: Callable[[Remedy], str | None]) -> str:
        """Return the sentence with other words for the remedies, without those that `word` gives None for."""
        names = {name: name_some(ids) for name, ids in self.points.items()}
        # Only the names given are replaced: a path in the message may hold braces of its own.
        filled = re.sub(r"\{(\w+)\}", lambda match: names.get(match[1], match[0]), self.template)
        *most, last = [words for words in map(word, self.remedies) if words is not None] or [""]
        return filled + (f"; {', '.join([*most, f'or {last}' if most else last])}" if last else "")

    def renumbered(self, rows: NDArray[Any]) -> Self:
        """Return the same error with point i called ``rows[i]``."""
        points = {name: rows[ids] for name, ids in self.points.items()}
        return type(self)(self.template, remedies=self.remedies, **points)


def _arrays(points: dict[str, ArrayLike]) -> dict[str, NDArray[Any]]:
    if not points:
        return {}
    import numpy as np

    return {name: np.atleast_1d(np.asarray(ids)) for name, ids in points.items()}


class InputError(PointchartError):
    """A precondition on the data or the options is broken."""


class OptionError(PointchartError):
    """Options of a run that do not fit together, or a value that one cannot have; the message names them as flags.

    Parameters
    ----------
    message : str
    flag : str, optional
        The option whose value is at fault, where the message does not name it.
    """

    def __init__(self, message: str, *, flag: str | None = None) -> None:
        super().__init__(message)
        self.flag = flag


class SolveError(PointchartError):
    """The numbers failed: a solver, or a surface that is not the disc it should be."""


class FormatError(PointchartError):
    """A file cannot be read or written."""


@contextmanager
def points_called(rows: NDArray[Any]) -> Iterator[None]:
    """Make errors in the body name point i as ``rows[i]``: as the user numbers it."""
    try:
        yield
    except PointchartError as error:
        if not error.points:
            raise
        raise error.renumbered(rows) from None
