"""
The paper's three methods
=========================

They are compared by the share of the true edges that they find, without edge swaps.
"""

from matplotlib import pyplot as plt

import pointchart as pc
from pointchart import shapes


def edges(triangles):
    """Return the edges of a mesh as a set."""
    return {tuple(sorted((int(t[k]), int(t[k - 1])))) for t in triangles for k in range(3)}


def draw(meshes, shares):
    """Draw the parameters of each method."""
    panels = plt.subplots(1, 3, figsize=(9, 3.4), layout="constrained")[1]
    for axes, (name, mesh) in zip(panels, meshes.items(), strict=True):
        axes.triplot(*mesh.uv.T, color="#22303c", linewidth=0.3)
        axes.set(title=f"method {name}: {shares[name]:.0%}", aspect="equal")
        axes.set_axis_off()


def main() -> float:
    """Return the share that method 3 finds."""
    scan = shapes.sculpture(1500)
    near, stars = lambda p: pc.ball(p, 3 * scan.spacing), lambda p: pc.delaunay_star(p, pc.nearest(p, 20))
    methods = {"1": (near, pc.uniform), "2": (near, pc.reciprocal_distance), "3": (stars, pc.shape_preserving)}
    meshes, shares = {}, {}
    for name, (connect, weights) in methods.items():
        mesh = pc.reconstruct(scan.points, scan.boundary, connect=connect, weights=weights, swap=pc.keep_edges)
        shares[name] = len(edges(scan.triangles) & edges(mesh.triangles)) / len(edges(scan.triangles))
        meshes[name] = mesh
        print(f"method {name} finds {shares[name]:.1%} of the true edges")
    draw(meshes, shares)
    return shares["3"]


if __name__ == "__main__":
    main()
    plt.show()
