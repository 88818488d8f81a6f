"""
Fit a surface
=============

A B-spline surface is fitted to a scan, to a tolerance; asked for its curvature, written and read back.
"""

import tempfile
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

from pointchart import shapes
from pointchart.cad import read_surface_json, write_surface_json
from pointchart.surface import closest_parameters, curvatures
from pointchart.surface.surfacing import fit_scan


def draw(cap, points):
    """Draw how far each point is from the surface, over the parameters of its foot."""
    figure, axes = plt.subplots(figsize=(6, 4.4), layout="constrained")
    drawn = axes.scatter(*cap.fit.uv.T, s=9, c=1e6 * cap.deviation.signed, cmap="RdBu")
    axes.plot(*np.vstack([*cap.loops[0], cap.loops[0][0]]).T, color="#22303c", linewidth=0.8)
    figure.colorbar(drawn, label="deviation, millionths of the radius")
    axes.set(title=f"{cap.fit.surface.n_control} control points for {len(points)} points", aspect="equal")


def main() -> float:
    """Return the Gaussian curvature at the top: that of a sphere of radius 1."""
    scan = shapes.hemisphere(1500)
    cap = fit_scan(scan.points, tolerance=1e-4)
    print(
        f"tolerance met: {cap.fit.is_met}, with {cap.fit.surface.n_control} control points; RMS {cap.deviation.rms:.1g}"
    )
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cap.json"  # write_cad writes STEP, IGES and BREP, with the extra cad
        write_surface_json(path, cap.fit.surface, cap.loops, unit="mm")
        surface, loops, unit = read_surface_json(path)
    start = cap.fit.uv[[np.argmax(scan.points[cap.reconstruction.rows, 2])]]
    top = closest_parameters(surface, np.array([[0.0, 0.0, 1.0]]), start)
    gaussian, mean = curvatures(surface, top)
    print(f"in {unit}, trimmed by {len(loops)} loop; at the top, curvature {gaussian[0]:.3f} and {abs(mean[0]):.3f}")
    draw(cap, scan.points)
    return float(gaussian[0])


if __name__ == "__main__":
    main()
    plt.show()
