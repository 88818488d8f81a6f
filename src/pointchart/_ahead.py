"""Compile the kernels of the late stages while the first run on a machine is busy with those of the early ones.

    python -m pointchart._ahead

A small disc goes through the stages backwards, in a process of its own: compiling takes one core only. What is compiled
is kept, where the run finds it.
"""

import numpy as np

from .assemble import assemble
from .boundary import chord_length_on_circle, patchwork
from .certify import certify
from .chart import uv_on_mesh
from .mesh import one_rings
from .refine import Meshed
from .relocate import relocate_points
from .shapes import disc
from .swaps import Swapped, swap_to_delaunay

N = 200


def main() -> None:
    """Call the stages, the last first."""
    shape = disc(N)
    points, triangles, loop = shape.points, shape.triangles.astype(np.int32), shape.boundary
    certify(points, triangles, uv=shape.uv, loop=loop, spacing=np.ones(N))
    uv_on_mesh(points, loop, chord_length_on_circle(points, loop), Meshed(Swapped(triangles, 0, True)), None)
    relocate_points(points, triangles, one_rings(triangles, N), np.arange(N, dtype=np.int32))
    swap_to_delaunay(points, triangles)
    assemble(points, patchwork(triangles[1:], N), loop)


if __name__ == "__main__":
    main()
