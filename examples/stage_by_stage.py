"""
Stage by stage
==============

From points to a certified mesh, one stage at a time: the whole architecture in a dozen lines.
"""

from matplotlib import pyplot as plt

import pointchart as pc
from pointchart import shapes


def draw(points, uv, before, after):
    """Draw the triangulation of the parameters, and the mesh that the swaps make of it."""
    panels = plt.subplots(1, 3, figsize=(9, 3.4), layout="constrained")[1]
    panels[0].triplot(*uv.T, before, color="#22303c", linewidth=0.3)
    panels[1].triplot(*points[:, :2].T, before, color="#22303c", linewidth=0.3)
    panels[2].triplot(*points[:, :2].T, after, color="#22303c", linewidth=0.3)
    for axes, title in zip(panels, ("parameters, triangulated", "the same on the scan", "edges swapped"), strict=True):
        axes.set(title=title, aspect="equal")
        axes.set_axis_off()


def main() -> int:
    """Return the Euler characteristic of the mesh: 1, that of a disc."""
    points = pc.prepare(shapes.sculpture(1500).points).points
    vicinity = pc.explore(points)
    star = pc.delaunay_star(points, vicinity.around)
    loop = pc.find_boundary(points, vicinity=vicinity).loop
    first = pc.parameterize(points, loop, pc.chord_length_on_circle(points, loop), star)
    print(f"{first.solution.unknowns} unknowns solved, residual {first.solution.residual:.0e}")
    triangles = pc.triangulate(first.uv, first.loop)
    mesh = pc.swap_to_delaunay(points, triangles)
    proof = pc.certify(points, mesh.triangles, loop=loop)
    print(f"{mesh.n_swaps} edges swapped; a disc: {proof.is_disc}, Euler characteristic {proof.euler}")
    draw(points, first.uv, triangles, mesh.triangles)
    return proof.euler


if __name__ == "__main__":
    main()
    plt.show()
