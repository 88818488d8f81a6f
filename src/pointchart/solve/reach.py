"""What every interior point has to reach: the boundary, by paths that do not all pass one point (paper, section 3)."""

import numpy as np
import scipy.sparse as sp

from .._kernels.solve.graphs import dominators
from ..errors import InputError
from ..points.neighborhoods import Neighborhoods
from ..typing import Indices, Loop


def check_connected(neighborhoods: Neighborhoods, loop: Loop) -> None:
    """Check that every interior point reaches the boundary, by paths that do not all pass one and the same point.

    Raises
    ------
    InputError
        Naming the points that have no path (Proposition 3.3), or hang on one point (they collapse into it, by
        Proposition 3.1).
    """
    hanging_on = cut_points(neighborhoods, loop)
    median = int(np.median(neighborhoods.sizes))
    lost = np.flatnonzero(hanging_on == -2)
    if len(lost):
        raise InputError(
            "interior points {lost} have no path to the boundary, so their position is undetermined; use a "
            f"larger neighbourhood (its median size is {median}), or remove them",
            lost=lost,
        )
    hanging = np.flatnonzero(hanging_on >= 0)
    if len(hanging):
        raise InputError(
            "interior points {hanging} reach the boundary only through point {through}, into which they would "
            f"collapse; use a larger neighbourhood (its median size is {median}), or remove them",
            hanging=hanging,
            through=hanging_on[hanging[0]],
        )


def cut_points(neighborhoods: Neighborhoods, loop: Loop) -> Indices:
    """Find the single point, if there is one, that all paths from each interior point to the boundary pass.

    Returns
    -------
    (n,) int64 array: that point (the one nearest along the paths); -1 where there is none; -2 where there is no path.

    Examples
    --------
    >>> import numpy as np
    >>> chain = Neighborhoods(np.array([0, 0, 1, 2]), np.array([0, 1]))
    >>> cut_points(chain, np.array([0]))
    array([-1,  0,  1])
    """
    n, root = neighborhoods.n_points, neighborhoods.n_points
    is_inner = np.ones(n, bool)
    is_inner[loop] = False
    kept = np.repeat(is_inner, neighborhoods.sizes)
    rows, columns = neighborhoods.rows[kept], neighborhoods.indices[kept]
    # All boundary points lead to one root: who hangs on that alone hangs on no single point.
    rows = np.concatenate([rows, loop])
    columns = np.concatenate([columns, np.full(len(loop), root)])
    graph = sp.csr_array((np.ones(len(rows), np.int8), (rows, columns)), shape=(n + 1, n + 1))
    order = sp.csgraph.breadth_first_order(graph.T.tocsr(), root, return_predecessors=False).astype(np.int64)
    rank = np.full(n + 1, -1, np.int64)
    rank[order] = np.arange(len(order))
    dominator = np.full(n + 1, -1, np.int64)
    dominator[root] = root
    dominators(order, graph.indptr.astype(np.int64), graph.indices.astype(np.int64), root, rank, dominator)
    found = dominator[:n]
    return np.where(rank[:n] < 0, -2, np.where(found == root, -1, found))
