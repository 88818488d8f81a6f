"""Mesh a scan whose boundary nobody knows, and write the mesh with its parameters."""

import tempfile
from pathlib import Path

from pointchart import read_scan, reconstruct, shapes, write_mesh


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
    return len(mesh.triangles)


if __name__ == "__main__":
    main()
