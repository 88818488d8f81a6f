import os
import shutil
import stat
import subprocess
import sys
from pathlib import Path

import pytest

import pointchart
from pointchart.cli.progress import staged

PACKAGE = Path(pointchart.__file__).parent
HEAVY = {"numpy", "scipy", "numba", "matplotlib", "trimesh", "rich"}
# Sends itself Ctrl-C as the named module is looked for.
INTERRUPTED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
class Interrupt:
    def find_spec(self, name, *_):
        if name == module:
            sys.meta_path.remove(self)
            os.kill(os.getpid(), signal.SIGINT)
module = sys.argv.pop(1)
sys.meta_path.insert(0, Interrupt())
from pointchart.__main__ import main
main()
"""
KEPT = "import os, pointchart; print(os.environ.get('NUMBA_CACHE_DIR'))"


def python(*words, **environment):
    """Run another interpreter and return how it ended."""
    words = [sys.executable, *map(str, words)]
    return subprocess.run(words, env={**os.environ, **environment}, capture_output=True, text=True)


@pytest.fixture
def read_only(tmp_path, monkeypatch):
    """Copy the package to where no kernels can be kept, beside it or at home; return the folder for temporary files."""
    site, temporary = tmp_path / "site", tmp_path / "temporary"
    shutil.copytree(PACKAGE, site / "pointchart", ignore=shutil.ignore_patterns("__pycache__"))
    # Files in the place of folders stop root as well.
    for folder in (site / "pointchart/_kernels").iterdir():
        if folder.is_dir():
            (folder / "__pycache__").touch()
    temporary.mkdir()
    for name, value in {"PYTHONPATH": site, "HOME": "/dev/null/none", "TMPDIR": temporary}.items():
        monkeypatch.setenv(name, str(value))
    for name in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    return temporary


# The command line


@pytest.mark.parametrize(
    "words",
    [
        ["--help"],
        ["--version"],
        *([name, "--help"] for name in ("mesh", "param", "boundary", "fit", "check", "figure", "view")),
    ],
)
def test_help_comes_without_the_libraries_that_commands_use(words):
    done = python("-X", "importtime", "-m", "pointchart", *words)
    assert done.returncode == 0
    imported = {line.rpartition("|")[2].strip().partition(".")[0] for line in done.stderr.splitlines()}
    assert "typer" in imported
    assert not HEAVY & imported


@pytest.mark.parametrize("module", ["pointchart.cli", "typer.main", "numpy", "numba", "scipy.sparse", "startinpy"])
def test_ctrl_c_ends_a_start_with_130_and_without_a_word(tmp_path, module):
    done = python("-c", INTERRUPTED, module, "mesh", tmp_path / "scan.ply", "-o", tmp_path / "mesh.ply")
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


# The compiled kernels


def test_kernels_are_kept_among_temporary_files_where_nothing_else_can_be_written(read_only):
    code = f"{KEPT}; from pointchart._kernels.mesh.half_edges import following; assert following(5) == 3"
    done = python("-c", code)
    folder = read_only / f"pointchart-{os.getuid()}"
    assert (done.stdout, done.stderr) == (f"{folder}\n", "")
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    assert [path.suffix for path in sorted(folder.rglob("half_edges.following*"))] == [".nbc", ".nbi"]


def test_kernels_are_kept_there_though_numba_is_imported_first(read_only):
    code = f"import numba; {KEPT}; from pointchart._kernels.mesh.half_edges import following; following(5)"
    assert python("-c", code).returncode == 0
    assert list(read_only.rglob("half_edges.following*"))


def test_no_kernels_are_kept_where_others_can_write(read_only):
    folder = read_only / f"pointchart-{os.getuid()}"
    folder.mkdir()
    folder.chmod(0o777)
    other = Path(python("-c", KEPT).stdout.strip())
    assert other.parent == read_only
    assert other != folder
    assert stat.S_IMODE(other.stat().st_mode) == 0o700


@pytest.mark.parametrize("name", ["NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "HOME"])
def test_a_folder_that_can_be_written_is_left_to_numba(read_only, tmp_path, name):
    done = python("-c", KEPT, **{name: str(tmp_path / "given")})
    assert done.stdout == (f"{tmp_path / 'given'}\n" if name == "NUMBA_CACHE_DIR" else "None\n")
    assert list(read_only.iterdir()) == []


def test_the_first_run_says_why_it_takes_longer_unless_it_is_to_be_quiet(tmp_path):
    code = "from pointchart.cli.progress import staged\nwith staged(quiet={}) as clock, clock('prepare'): pass"
    spoken, quiet = (python("-c", code.format(quiet), NUMBA_CACHE_DIR=str(tmp_path)) for quiet in (False, True))
    assert spoken.stderr.startswith("pointchart: first run on this machine: compiling its kernels, once")
    assert (len(spoken.stderr.splitlines()), quiet.stderr) == (1, "")


def test_later_runs_say_nothing_of_compiling(capsys):
    from pointchart import delaunay_star, nearest, shapes

    points = shapes.disc(60).points
    delaunay_star(points, nearest(points, 12))
    with staged(False) as clock, clock("prepare"):
        pass
    assert capsys.readouterr().err == ""
