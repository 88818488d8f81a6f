"""Runs in processes of their own: they report, fail and are cancelled."""

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from pointchart import SolveError, read_loop, shapes, survey_scan
from pointchart.errors import FormatError, InputError, OptionError, Remedy, points_called
from pointchart.report.as_text import as_text
from pointchart.report.record import Note, RunReport
from pointchart.runs.boundary_run import BoundaryRun
from pointchart.runs.check_run import CheckRun
from pointchart.runs.mesh_run import MeshRun
from pointchart.runs.process import PROGRAM, Cancelled, RunProcess
from pointchart.runs.shared_options import GivenBoundary, Source

RELIEF = shapes.relief(200, seed=2)
RUN = CheckRun(mesh=Path("none.ply"))
REPORT = RunReport("check", notes=(Note("it is over"),))
# Programs that take the place of a run: each tells its events, pickled, and one of them sleeps.
TELLS = "import pickle, sys, time; sys.stdout.buffer.write({!r}); sys.stdout.flush()"
SLEEPS = sys.executable, "-c", TELLS.format(pickle.dumps(("sleep", 5))) + "; time.sleep(600)"
ENDS_WELL = sys.executable, "-c", TELLS.format(pickle.dumps(REPORT))


@pytest.fixture
def folder(tmp_path):
    """Write a scan into a folder where runs can be executed."""
    np.save(tmp_path / "relief.npy", RELIEF.points)
    return tmp_path


def boundary_run(scan="relief.npy", **more):
    return BoundaryRun(source=Source(scan=Path(scan)), out=Path("loop.txt"), **more)


def test_a_run_tells_its_stages_and_its_report_and_names_files_as_the_user_does(folder):
    stages = []
    report = RunProcess(boundary_run(), folder=folder).execute(lambda *stage: stages.append(stage))
    assert [name for name, _ in stages] == ["prepare", "neighbours", "boundary"]
    assert sorted(share for _, share in stages) == [share for _, share in stages]
    assert [stage.name for stage in report.stages] == [name for name, _ in stages]
    n = len(survey_scan(RELIEF.points).loop)
    assert as_text(report).startswith(f"loop.txt: a loop of {n} points, ")
    assert [(file.path, file.role) for file in report.files] == [(Path("loop.txt"), "out")]
    assert len(read_loop(folder / "loop.txt")) == n


def test_a_run_in_a_process_comes_to_what_it_comes_to_here(folder, monkeypatch):
    from pointchart.clock import StageClock

    monkeypatch.chdir(folder)
    run = MeshRun(source=Source(scan=Path("relief.npy")), out=Path("m.ply"))
    apart, here = RunProcess(run).execute(lambda *_: None), run.execute(StageClock())
    assert (apart.checks, apart.notes, apart.files) == (here.checks, here.notes, here.files)
    for name in ("points", "options", "boundary", "certificate", "quality", "swaps"):
        assert apart.facts[name] == here.facts[name]


@pytest.mark.parametrize(
    ("run", "kind", "sentence"),
    [
        (RUN, FormatError, "none.ply"),
        (boundary_run(outer="1,2"), OptionError, "--outer is '1,2'; a place is needed"),
        (
            MeshRun(
                source=Source(scan=Path("relief.npy")),
                given=GivenBoundary(boundary=Path("loop.txt")),
                out=Path("m.ply"),
            ),
            InputError,
            "the boundary has 2 points",
        ),
        (CheckRun(mesh=Path("open.off")), InputError, "open.off is no disc: it has 2 parts instead of 1"),
    ],
    ids=["no file", "wrong option", "short boundary", "no disc"],
)
def test_a_failure_is_the_error_of_the_run(folder, run, kind, sentence):
    (folder / "loop.txt").write_text("0\n1\n")
    (folder / "open.off").write_text("OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 1\n3 0 1 2\n3 3 4 5\n")
    with pytest.raises(kind, match=sentence):
        RunProcess(run, folder=folder).execute(lambda *_: None)


@pytest.mark.parametrize(
    "code", ["raise SystemExit(9)", "print('no event')", "import sys; sys.stdout.buffer.write(b'\\x80')"]
)
def test_an_end_without_a_word_is_a_failure(code):
    with pytest.raises(SolveError, match=r"the run ended with status \d and no word of why, as when memory gives out"):
        RunProcess(RUN, program=(sys.executable, "-c", code)).execute(lambda *_: None)


def test_a_run_is_cancelled_at_once_also_before_it_begins():
    late, early = (RunProcess(RUN, program=SLEEPS) for _ in range(2))
    with pytest.raises(Cancelled):
        late.execute(lambda *_: late.cancel())
    early.cancel()
    with pytest.raises(Cancelled):
        early.execute(lambda *_: None)


def test_a_real_run_is_cancelled_and_leaves_no_file(folder):
    np.save(
        folder / "large.npy", shapes.grid(600, 600).points
    )  # which takes much longer than to cancel, on a busy machine too
    process = RunProcess(MeshRun(source=Source(scan=Path("large.npy")), out=Path("m.ply")), folder=folder)
    with pytest.raises(Cancelled):
        process.execute(lambda *_: process.cancel())
    assert sorted(path.name for path in folder.iterdir()) == ["large.npy", "relief.npy"]


def test_a_run_that_is_over_cannot_be_cancelled():
    over = RunProcess(RUN, program=ENDS_WELL)
    assert over.execute(print).notes == REPORT.notes
    over.cancel()
    assert over.execute(print).notes == REPORT.notes


def test_what_is_printed_by_the_way_is_no_event(folder):
    code = (
        "import runpy, sys; import pointchart.clock as clock; begin = clock.StageClock.__call__\n"
        "def talk(self, name): print('by the way', flush=True); return begin(self, name)\n"
        "clock.StageClock.__call__ = talk; runpy.run_module('pointchart.runs', run_name='__main__')"
    )
    report = RunProcess(boundary_run(), folder=folder, program=(sys.executable, "-c", code)).execute(lambda *_: None)
    assert report.command == "boundary"


def test_an_error_that_nobody_foresaw_is_traced_on_stderr(folder):
    order = pickle.dumps(("no run", None))
    done = subprocess.run(PROGRAM, input=order, capture_output=True)
    assert (done.returncode, done.stdout) == (1, b"")
    assert b"AttributeError" in done.stderr


@pytest.mark.parametrize(
    "error",
    [
        InputError("points {lost} in {braces}", lost=[3, 1]),
        SolveError("a gap is there", remedies=(Remedy.bridge_gaps, Remedy.cut_the_scan)),
        OptionError("it is a file", flag="--out"),
    ],
)
def test_an_error_comes_out_of_a_process_as_it_went_in(error):
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), again.remedies) == (type(error), str(error), error.remedies)
    assert getattr(again, "flag", None) == getattr(error, "flag", None)
    if error.points:
        with pytest.raises(InputError, match="points 40, 20 in"), points_called(np.arange(0, 50, 10) + 10):
            raise again
