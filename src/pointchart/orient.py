"""Which side of a mesh is outside."""

import numpy as np

from .quality import area_vectors
from .typing import Loop, Points, Triangles

NEARLY_FLAT = 0.5


def faces_inwards(points: Points, triangles: Triangles, loop: Loop) -> bool:
    """Tell whether the triangles of a patch face its inside and should be turned round.

    A patch bulges towards its outside: the volume between the patch and the middle of its boundary is positive seen from
    there. A nearly level height field, such as terrain, has its outside above.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (m, 3) int array
        Consistently oriented.
    loop : (b,) int array
        Boundary.

    Returns
    -------
    bool

    Examples
    --------
    >>> tent = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 2]])
    >>> faces = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> faces_inwards(tent, faces, np.arange(4)), faces_inwards(tent, faces[:, ::-1], np.arange(4))
    (False, True)
    """
    vectors = area_vectors(points, triangles)
    total = vectors.sum(axis=0)
    area = np.linalg.norm(vectors, axis=1).sum()
    if abs(total[2]) > NEARLY_FLAT * area:
        return bool(total[2] < 0.0)
    apex = points[loop].mean(axis=0)
    return bool(np.einsum("ij,ij->", points[triangles].mean(axis=1) - apex, vectors) < 0.0)
