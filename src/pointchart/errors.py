"""Every error that pointchart raises on purpose."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray


def name_some(indices: ArrayLike, shown: int = 3) -> str:
    """Name a few indices and count the rest.

    >>> name_some([17, 40, 5, 8, 9])
    '17, 40, 5 and 2 more'
    >>> name_some([17])
    '17'
    """
    names = np.atleast_1d(np.asarray(indices))
    text = ", ".join(str(name) for name in names[:shown])
    return text + (f" and {len(names) - shown} more" if len(names) > shown else "")


class PointchartError(Exception):
    """A run that cannot go on; its message names the culprit, the number and the remedy.

    Parameters
    ----------
    message : str
        One sentence; ``{name}`` stands for points that are given by that name.
    **points : int or (k,) int array
        Point indices that the message names.

    Examples
    --------
    >>> str(InputError("points {lost} are lost", lost=[3, 1]))
    'points 3, 1 are lost'
    """

    def __init__(self, message: str, **points: ArrayLike) -> None:
        self.template, self.points = message, {name: np.atleast_1d(np.asarray(ids)) for name, ids in points.items()}
        names = {name: name_some(ids) for name, ids in self.points.items()}
        # Only the names given are replaced: a path in the message may hold braces of its own.
        super().__init__(re.sub(r"\{(\w+)\}", lambda match: names.get(match[1], match[0]), message))

    def renumbered(self, rows: NDArray[Any]) -> Self:
        """Return the same error with point i called ``rows[i]``."""
        return type(self)(self.template, **{name: rows[ids] for name, ids in self.points.items()})


class InputError(PointchartError):
    """A precondition on the data or the options is broken."""


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
