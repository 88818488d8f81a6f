"""Time whole reconstructions against other programs, their stages over the number of points, and their floor.

    python benchmarks/speed.py [--peers PYTHON] [--points 30000 131000 527000] [--scans nefertiti foot] [--rounds 1]
                               [--repeats 5] [--limit 30] [--data DIR] [--json FILE]

A whole call is `reconstruct(points)` with no options: boundary found, parameters and certificate included, files apart.
The clouds are a sculpted face of any size, and real scans whose true surface is subdivided by Loop's scheme, four times
the points a round; all in shuffled order.

The other programs are those of MeshLib, PyMeshLab (ball pivoting) and CGAL (advancing front) that the interpreter
PYTHON has installed; another virtual environment does. They get the same points, and make triangles alone. One that
takes over the limit of seconds on a cloud is left out there.

Every program has a process of its own for each cloud, and all take turns, so that the figures of a turn are of the same
minutes; the first turn does not count. Tables in Markdown show medians; JSON has every turn. Progress is on stderr.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path
from threading import TIMEOUT_MAX, Timer
from typing import Any

import numpy as np
from clouds import Cloud, simulated, subdivided
from paper import markdown
from paper_scans import DATA
from programs import FLOOR, UNIT
from ratios import REPEATS, exponent, ratio

OURS = "pointchart"
PEERS = {"meshlib": "MeshLib", "pymeshlab": "PyMeshLab", "cgal": "CGAL"}


class Program:
    """A program in a process of its own.

    Parameters
    ----------
    name : str
    python : str
        The interpreter.
    limit : float
        Seconds after which a run is stopped, and the process with it.

    Attributes
    ----------
    version : str or None
        None where the interpreter does not have the program.
    """

    def __init__(self, name: str, python: str, limit: float = TIMEOUT_MAX) -> None:
        command = [python, str(Path(__file__).with_name("programs.py")), name]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self._limit = limit
        self.version = self._read()

    def measure(self, cloud: Cloud) -> dict[str, Any] | None:
        """Run the program on a cloud; None if that was its end."""
        stop = Timer(self._limit, self._process.kill)
        stop.start()
        print(cloud.file, file=self._process.stdin, flush=True)
        answer = self._read()
        stop.cancel()
        return answer

    def _read(self) -> Any:
        line = self._process.stdout.readline()
        return json.loads(line) if line else None


@dataclass(frozen=True, slots=True)
class Race:
    """Programs that run in turn on one cloud, and what every turn measured of each."""

    cloud: Cloud
    programs: dict[str, Program]
    turns: dict[str, list[dict[str, Any]]] = field(default_factory=dict)

    def take_turns(self) -> None:
        """Run each program once; one that fails is out of the race, and ours ends it."""
        where = f"{self.cloud.surface}, {self.cloud.n_points:,} points"
        for name, program in list(self.programs.items()):
            measured = program.measure(self.cloud)
            if measured:
                self.turns.setdefault(name, []).append(measured)
                print(f"{where}: {name} {measured['seconds']:.3f} s", file=sys.stderr)
            elif name == OURS:
                sys.exit(f"{name} failed on {where}")
            else:
                print(f"{where}: {name} failed or took too long, and is left out", file=sys.stderr)
                del self.programs[name]
                self.turns.pop(name, None)

    def every(self, figure: str, name: str = OURS) -> list[float]:
        """Return one figure of every turn; none where the program is out."""
        return [turn[figure] for turn in self.turns.get(name, [])]

    def median(self, figure: str) -> float:
        """Return the median of a figure of ours."""
        return float(np.median(self.every(figure)))

    def stage(self, name: str) -> float:
        """Return the median time of a stage of ours; a turn without the stage counts as 0."""
        return float(np.median([turn["stages"].get(name, 0.0) for turn in self.turns[OURS]]))


def installed(python: str) -> dict[str, str]:
    """Return the versions of the other programs that an interpreter has."""
    versions = {name: Program(name, python).version for name in PEERS}
    for name, version in versions.items():
        if version is None:
            print(f"{PEERS[name]} is left out: {python} does not have it", file=sys.stderr)
    return {name: ".".join(version.split(".")[:3]) for name, version in versions.items() if version}


def whole_calls(races: list[Race], versions: dict[str, str]) -> str:
    """Compare whole calls with other programs, in seconds."""
    head = ["surface", "points", OURS]
    for name, version in versions.items():
        head += [f"{PEERS[name]} {version}", f"ours over {PEERS[name]}'s"]
    rows = []
    for race in races:
        row = [race.cloud.surface, f"{race.cloud.n_points:,}", f"{race.median('seconds'):.2f}"]
        for name in versions:
            theirs = race.every("seconds", name)
            row += [f"{np.median(theirs):.2f}", ratio(race.every("seconds"), theirs)] if theirs else ["left out", ""]
        rows.append(tuple(row))
    return markdown(tuple(head), rows)


def stages(races: list[Race]) -> str:
    """Show the stages over the number of points of one surface, as multiples of a search, and how they grow."""
    sizes = [race.cloud.n_points for race in races]
    units = [race.median("search") for race in races]
    turns = sorted((turn["stages"] for race in races for turn in race.turns[OURS]), key=len, reverse=True)
    names = dict.fromkeys(name for turn in turns for name in turn)
    times = {name: [race.stage(name) for race in races] for name in names}
    times["whole"] = [race.median("seconds") for race in races]
    rows = [(f"search of {UNIT} nearest, seconds", *(f"{unit:.3f}" for unit in units), exponent(sizes, units))]
    for name, medians in times.items():
        multiples = (f"{median / unit:.2f}" for median, unit in zip(medians, units, strict=True))
        rows.append((f"{name}, times the search", *multiples, exponent(sizes, medians)))
    peaks = (f"{race.median('bytes') / race.cloud.n_points:,.0f}" for race in races)
    rows.append(("peak memory, bytes a point", *peaks, ""))
    return markdown(("stage", *(f"{n:,} points" for n in sizes), "exponent"), rows)


def floors(races: list[Race]) -> str:
    """Show what two library calls that no way can do without take of the whole."""
    rows = []
    for race in races:
        search, delaunay, whole = (race.every(name) for name in ("floor search", "floor delaunay", "seconds"))
        cells = (f"{np.median(seconds):.3f}" for seconds in (search, delaunay, whole))
        rows.append((race.cloud.surface, f"{race.cloud.n_points:,}", *cells, ratio(np.add(search, delaunay), whole)))
    parts = (f"search of {FLOOR} nearest", "Delaunay triangulation of uv")
    return markdown(("surface", "points", *parts, "whole", "floor over whole"), rows)


def race_all(clouds: list[Cloud], versions: dict[str, str], options: argparse.Namespace) -> list[Race]:
    """Run all programs on all clouds in turn."""
    races = []
    for cloud in clouds:
        peers = {name: Program(name, options.peers, options.limit) for name in versions}
        races.append(Race(cloud, {OURS: Program(OURS, sys.executable)} | peers))
    for turn in range(options.repeats + 1):
        print(f"turn {turn} of {options.repeats}", file=sys.stderr)
        for race in races:
            race.take_turns()
            if turn == 0:  # code may have been compiled
                race.turns.clear()
    return races


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--peers", default=sys.executable, metavar="PYTHON", help="interpreter of the other programs")
    parser.add_argument("--points", type=int, nargs="*", default=[30_000, 131_000, 527_000], help="of the face")
    parser.add_argument("--scans", nargs="*", default=["nefertiti", "foot"], help="real scans to subdivide")
    parser.add_argument("--rounds", type=int, default=1, help="of subdivision")
    parser.add_argument("--repeats", type=int, default=REPEATS)
    parser.add_argument("--limit", type=float, default=30.0, help="seconds that another program may take")
    parser.add_argument("--data", type=Path, default=DATA, help="folder of the scans")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write what every turn measured")
    options = parser.parse_args()
    versions = installed(options.peers)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        clouds = [
            *simulated(options.points, folder),
            *subdivided(options.scans, options.rounds, options.data, folder),
        ]
        races = race_all(clouds, versions, options)
    if versions:
        print(f"### Whole calls, in seconds\n\n{whole_calls(races, versions)}\n")
    for surface, group in groupby(races, key=lambda race: race.cloud.surface):
        print(f"### Stages: {surface}\n\n{stages(list(group))}\n")
    print(f"### The floor, in seconds\n\n{floors(races)}\n")
    if options.json:
        turns = [{"surface": race.cloud.surface, "points": race.cloud.n_points, "turns": race.turns} for race in races]
        options.json.write_text(json.dumps({"cores": os.cpu_count(), "versions": versions, "clouds": turns}, indent=1))


if __name__ == "__main__":
    main()
