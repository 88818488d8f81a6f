"""Time whole processes of the command line: how long one waits, start-up and files included.

    python benchmarks/startup.py [--repeats 5] [--first-runs 2] [--json FILE]

The help, and the mesh of 2,000 points: with compiled code kept from the first run, and on a first run, for which the
folder of compiled code (NUMBA_CACHE_DIR) is empty. The unit is a process that imports numpy. All take turns; seconds
are medians. First runs are in the first turns only, since they take half a minute each. Progress is on stderr.
"""

import argparse
import json
import os
import subprocess
import sys
import sysconfig
import tempfile
import time
from pathlib import Path

import numpy as np
from paper import markdown
from ratios import REPEATS, ratio

from pointchart.shapes import sculpture

N = 2_000
UNIT, HELP, AGAIN, FIRST = "import numpy", "pointchart --help", "pointchart mesh, again", "pointchart mesh, first run"


def seconds(command: list[str], cache: Path) -> float:
    """Return the time of a whole process that keeps compiled code in a folder."""
    start = time.perf_counter()
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache)}
    subprocess.run(command, env=environment, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - start


def take_turns(repeats: int, first_runs: int, folder: Path) -> dict[str, list[float]]:
    """Run the processes by turns; the first of the first runs leaves its compiled code to those that come again."""
    pointchart, scan = str(Path(sysconfig.get_path("scripts")) / "pointchart"), folder / "scan.xyz"
    np.savetxt(scan, sculpture(N).points)
    mesh = [pointchart, "mesh", str(scan), "-o", str(folder / "mesh.ply")]
    commands = {FIRST: mesh, AGAIN: mesh, HELP: [pointchart, "--help"], UNIT: [sys.executable, "-c", "import numpy"]}
    found: dict[str, list[float]] = {name: [] for name in commands}
    for turn in range(repeats):
        for name, command in commands.items():
            if name != FIRST or turn < first_runs:
                found[name].append(seconds(command, folder / f"cache{turn if name == FIRST else 0}"))
                print(f"turn {turn + 1} of {repeats}: {name} {found[name][-1]:.2f} s", file=sys.stderr)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=REPEATS)
    parser.add_argument("--first-runs", type=int, default=2, help="of the turns that have one; at least 1")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the seconds of every process")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = take_turns(options.repeats, options.first_runs, Path(folder))
    rows = [
        (
            name,
            f"{np.median(found[name]):.2f}",
            *(ratio(found[name], found[unit][: len(found[name])]) for unit in (UNIT, AGAIN)),
        )
        for name in (UNIT, HELP, AGAIN, FIRST)
    ]
    print(f"### Start-up: whole processes, {N:,} points\n")
    print(markdown(("process", "seconds", f"over {UNIT}", "over mesh, again"), rows))
    if options.json:
        options.json.write_text(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()
