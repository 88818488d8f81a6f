"""Compare the paper's three methods by the share of the true edges that they find, without edge swaps."""

import pointchart as pc
from pointchart import shapes


def edges(triangles):
    """Return the edges of a mesh as a set."""
    return {tuple(sorted((int(t[k]), int(t[k - 1])))) for t in triangles for k in range(3)}


def main() -> float:
    """Return the share that method 3 finds."""
    scan = shapes.sculpture(1500)
    near, stars = lambda p: pc.ball(p, 3 * scan.spacing), lambda p: pc.delaunay_star(p, pc.nearest(p, 20))
    methods = {"1": (near, pc.uniform), "2": (near, pc.reciprocal_distance), "3": (stars, pc.shape_preserving)}
    for name, (connect, weights) in methods.items():
        mesh = pc.reconstruct(scan.points, scan.boundary, connect=connect, weights=weights, swap=pc.keep_edges)
        share = len(edges(scan.triangles) & edges(mesh.triangles)) / len(edges(scan.triangles))
        print(f"method {name} finds {share:.1%} of the true edges")
    return share


if __name__ == "__main__":
    main()
