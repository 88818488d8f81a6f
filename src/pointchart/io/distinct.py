"""Equal rows of an array of coordinates."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..typing import Indices


def distinct_rows(rows: NDArray[Any]) -> tuple[Indices, Indices]:
    """Find the distinct rows, in order of first appearance; zero equals minus zero, not-a-number equals nothing.

    Parameters
    ----------
    rows
        (n, d) numbers.

    Returns
    -------
    (k,) index of the first row of each kind, and (n,) kind of each row.

    Examples
    --------
    >>> distinct_rows(np.array([[5.0], [3.0], [5.0]]))
    (array([0, 1]), array([0, 1, 0]))
    """
    order = np.lexsort(rows.T)
    in_order = rows[order]
    is_new = np.ones(len(rows), dtype=bool)
    is_new[1:] = (in_order[1:] != in_order[:-1]).any(axis=1)
    first = order[is_new]
    rank = np.empty(len(first), np.int64)
    by_appearance = np.argsort(first)
    rank[by_appearance] = np.arange(len(first))
    kind = np.empty(len(rows), np.int64)
    kind[order] = rank[np.cumsum(is_new) - 1]
    return first[by_appearance], kind
