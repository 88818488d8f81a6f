"""The symmetric form of a matrix whose weights come from one number for each pair of neighbours."""

import numpy as np
import scipy.sparse as sp

from .._kernels.solve.graphs import symmetrizer
from ..errors import SolveError
from ..typing import Floats, Indices


def symmetrize(left: sp.csr_array) -> tuple[sp.csr_array, Floats]:
    """Scale the rows of a matrix so that it becomes symmetric, as condition (4.5) allows.

    Raises
    ------
    SolveError
        If no scaling does: some neighbour is not one in return, or the weights of a pair do not come from one number.

    Examples
    --------
    >>> import scipy.sparse as sp
    >>> symmetrize(sp.csr_array([[1, -0.5], [-0.25, 1]]))[0].toarray()
    array([[ 1. , -0.5],
           [-0.5,  2. ]])
    """
    n = left.shape[0]
    scale = np.zeros(n)
    for seed in _component_seeds(left):
        order, parent = sp.csgraph.breadth_first_order(left, seed, directed=False)
        odd = symmetrizer(order, parent, left.indptr, left.indices, left.data, scale)
        if odd >= 0:
            raise SolveError(
                "points {one} and {other} are not neighbours of each other, so the matrix has no symmetric form "
                "(4.5); use balls of constant radius or another solver",
                one=odd,
                other=parent[odd],
            )
    symmetric = sp.csr_array(sp.diags_array(scale) @ left)
    skew = (abs(symmetric - symmetric.T) - 1e-9 * (abs(symmetric) + abs(symmetric.T))).tocoo()
    worst = int(np.argmax(skew.data)) if skew.nnz else -1
    if worst >= 0 and skew.data[worst] > 0.0:
        raise SolveError(
            "the weights have no symmetric form (4.5): those of points {pair} for each other "
            f"differ by {skew.data[worst]:.2g} after scaling; use another solver",
            pair=[skew.row[worst], skew.col[worst]],
        )
    return symmetric, scale


def _component_seeds(left: sp.csr_array) -> Indices:
    labels = sp.csgraph.connected_components(left, directed=False)[1]
    return np.asarray(np.unique(labels, return_index=True)[1])
