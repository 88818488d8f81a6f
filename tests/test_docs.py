"""What the docs say is true: commands and snippets run and print that; links, options, messages and constants exist."""

import doctest
import re
import shlex
import shutil
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import pointchart
from pointchart import shapes, write_mesh

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
PAGES = sorted(path for path in DOCS.rglob("*.md") if "examples" not in path.relative_to(DOCS).parts)
FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NOT_RUN = ("pip install ",)
DRAWN_BY_BENCHMARKS = {"gallery.md"}  # its commands fit a large scan: benchmarks/gallery.py runs them
SCANS = {
    "scan": lambda: shapes.sculpture(2000).points,
    "repeated": lambda: np.vstack([shapes.sculpture(2000).points, shapes.sculpture(2000).points[:25]]),
    "gappy": lambda: shapes.pierce(shapes.relief(2500, seed=1), n_gaps=3, seed=2).points,
    "noisy": lambda: shapes.add_noise(shapes.relief(1200, seed=3), sigma_in_spacings=0.25, seed=4).points,
    "tile": lambda: shapes.relief(700, seed=5).points,
    "ring": lambda: shapes.annulus(64, 9).points,
    "ball": lambda: shapes.sphere(800).points,
}


def named(path):
    return str(path.relative_to(DOCS))


def fences(path):
    """Yield the language and the text of each fenced block, and the text of a block of output right after it."""
    blocks = list(FENCE.finditer(path.read_text()))
    for block, after in zip(blocks, [*blocks[1:], None], strict=True):
        follows = after is not None and after[1] == "text" and not path.read_text()[block.end() : after.start()].strip()
        yield block[1], block[2], after[2] if follows else None


def check_output(said, printed, what):
    """Compare with an output in which ... stands for anything, a line of it for any lines."""
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    assert doctest.OutputChecker().check_output(said, printed, flags), (
        f"{what} printed\n{printed}\nbut the page has\n{said}"
    )


def run_session(text, command_line):
    """Run the commands of a block, each line with $ and the output under it."""
    for session in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, said = session.partition("\n")
        if command.startswith(NOT_RUN):
            continue
        program, *words = shlex.split(command)
        assert program == "pointchart", f"'{command}' is neither run nor among {NOT_RUN}"
        code, out, err = command_line(*words)
        fails = said.rstrip().rpartition("\n")[2].startswith("pointchart: ")
        assert code == (1 if fails else 0), f"'{command}' left with {code}\n{out}{err}"
        if said.strip():
            check_output(said, out + err, command)


@pytest.fixture(scope="module")
def scans(tmp_path_factory):
    """Write the scans that the docs name."""
    folder = tmp_path_factory.mktemp("scans")
    for name, make in SCANS.items():
        write_mesh(folder / f"{name}.ply", make(), np.empty((0, 3), np.int64))
    gappy = SCANS["gappy"]()
    opened = pointchart.reconstruct(gappy, gaps=pointchart.leave_gaps_open)
    write_mesh(folder / "open.ply", gappy, opened.triangles, uv=opened.uv)
    return folder


@pytest.fixture
def folder(scans, tmp_path, monkeypatch):
    """Go to a folder with those scans."""
    shutil.copytree(scans, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("path", [p for p in PAGES if FENCE.search(p.read_text())], ids=named)
def test_what_a_page_shows_runs_and_prints_that(path, folder, command_line, capsys):
    names, expected = {}, None
    for language, text, said in fences(path):
        if language == "console":
            run_session(text, command_line)
        elif language == "python":
            exec(compile(text, named(path), "exec"), names)
            printed = capsys.readouterr().out
            if said is not None:
                check_output(said, printed, text)
        else:
            assert text == expected, f"{named(path)} has a block of {language} that is neither run nor compared"
        expected = said


def test_every_block_of_code_has_a_language_so_that_it_is_run():
    bare = {named(path) for path in PAGES if re.search(r"^```\n(?:.*\n)*?```$", _without_blocks(path), re.MULTILINE)}
    assert bare <= DRAWN_BY_BENCHMARKS


def _without_blocks(path):
    return re.sub(r"^```[\w{].*?^```$", "", path.read_text(), flags=re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("path", [*PAGES, ROOT / "README.md"], ids=lambda path: path.name)
def test_links_lead_to_files_that_are_there(path):
    made_by_the_site = {DOCS / "examples" / f"{example.stem}.rst" for example in (ROOT / "examples").glob("*.py")}
    made_by_the_site.add(DOCS / "examples" / "index.rst")
    for target in re.findall(r"\]\(([^)#:]+?)(?:#[^)]*)?\)", path.read_text()):
        to = (path.parent / target).resolve()
        assert to.exists() or to in made_by_the_site, f"{path.name} links to {target}"


def test_every_option_that_the_docs_name_is_one():
    import typer

    from pointchart.cli import app

    group = typer.main.get_command(app)
    known = {o for c in (group, *group.commands.values()) for p in c.params for o in (*p.opts, *p.secondary_opts)}
    known |= {"--help"}
    for script in (ROOT / "benchmarks").glob("*.py"):
        known |= set(re.findall(r'"(--[a-z-]+)"', script.read_text()))
    for path in [*PAGES, ROOT / "README.md"]:
        named_here = set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", re.sub(r"(?s)<!--.*?-->", "", path.read_text())))
        assert named_here <= known, f"{path.name} names {sorted(named_here - known)}"


def test_every_message_that_the_docs_name_is_in_the_sources():
    sources = "\n".join(path.read_text() for path in sorted((ROOT / "src").rglob("*.py")))
    joined = re.sub(r'"\s*\n\s*f?"', "", sources)
    for path in PAGES:
        for table in re.findall(r"^\| message \|.*\n\|[-| ]+\n((?:\|.*\n)+)", path.read_text(), re.MULTILINE):
            for row in table.splitlines():
                for part in re.split(r"[;,]?\s*\.\.\.[;,]?\s*", row.split("|")[1].strip()):
                    assert part in joined, f"{named(path)}: '{part}' is no part of a message"


def test_every_constant_that_the_docs_name_has_the_value_that_they_say():
    for path in PAGES:
        for name, said in re.findall(r"^\| `([\w.]+\.[A-Z_]+)` \| ([^|]+) \|", path.read_text(), re.MULTILINE):
            module, _, constant = name.rpartition(".")
            values = np.atleast_1d(getattr(import_module(f"pointchart.{module}"), constant))
            said = said.replace(",", "")
            ends = values[[0, -1]] if "to" in said.split() else values
            for value in ends:
                shown = {f"{value:g}", f"{value:.3g}", f"{value:.0f}"}
                words = re.findall(r"-?\d[\d.]*(?:e-?\d+)?", said)
                assert shown & {f"{float(word.rstrip('.')):g}" for word in words}, (
                    f"{named(path)}: {name} is {values}, not {said}"
                )


def test_every_public_name_is_in_the_reference():
    listed = set()
    for path in (DOCS / "api").glob("*.md"):
        for module, names in re.findall(r"```\{names\} ([\w.]+)\n(.*?)```", path.read_text(), re.DOTALL):
            listed |= set(names.split()) or set(import_module(module).__all__)
    assert set(pointchart.__all__) <= listed, sorted(set(pointchart.__all__) - listed)
