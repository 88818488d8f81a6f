"""Fit B-spline surfaces: real scans to CAD files, bent patches against fits over a plane, rates, a large cloud.

    python benchmarks/surfaces.py [--data DIR] [--points 1000000]

Real scans: no options but the tolerance, 0.1 % of the diagonal, but for 0.5 % outliers. The STEP file is read back by
Open CASCADE, and the deviations are measured again, from the surface that was read. Seconds are those of the whole way
from points to the surface, without start-up and files.

Bent patches: a relief rolled about an axis by 90, 180 and 270 degrees, 4,000 points. Our fit over parameters with a
free boundary; the same fit over the plane of least squares; and scipy's SmoothBivariateSpline, height over that plane.
Each may have 400 control points. Deviations are distances in space, in thousandths of the diagonal, but for 0.5 %.

Rates: knots halved evenly, from points alone.
"""

import argparse
import resource
import tempfile
import time
import warnings
from pathlib import Path

import numpy as np
from paper_scans import DATA
from scipy.interpolate import SmoothBivariateSpline
from scipy.spatial import cKDTree

from pointchart import PointchartError, read_scan, reconstruct, shapes, uv_free_boundary
from pointchart.cad import read_cad, write_cad
from pointchart.surface import closest_parameters, fit_bspline, least_squares, measure_deviation
from pointchart.surface.surfacing import fit_scan
from pointchart.typing import UV, Floats, Points

SCANS = ("fran", "face", "lidar", "mountain", "nefertiti", "bunny30571", "foot")
TOLERANCE, OUTLIERS, CONTROL = 1e-3, 0.005, 400
SPANS = (4, 8, 16)


def diagonal(points: Points) -> float:
    """Return the diagonal of the box around points."""
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def real_scan(points: Points) -> str:
    """Fit a surface to a scan, write it as STEP, read it back, and return the cells of its row."""
    size, start = diagonal(points), time.perf_counter()
    found = fit_scan(points, tolerance=TOLERANCE * size, outliers=OUTLIERS)
    seconds = time.perf_counter() - start
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "surface.step"
        write_cad(file, found.fit.surface, found.loops)
        surface, _, _ = read_cad(file)
    cloud = points[found.reconstruction.rows]
    feet = closest_parameters(surface, cloud, found.fit.uv)
    again = measure_deviation(cloud, surface, feet)
    given = found.deviation
    figures = [given.largest(OUTLIERS), given.rms, again.largest(OUTLIERS), again.rms]
    shape = found.fit.surface.control.shape
    reason = "yes" if found.fit.is_met else "no: noise" if found.fit.is_noise else "no: control points"
    shown = " | ".join(f"{1e3 * figure / size:.3f}" for figure in figures)
    return (
        f"{reason} | {shape[0]} x {shape[1]} | {len(cloud) / found.fit.surface.n_control:.1f} | {shown} | {seconds:.1f}"
    )


def over_plane(points: Points) -> UV:
    """Project points to the plane of least squares."""
    middle = points - points.mean(axis=0)
    return np.asarray(middle @ np.linalg.eigh(middle.T @ middle)[1][:, :0:-1])


def height_spline(points: Points) -> Floats:
    """Return the distances of points from scipy's spline of their height over the plane."""
    middle = points - points.mean(axis=0)
    axes = np.linalg.eigh(middle.T @ middle)[1]
    x, y, z = middle @ axes[:, 2], middle @ axes[:, 1], middle @ axes[:, 0]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it says that it ran out of knots
        spline = SmoothBivariateSpline(x, y, z, s=len(x) * (0.3 * TOLERANCE * diagonal(points)) ** 2)
    places = np.stack(np.meshgrid(*(np.linspace(t.min(), t.max(), 1000) for t in (x, y))), axis=-1).reshape(-1, 2)
    graph = np.column_stack([places, spline.ev(*places.T)])
    return np.asarray(cKDTree(graph).query(np.column_stack([x, y, z]))[0])


