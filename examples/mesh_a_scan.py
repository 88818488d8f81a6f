"""
Mesh a scan
===========

The boundary is found; the file gets the mesh with its parameters. Vertex i of the mesh is point i of the scan.
"""

import tempfile
from pathlib import Path

from matplotlib import pyplot as plt

from pointchart import read_scan, reconstruct, shapes, write_mesh


def draw(points, disc):
    """Draw the scan, its parameters and its mesh, seen from the front."""
    left, middle, right = plt.subplots(1, 3, figsize=(9, 3.2), layout="constrained")[1]
    left.scatter(points[:, 0], points[:, 1], s=2, c=points[:, 2], cmap="copper")
    middle.triplot(*disc.uv.T, disc.triangles, color="#22303c", linewidth=0.3)
    right.tripcolor(*points[:, :2].T, disc.triangles, facecolors=points[disc.triangles, 2].mean(axis=1), cmap="copper")
    for axes, title in ((left, "points"), (middle, "parameters"), (right, "mesh")):
        axes.set(title=title, aspect="equal")
        axes.set_axis_off()


def main() -> int:
    """Return the number of triangles in the file."""
    scan = shapes.laser_scan(shapes.sculpted_face, lines=40)
    disc = reconstruct(scan.points)
    print(f"{len(disc.loop)} boundary points found; a disc: {disc.certificate.is_disc}")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "face.ply"
        write_mesh(path, scan.points, disc.triangles, uv=disc.uv)
        mesh = read_scan(path)
    print(f"{len(mesh.points)} points, {len(mesh.triangles)} triangles, with {', '.join(mesh.attributes)}")
    draw(scan.points, disc)
    return len(mesh.triangles)


if __name__ == "__main__":
    main()
    plt.show()
