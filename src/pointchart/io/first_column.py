"""What stands before the coordinates in rows without a header: numbers of rows, times, classes."""

import numpy as np

from ..typing import Floats

# Steps of a time or a counter are even: nine of ten lie within a factor of two of the middle one. Those of sorted
# coordinates are not: of random ones the ninth decile is 3.3 times the median (an exponential law: ln 10 / ln 2).
_EVEN, _DECILES = 2.0, (10, 50, 90)
_CLASSES = 10  # different whole numbers at most that are classes; a grid has more lines than that
_ROWS_OF_CLASS = 50  # and many rows a class, or it may be a small grid
_LEAST = 20  # rows below which nothing is told from the numbers


def is_row_number(column: Floats) -> bool:
    """Tell whether a column counts the rows one by one.

    >>> is_row_number(np.arange(1.0, 31.0)), is_row_number(np.arange(0.0, 60.0, 2.0))
    (True, False)
    """
    return len(column) >= _LEAST and bool((np.diff(column) == 1.0).all())


def what_else_than_x(column: Floats) -> str | None:
    """Say what a first column seems to be if it is hardly a coordinate, with numbers; None if it may well be one.

    >>> what_else_than_x(np.arange(0.0, 3.0, 0.1))
    'rises evenly from row to row (0, 0.1, 0.2 ...), as a time or a counter does'
    >>> what_else_than_x(np.tile([2.0, 5.0], 60))
    'holds 2 whole numbers only (2, 5), as classes are'
    >>> what_else_than_x(np.sin(np.arange(30.0)))
    """
    if len(column) < _LEAST or not np.isfinite(column).all():
        return None
    steps = np.diff(column)
    if (steps > 0.0).all():
        low, middle, high = np.percentile(steps, _DECILES)
        if high <= _EVEN * middle and middle <= _EVEN * low:
            shown = ", ".join(f"{value:g}" for value in column[:3])
            return f"rises evenly from row to row ({shown} ...), as a time or a counter does"
        return None
    values = np.unique(column)
    is_classes = len(values) <= _CLASSES and len(column) >= _ROWS_OF_CLASS * len(values)
    if is_classes and values[0] >= 0.0 and (values == np.rint(values)).all():
        return f"holds {len(values)} whole numbers only ({', '.join(f'{value:g}' for value in values)}), as classes are"
    return None
