"""Usage of all commands, the demo, and the command line as a process of its own."""

import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version

import numpy as np
import pytest

from pointchart import certify, read_scan, shapes

COMMAND = [sys.executable, "-m", "pointchart"]
# Sends itself Ctrl-C once the named stage has begun, and its workers have where it has any.
INTERRUPTED = """
import os, signal, sys, threading, time
from contextlib import nullcontext
from pointchart import cli, clock
stage, delay = sys.argv.pop(1), float(sys.argv.pop(1))
def interrupt():
    start, own = time.perf_counter(), threading.active_count()
    while threading.active_count() == own and time.perf_counter() < start + delay:
        time.sleep(0.001)
    os.kill(os.getpid(), signal.SIGINT)
def announce(name):
    if name == stage:
        threading.Thread(target=interrupt, daemon=True).start()
cli.commands.staged = lambda quiet: nullcontext(clock.StageClock(announce))
cli.main()
"""


def test_demo_writes_scan_mesh_picture_and_page(run, tmp_path):
    code, out, err = run("demo", "-o", "shown")
    assert (code, out) == (0, "")
    assert "a certified disc" in err
    scan, mesh = read_scan(tmp_path / "shown/scan.ply"), read_scan(tmp_path / "shown/mesh.ply")
    assert np.array_equal(scan.points, mesh.points)
    assert certify(mesh.points, mesh.triangles).is_disc
    picture = (tmp_path / "shown/picture.png").read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert len(picture) > 50_000
    written = sorted(path.name for path in (tmp_path / "shown").iterdir())
    assert written == ["mesh.ply", "page.html", "picture.png", "scan.ply"]


# Usage


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["mesh", "cap.ply"], "Missing option"),
        (["mesh", "-o", "m.ply"], "Missing argument"),
        (["mesh", "cap.ply", "-o", "m.ply", "--weights", "heavy"], "--weights"),
        (["mesh", "cap.ply", "-o", "m.ply", "--nonsense"], "--nonsense"),
        (["mesh", "cap.ply", "-o", "m.ply", "-k", "0"], "-k"),
        (["mesh", "cap.ply", "-o", "m.ply", "-k", "many"], "-k"),
        *((["mesh", "cap.ply", "-o", "m.ply", "--threads", n], "'--threads': ") for n in ("0", "-1", "many", "1.5")),
        (["param", "cap.ply", "-o", "m.csv", "--threads", "0"], "'--threads': "),
        (["boundary", "cap.ply", "-o", "m.txt", "--threads", "0"], "'--threads': "),
        (["fit", "cap.ply", "-o", "m.json", "--threads", "0"], "'--threads': "),
        (["mash"], "mash"),
        (["demo", "-o", "cap.ply"], "cap.ply is a file; name a folder"),
    ],
)
def test_wrong_usage_exits_with_2_and_writes_nothing(run, cap, tmp_path, words, said):
    code, out, err = run(*words)
    assert (code, out) == (2, "")
    assert said in err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cap.ply"]


@pytest.mark.parametrize(
    ("command", "options"),
    [
        ("mesh", ["--boundary", "--outer", "--holes", "bridge", "open", "--component", "largest", "--threads"]),
        ("param", ["--boundary", "--outer", "--threads"]),
        ("boundary", ["--picture", "--ply", "--outer", "--component", "largest", "--threads"]),
        ("fit", ["--tolerance", "--threads"]),
        ("check", ["--points", "--holes"]),
        ("demo", ["--out"]),
    ],
)
def test_every_command_explains_itself_and_its_options(run, command, options):
    code, out, _ = run(command, "--help")
    assert code == 0
    assert f"pointchart {command}" in out
    assert [option for option in options if option not in out] == []


@pytest.mark.parametrize(
    "words",
    [["mesh", "-o", "m.ply"], ["param", "-o", "m.csv"], ["boundary", "-o", "m.txt"], ["fit", "-o", "m.json"]],
    ids=lambda words: words[0],
)
def test_commands_run_on_the_threads_asked_for(run, cap, monkeypatch, words):
    pools = []

    def counted(n):
        pools.append(n)
        return ThreadPoolExecutor(n)

    monkeypatch.setattr("pointchart._parallel.ThreadPoolExecutor", counted)
    monkeypatch.setattr("pointchart._parallel.LEAST_CHUNK", 50)
    command, *out = words
    assert run(command, "cap.ply", *out, "--threads", 3)[0] == 0
    assert set(pools) == {3}


# As a process of its own


def test_a_process_meshes_a_scan_and_exits_with_0(cap, tmp_path):
    done = subprocess.run([*COMMAND, "mesh", "cap.ply", "-o", "m.ply"], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, "")
    assert "a certified disc: 500 points" in done.stderr
    assert len(read_scan(tmp_path / "m.ply").triangles) == 2 * 500 - 2 - len(cap.boundary)


def test_a_process_ends_a_bad_run_with_1_and_one_sentence(tmp_path):
    np.save(tmp_path / "ball.npy", shapes.sphere(400).points)
    done = subprocess.run(
        [*COMMAND, "mesh", "ball.npy", "-o", "m.ply", "--quiet"], cwd=tmp_path, capture_output=True, text=True
    )
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("pointchart: no boundary was found")
    assert len(done.stderr.splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["ball.npy"]


@pytest.mark.parametrize(("stage", "delay"), [("prepare", 0.05), ("boundary", 0.5), ("parameters", 0.1)])
def test_ctrl_c_ends_a_run_with_130_and_leaves_the_old_file(tmp_path, stage, delay):
    uv = np.random.default_rng(0).random((100_000, 2))
    np.save(tmp_path / "scan.npy", np.c_[uv, 0.1 * np.sin(6 * uv[:, 0]) * np.cos(5 * uv[:, 1])])
    (tmp_path / "m.ply").write_text("old")
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, stage, str(delay), "mesh", "scan.npy", "-o", "m.ply"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONWARNINGS": "default"},
        capture_output=True,
        text=True,
        # A shell's background job ignores Ctrl-C, and its children would inherit that.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    assert done.returncode == 130
    assert "Traceback" not in done.stderr
    assert (tmp_path / "m.ply").read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["m.ply", "scan.npy"]


def test_the_version_is_that_of_the_package(run):
    assert run("--version") == (0, f"pointchart {version('pointchart')}\n", "")


def test_help_has_a_short_name_and_lists_the_commands(run):
    code, out, _ = run("-h")
    assert code == 0
    assert all(command in out for command in ("mesh", "param", "boundary", "check", "demo"))
