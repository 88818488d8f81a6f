"""Run one program on clouds of points and time its call: what a process of its own does for speed.py.

    python benchmarks/programs.py pointchart|meshlib|pymeshlab|cgal

Any interpreter will do that has numpy and the program. The first line written is the program's version, or null where
it is not installed. After that, each line read is a file of points (.npy), and each line written is what was measured,
in JSON: the seconds of the call alone, with the points in the program's own form before the clock starts; of
pointchart also those of its stages, of the library calls that it is compared with, and its memory (Linux only).
"""

import ctypes
import json
import os
import re
import sys
import time
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np

UNIT, FLOOR = 16, 20  # nearest points searched for


def seconds(call):
    """Return the time of a call, and what it returns."""
    start = time.perf_counter()
    made = call()
    return time.perf_counter() - start, made


def memory(field):
    """Return a field of this process's status in bytes; the peak of `resource` would begin at the parent's."""
    status = Path("/proc/self/status").read_text()
    return 1024 * int(re.search(rf"{field}:\s+(\d+) kB", status)[1])


def forget_peak():
    """Give back what is free and start the peak of memory anew, so that an earlier call does not show in a later."""
    ctypes.CDLL(None).malloc_trim(0)
    Path("/proc/self/clear_refs").write_text("5")


def pointchart(points):
    """Go the whole way with no options; then search a k-d tree, and run the library calls of the floor."""
    import startinpy
    from scipy.spatial import cKDTree

    from pointchart import StageClock, reconstruct
    from pointchart.points.morton import morton_order

    forget_peak()
    clock, before = StageClock(), memory("VmRSS")
    whole, found = seconds(lambda: reconstruct(points, clock=clock))
    peak = memory("VmHWM")
    unit, floor = (seconds(lambda k=k: cKDTree(points).query(points, k=k, workers=-1))[0] for k in (UNIT, FLOOR))
    plane = np.column_stack([found.uv[morton_order(found.uv)], np.zeros(len(found.uv))])
    engine = startinpy.DT()
    engine.snap_tolerance = 1e-300
    delaunay, _ = seconds(lambda: engine.insert(plane))
    return {
        "seconds": whole,
        "stages": clock.seconds,
        "search": unit,
        "floor search": floor,
        "floor delaunay": delaunay,
        "bytes": peak - before,
    }


def meshlib(points):
    """Triangulate with MeshLib and its defaults."""
    from meshlib import mrmeshnumpy, mrmeshpy

    cloud = mrmeshnumpy.pointCloudFromPoints(points)
    return {"seconds": seconds(lambda: mrmeshpy.triangulatePointCloud(cloud))[0]}


def pymeshlab(points):
    """Pivot a ball with PyMeshLab and its defaults."""
    from pymeshlab import Mesh, MeshSet

    scene = MeshSet()
    scene.add_mesh(Mesh(vertex_matrix=points))
    return {"seconds": seconds(lambda: scene.apply_filter("generate_surface_reconstruction_ball_pivoting"))[0]}


def cgal(points):
    """Advance a front with CGAL and its defaults."""
    from CGAL.CGAL_Advancing_front_surface_reconstruction import advancing_front_surface_reconstruction
    from CGAL.CGAL_Kernel import Point_3
    from CGAL.CGAL_Point_set_3 import Point_set_3
    from CGAL.CGAL_Polyhedron_3 import Polyhedron_3

    cloud, surface = Point_set_3(), Polyhedron_3()
    for point in points.tolist():
        cloud.insert(Point_3(*point))
    return {"seconds": seconds(lambda: advancing_front_surface_reconstruction(cloud, surface))[0]}


PROGRAMS = {program.__name__: program for program in (pointchart, meshlib, pymeshlab, cgal)}


def main():
    name = sys.argv[1]
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w", buffering=1)
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # what the programs print is no answer
    try:
        print(json.dumps(version(name)), file=answers)
    except PackageNotFoundError:
        print("null", file=answers)
        return
    for line in sys.stdin:
        print(json.dumps(PROGRAMS[name](np.load(line.rstrip("\n")))), file=answers)


if __name__ == "__main__":
    main()
