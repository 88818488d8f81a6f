"""Time the stages of a reconstruction over the number of points, as ratios to a k-d tree search in the same run.

    python benchmarks/stages.py [--points 5000 20000 80000 320000] [--repeats 3]

The scan is simulated (a sculpted face without noise). Each figure is the median of the repeats, after one run that
does not count; the exponent is the slope of log time over log points. Machines differ and are noisy: compare ratios,
not seconds.
"""

import argparse
import resource
import time
from collections.abc import Callable

import numpy as np
from scipy.spatial import cKDTree

from pointchart import StageClock, reconstruct
from pointchart.shapes import sculpture, shuffle
from pointchart.typing import Points

NEAREST = 16


def median_seconds(call: Callable[[], object], repeats: int) -> float:
    """Return the median time of a call."""
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - start)
    return float(np.median(seconds))


def search(points: Points) -> None:
    """Find the nearest points of all points: the unit of the ratios."""
    cKDTree(points).query(points, k=NEAREST, workers=-1)


def stage_medians(points: Points, repeats: int) -> dict[str, float]:
    """Return the median time of each stage of a reconstruction, and of the whole."""
    clocks = []
    for _ in range(repeats):
        clock = StageClock()
        reconstruct(points, clock=clock)
        clocks.append(clock.seconds | {"whole": sum(clock.seconds.values())})
    return {name: float(np.median([seconds[name] for seconds in clocks])) for name in clocks[0]}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, nargs="+", default=[5_000, 20_000, 80_000, 320_000])
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    reconstruct(sculpture(2_000).points)
    sizes, units, rows = [], [], []
    for n in options.points:
        points = shuffle(sculpture(n)).points
        sizes.append(len(points))
        units.append(median_seconds(lambda points=points: search(points), options.repeats))
        rows.append(stage_medians(points, options.repeats))
    print("| stage | " + " | ".join(f"{n:,} points" for n in sizes) + " | exponent |")
    print("|---|" + "---|" * (len(sizes) + 1))
    print(f"| search of {NEAREST} nearest, seconds | " + " | ".join(f"{unit:.3f}" for unit in units) + " | |")
    for name in rows[0]:
        slope = np.polyfit(np.log(sizes), np.log([row[name] for row in rows]), 1)[0] if len(sizes) > 1 else np.nan
        ratios = " | ".join(f"{row[name] / unit:.2f}" for row, unit in zip(rows, units, strict=True))
        print(f"| {name}, times the search | {ratios} | {slope:.2f} |")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    print(f"\nPeak memory {peak / 2**20:.0f} MiB, {peak / sizes[-1]:.0f} bytes a point of the largest scan.")


if __name__ == "__main__":
    main()