def bent(angle: float) -> str:
    """Compare three fits to a bent patch, and return the cells of its row."""
    points = shapes.roll(shapes.relief(4000, height=0.1, seed=1), angle).points
    mesh = reconstruct(points, chart=uv_free_boundary)
    cells, size = [], diagonal(points)
    for cloud, uv in ((points[mesh.rows], mesh.uv), (points, over_plane(points))):
        fit = fit_bspline(cloud, uv, tolerance=1e-9 * size, max_control=CONTROL)
        deviation = measure_deviation(cloud, fit.surface, fit.uv)
        cells += [deviation.largest(OUTLIERS), deviation.rms]
    distance = height_spline(points)
    cells += [float(np.quantile(distance, 1.0 - OUTLIERS)), float(np.sqrt(np.mean(distance**2)))]
    return " | ".join(f"{1e3 * cell / size:.3f}" for cell in cells)


def rate(points: Points) -> str:
    """Return the RMS deviations for knots halved evenly, and the exponent of the last halving."""
    mesh = reconstruct(points, chart=uv_free_boundary)
    cloud, errors = points[mesh.rows], []
    low, high = mesh.uv.min(axis=0), mesh.uv.max(axis=0)
    for n in SPANS:
        knots = [np.r_[[a] * 3, np.linspace(a, b, n + 1), [b] * 3] for a, b in zip(low, high, strict=True)]
        surface = least_squares(cloud, mesh.uv, *knots)
        feet = closest_parameters(surface, cloud, mesh.uv)
        errors.append(measure_deviation(cloud, surface, feet).rms / diagonal(points))
    exponent = np.log(errors[-2] / errors[-1]) / np.log(SPANS[-1] / SPANS[-2])
    return " | ".join([*(f"{error:.1e}" for error in errors), f"{exponent:.2f}"])


def bent_tube(n: int) -> Points:
    """Scatter points on three quarters of a tube of radius 1 about a third of a circle of radius 3."""
    flat = shapes.disc(n, seed=2).uv
    turn, bend = np.deg2rad(135.0) * flat[:, 0], np.deg2rad(60.0) * flat[:, 1]
    reach = 3.0 + np.cos(turn)
    return np.column_stack([reach * np.cos(bend), reach * np.sin(bend), np.sin(turn)])


def large(n: int) -> str:
    """Fit a large cloud at given parameters with 2,500 control points: seconds and memory."""
    uv = np.random.default_rng(1).random((n, 2))
    turn, tilt = 2.0 * uv[:, 0], 1.5 * uv[:, 1]
    points = np.column_stack([np.cos(turn) * np.cos(tilt), np.sin(turn) * np.cos(tilt), np.sin(tilt)])
    points += 0.02 * np.sin(20.0 * uv[:, :1]) * np.cos(15.0 * uv[:, 1:]) * points
    start = time.perf_counter()
    fit = fit_bspline(points, uv, tolerance=1e-12, max_control=2500)
    seconds = time.perf_counter() - start
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    rms = measure_deviation(points, fit.surface, fit.uv).rms
    return f"{n:,} | {fit.surface.n_control} | {rms:.1e} | {seconds:.1f} | {peak:.2f}"


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=DATA, help="folder of the scans")
    parser.add_argument("--points", type=int, default=1_000_000, help="of the large cloud")
    options = parser.parse_args()
    print("| points | control points | RMS | seconds | peak GiB |\n|---|---|---|---|---|")
    print(f"| {large(options.points)} |", flush=True)
    print("\n| surface | 4 spans | 8 spans | 16 spans | exponent |\n|---|---|---|---|---|")
    for name, cloud in (
        ("half a sphere", shapes.hemisphere(8000).points),
        ("sphere cap of 120 degrees", shapes.hemisphere(8000, angle=120.0).points),
        ("tube open by 90 degrees, bent by 120", bent_tube(8000)),
    ):
        print(f"| {name} | {rate(cloud)} |", flush=True)
    print("\n| bend, degrees | free boundary | RMS | same over plane | RMS | scipy over plane | RMS |")
    print("|---|---|---|---|---|---|---|")
    for angle in (1.0, 90.0, 180.0, 270.0):
        print(f"| {angle:.0f} | {bent(angle)} |", flush=True)
    print("\n| scan | points | met | control points | points each | max | RMS | re-read max | RMS | seconds |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name in SCANS:
        if (options.data / name).exists():
            points = read_scan(options.data / name / "points.ply").points
            try:
                print(f"| {name} | {len(points):,} | {real_scan(points)} |", flush=True)
            except PointchartError as failure:
                print(f"| {name} | {len(points):,} | {failure} | | | | | | | |", flush=True)


if __name__ == "__main__":
    main()
