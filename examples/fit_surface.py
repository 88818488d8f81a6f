"""Fit a B-spline surface to a scan, to a tolerance; ask for its curvature, and keep it."""

import tempfile
from pathlib import Path

import numpy as np

from pointchart import shapes
from pointchart.fit import closest_parameters, curvatures
from pointchart.surface_io import read_surface_json, write_surface_json
from pointchart.surfacing import fit_scan


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
    return float(gaussian[0])


if __name__ == "__main__":
    main()
