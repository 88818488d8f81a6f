"""Go from points to a certified mesh one stage at a time."""

import pointchart as pc
from pointchart import shapes


def main() -> int:
    """Return the Euler characteristic of the mesh: 1, that of a disc."""
    points = pc.prepare(shapes.sculpture(1500).points).points
    vicinity = pc.explore(points)
    star = pc.delaunay_star(points, vicinity.around)
    loop = pc.find_boundary(points, vicinity=vicinity).loop
    first = pc.parameterize(points, loop, pc.chord_length_on_circle(points, loop), star)
    print(f"{first.solution.unknowns} unknowns solved, residual {first.solution.residual:.0e}")
    mesh = pc.swap_to_delaunay(points, pc.triangulate(first.uv, first.loop))
    proof = pc.certify(points, mesh.triangles, loop=loop)
    print(f"{mesh.n_swaps} edges swapped; a disc: {proof.is_disc}, Euler characteristic {proof.euler}")
    return proof.euler


if __name__ == "__main__":
    main()
